"""A log of scans: its lines, packed by gzip or not, their records, and wrong stamps."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, NamedTuple, cast

import numpy as np

from gazelle.documents import HOW_TO_RAISE, FileLimitError, scaled
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import Poses

__all__ = ["LogRecord", "duration_s", "lines_of", "opened", "stamp_problem"]


_MAGIC = b"\x1f\x8b"

_MAX_BYTES = 4 << 30

_MAX_LINE = 4 << 20


@contextmanager
def opened(path: Path) -> Iterator[BinaryIO]:
    """Open a log to read it; what gzip has packed is unpacked on the way.

    Raises:
        OSError: it cannot be read, or is damaged.
    """
    with path.open("rb") as file:
        is_packed = file.read(len(_MAGIC)) == _MAGIC
        file.seek(0)
        try:
            yield cast(BinaryIO, gzip.GzipFile(fileobj=file)) if is_packed else file
        except (EOFError, zlib.error) as error:
            raise OSError(0, f"the file is damaged: {error}", str(path)) from error


def lines_of(path: Path) -> Iterator[str]:
    """Yield the lines of a log.

    Raises:
        OSError: it cannot be read, is damaged, or longer than is read.
    """
    left = scaled(_MAX_BYTES)
    with opened(path) as file:
        while line := file.readline(_MAX_LINE):
            left -= len(line)
            if left < 0 or len(line) == _MAX_LINE:
                what = f"a line is longer than {_MAX_LINE} bytes"
                if left < 0:
                    what = f"it is longer than {scaled(_MAX_BYTES)} bytes"
                raise FileLimitError(0, what, str(path), f"; {HOW_TO_RAISE}" if left < 0 else "")
            yield line.decode(errors="replace")


_MAX_PAUSE_NS = 86_400 * 1_000_000_000


def stamp_problem(stamps_ns: Sequence[int]) -> str:
    """Return what is wrong with the stamps of scans in their order, empty when nothing is."""
    if len(stamps_ns) < 2:
        return ""
    stamps = np.array([float(stamp) for stamp in stamps_ns])
    steps = np.diff(stamps)
    if not steps.any():
        return f"all {len(stamps)} scans have the same stamp, {stamps[0] * 1e-9:.9g} s"
    odd = np.flatnonzero((steps < 0) | (steps > _MAX_PAUSE_NS))
    if not len(odd):
        return ""
    first = int(odd[0])
    return (
        f"stamps of scans go back, or leap by more than a day, {len(odd)} times, first from "
        f"{stamps[first] * 1e-9:.9g} s to {stamps[first + 1] * 1e-9:.9g} s (scan {first + 1})"
    )


def duration_s(stamps_ns: Sequence[int]) -> float:
    """Return how long a log lasted, 0 when its stamps do not tell; see `stamp_problem`."""
    if len(stamps_ns) < 2 or stamp_problem(stamps_ns):
        return 0.0
    return (int(stamps_ns[-1]) - int(stamps_ns[0])) * 1e-9


class LogRecord(NamedTuple):
    """A scan and where odometry saw the robot.

    Attributes:
        scan: of the lidar.
        odometry: pose of the robot, (x_m, y_m, yaw_rad).
    """

    scan: Scan
    odometry: Poses
