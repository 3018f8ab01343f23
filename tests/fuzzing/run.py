"""Reading damaged files, and what comes of it."""

from __future__ import annotations

import itertools
import os
import time
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from tests.fuzzing.kinds import SCOUT, Kind
from tests.fuzzing.mutations import damaged

from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.workspace import Workspace

__all__ = ["Outcome", "is_error", "read_damaged", "read_one", "time_limit_s"]

_TWICE_EVERY = 10
_BYTES_PER_LIMIT = 50_000
_TIMES_NS = itertools.count(1)


class Outcome(NamedTuple):
    """What came of many files.

    Attributes:
        files: how many were read.
        refused: how many ended in an error.
        slowest_s: computing time of the slowest one.
        slowest: its number.
        crashes: what went wrong, by number of the file.
    """

    files: int
    refused: int
    slowest_s: float
    slowest: int
    crashes: dict[int, str]


def read_damaged(
    kind: Kind, numbers: Iterable[int], folder: Path, *, most_s: float = 5.0
) -> Outcome:
    """Read damaged files of a kind.

    Args:
        kind: which.
        numbers: which of its damaged files.
        folder: an empty one.
        most_s: computing time that a file of a few bytes may take, in seconds; one of 50 kB may
            take twice as much, and so on.
    """
    good, workspace = kind.good(), Workspace.discover(extra=[SCOUT])
    count, refused, slowest_s, slowest, crashes = 0, 0, 0.0, -1, {}
    for number in numbers:
        data = damaged(good, number)
        start_s = time.process_time()
        first = read_one(kind, data, folder, workspace)
        took_s = time.process_time() - start_s
        count += 1
        refused += any(map(is_error, first))
        slowest_s, slowest = max((slowest_s, slowest), (took_s, number))
        if first[-1:] and first[-1].startswith("crash"):
            crashes[number] = first[-1]
        elif _is_ended(first):
            # After how much computing and so where depends on how busy the machine is.
            continue
        elif took_s > time_limit_s(most_s, data):
            crashes[number] = f"it took {took_s:.2f} s"
        elif number % _TWICE_EVERY == 0 and read_one(kind, data, folder, workspace) != first:
            crashes[number] = "the second reading differs"
    return Outcome(count, refused, slowest_s, slowest, crashes)


def time_limit_s(most_s: float, data: bytes) -> float:
    """Return the computing time that a file may take."""
    return most_s * (1 + len(data) / _BYTES_PER_LIMIT)


def _is_ended(lines: list[str]) -> bool:
    """Tell whether macros that call each other were ended by xacro's own limit of time."""
    return any("[limits.expansion]" in line for line in lines)


def is_error(line: str) -> bool:
    """Tell whether a line of `read_one` is an error."""
    return ": error: " in line or line.startswith("error: ")


def read_one(kind: Kind, data: bytes, folder: Path, workspace: Workspace) -> list[str]:
    """Read a file; return its findings, and a line that starts with ``crash`` where it did."""
    path = folder / kind.file
    path.write_bytes(data)
    # Meshes are kept by time and size of the file, which may both be the same by chance.
    os.utime(path, ns=(0, next(_TIMES_NS)))
    diagnostics = Diagnostics()
    end: list[str] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            kind.read(path, diagnostics, workspace)
        except GazelleError as error:
            end = [f"error: {error}"]
        except Exception as error:  # noqa: BLE001 - which one is what this is about
            end = [f"crash: {error!r}"]
    return [str(item) for item in diagnostics] + end
