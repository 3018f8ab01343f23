"""Damage that is guided by what it reaches: files that come to new lines are damaged further.

What is found by chance in a million files lies behind at most four accidents. A file that reached
lines which none had reached before is kept, so that what lies behind them is a few accidents away
again. It is the same for the same numbers, as long as the program is.
"""

from __future__ import annotations

import random
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from tests.fuzzing.kind import SCOUT, Kind
from tests.fuzzing.mutations import damaged
from tests.fuzzing.run import Outcome, is_error, read_one, time_limit_s

import gazelle
from gazelle.workspace import Workspace

__all__ = ["reached", "read_guided"]

_SOURCES = str(Path(gazelle.__file__).parent)
# Without sys.monitoring each line costs a call of ours, so not every file is looked at.
_LOOKED_AT_EVERY = 1 if sys.version_info >= (3, 12) else 8
_MAX_KEPT = 500
_MAX_BYTES = 20_000
_FROM_GOOD = 0.3

Line = tuple[str, int]
"""A file of Gazelle and a number of a line in it."""


def read_guided(kind: Kind, numbers: Iterable[int], folder: Path, *, most_s: float) -> Outcome:
    """Read damaged files of a kind and damage those further that reach something new.

    Args:
        kind: which.
        numbers: as many as files are read; they decide what is damaged and how.
        folder: an empty one.
        most_s: computing time that a file of a few bytes may take; see `read_damaged`.
    """
    good, workspace = kind.good(), Workspace.discover(extra=[SCOUT])
    kept, known = [good], reached(lambda: read_one(kind, good, folder, workspace))
    count, refused, slowest, crashes = 0, 0, (0.0, -1), {}
    for number in numbers:
        chance = random.Random(number)
        parent = good if chance.random() < _FROM_GOOD else chance.choice(kept)
        data = damaged(parent, number)
        found: list[str] = []
        read = _into(found, kind, data, folder, workspace)
        if number % _LOOKED_AT_EVERY == 0:
            lines = reached(read) - known
            known |= lines
            if lines and len(kept) < _MAX_KEPT and len(data) < _MAX_BYTES:
                kept.append(data)
            took_s = 0.0
        else:
            took_s = read()
        count += 1
        refused += any(map(is_error, found))
        slowest = max(slowest, (took_s, number))
        if found[-1:] and found[-1].startswith("crash"):
            crashes[number] = f"{found[-1]} of {data!r}"
        elif took_s > time_limit_s(most_s, data):
            crashes[number] = f"it took {took_s:.2f} s: {data!r}"
    return Outcome(count, refused, *slowest, crashes)


def _into(
    found: list[str], kind: Kind, data: bytes, folder: Path, workspace: Workspace
) -> Callable[[], float]:
    def read() -> float:
        start_s = time.process_time()
        found.extend(read_one(kind, data, folder, workspace))
        return time.process_time() - start_s

    return read


def reached(call: Callable[[], Any]) -> set[Line]:
    """Call something; return the lines of Gazelle that it came to, in this thread."""
    lines: set[Line] = set()
    with (_monitored if sys.version_info >= (3, 12) else _traced)(lines):
        call()
    return lines


@contextmanager
def _traced(lines: set[Line]) -> Iterator[None]:
    def enter(frame: FrameType, _event: str, _argument: Any) -> Any:
        return line if frame.f_code.co_filename.startswith(_SOURCES) else None

    def line(frame: FrameType, _event: str, _argument: Any) -> Any:
        lines.add((frame.f_code.co_filename, frame.f_lineno))
        return line

    before = sys.gettrace()
    sys.settrace(enter)
    try:
        yield
    finally:
        sys.settrace(before)


@contextmanager
def _monitored(lines: set[Line]) -> Iterator[None]:
    """Each line tells once, then costs nothing until the next file.

    Events are those of all threads, and a place that one has switched off is off for all.
    """
    monitoring: Any = sys.monitoring  # type: ignore[attr-defined, unused-ignore]
    tool, event = monitoring.COVERAGE_ID, monitoring.events.LINE
    this_thread = threading.get_ident()

    def line(code: CodeType, number: int) -> Any:
        if threading.get_ident() != this_thread:
            return None
        if code.co_filename.startswith(_SOURCES):
            lines.add((code.co_filename, number))
        return monitoring.DISABLE

    monitoring.use_tool_id(tool, "gazelle fuzzing")
    monitoring.register_callback(tool, event, line)
    monitoring.set_events(tool, event)
    try:
        yield
    finally:
        monitoring.set_events(tool, 0)
        monitoring.free_tool_id(tool)
        monitoring.restart_events()
