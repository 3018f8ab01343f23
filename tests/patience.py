"""How long the tests wait for what is to happen, in one place.

A test waits for an event or for simulated time; a limit in wall time only ends a wait that would
never end. Limits are written as seconds of an ordinary machine that has nothing else to do, and
stretched by what this machine takes for a fixed piece of work and by how many others want its
cores just now. Nothing outside this module compares wall time with a number.
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from gazelle.errors import GazelleError

__all__ = [
    "PATIENCE_S",
    "at_most",
    "await_change",
    "eventually",
    "scale",
    "stretched",
    "undisturbed",
]

PATIENCE_S = 60.0
"""What is waited for unless a test has a reason to say another number."""

_WORK_ROUNDS = 200_000
_ORDINARY_WORK_S = 0.02
_LOOKS = 5
_MAX_SCALE = 20.0
_PAUSE_S = 0.005


def scale() -> float:
    """Return how many times longer than on an idle, ordinary machine things may take now; ≥ 1."""
    slowness = _measured_work_s() / _ORDINARY_WORK_S
    # Where the system tells no load (Windows), twice the time is allowed for.
    load = _load() / (os.cpu_count() or 1) if hasattr(os, "getloadavg") else 2.0
    return min(max(1.0, slowness) * max(1.0, load), _MAX_SCALE)


def _load() -> float:
    """Return how many want a core: the last minute's average, or now where that lags behind."""
    now = 0.0
    with contextlib.suppress(OSError, ValueError, IndexError):
        words = Path("/proc/loadavg").read_text(encoding="ascii").split()
        now = float(words[3].partition("/")[0])
    return max(os.getloadavg()[0], now)


def stretched(limit_s: float = PATIENCE_S) -> float:
    """Return a limit of an idle, ordinary machine as the limit of this one now, in seconds."""
    return limit_s * scale()


def eventually(
    condition: Callable[[], Any],
    limit_s: float = PATIENCE_S,
    *,
    why: Callable[[], str] = lambda: "",
) -> Any:
    """Return what a condition gives as soon as that is true.

    Args:
        condition: asked again and again; what Gazelle refuses is asked for again, too.
        limit_s: how long, on an idle, ordinary machine.
        why: asked for more to say when it never becomes true.
    """
    begin = time.monotonic()
    pause = threading.Event()
    while True:
        refusal: GazelleError | None = None
        try:
            if found := condition():
                return found
        except GazelleError as error:
            refusal = error
        waited_s = time.monotonic() - begin
        # The load may have grown since the wait began.
        if waited_s >= limit_s and waited_s >= stretched(limit_s):
            raise AssertionError(f"did not happen in {waited_s:.0f} s\n{why()}") from refusal
        pause.wait(_PAUSE_S)


def await_change(
    changed: threading.Condition, predicate: Callable[[], Any], limit_s: float = PATIENCE_S
) -> Any:
    """Return what a predicate gives as soon as that is true, or what it gives when time is up.

    The limit is looked at again when it is over, for the load may have grown since the wait began.

    Args:
        changed: told after every change; held by the caller.
        predicate: asked after every change.
        limit_s: how long, on an idle, ordinary machine.
    """
    begin = time.monotonic()
    while not (found := predicate()):
        left_s = stretched(limit_s) - (time.monotonic() - begin)
        if left_s <= 0:
            break
        changed.wait(left_s)
    return found


@contextmanager
def at_most(limit_s: float) -> Iterator[None]:
    """Let a block take so many seconds of an idle, ordinary machine, and no more."""
    begin = time.monotonic()
    yield
    took_s = time.monotonic() - begin
    assert took_s < limit_s or took_s < stretched(limit_s), (
        f"took {took_s:.1f} s; allowed are {limit_s:g} s, {stretched(limit_s):.1f} s here and now"
    )


def undisturbed(
    measure: Callable[[], float], wanted_s: float, *, rel: float, attempts: int = 8
) -> None:
    """Let something that takes a certain time be measured until the machine left it in peace.

    Others who want the cores delay the beginning or the end of what is measured, so that it seems
    shorter or longer; what takes another time than it should does so every time.

    Args:
        measure: does it and returns how long it took, s.
        wanted_s: how long it should take.
        rel: by which share of that it may be off.
        attempts: how often it is measured before it is wrong.
    """
    took_s: list[float] = []
    while not took_s or abs(took_s[-1] - wanted_s) > rel * wanted_s:
        assert len(took_s) < attempts, f"takes {took_s} s, not {wanted_s:.2f} s"
        took_s.append(measure())


@cache
def _measured_work_s() -> float:
    """The fastest of a few looks: the machine's speed, not what else runs on it."""

    def look() -> float:
        begin = time.perf_counter()
        total = 0
        for number in range(_WORK_ROUNDS):
            total += number & 7
        return time.perf_counter() - begin

    return min(look() for _ in range(_LOOKS))
