"""CARMEN logs, old and new (http://carmen.sourceforge.net/logger_playback.html).

Old: ``FLASER n r₁…rₙ x y θ x y θ time host time`` (pose of the lidar, pose of odometry), ``ODOM x y
θ v ω a time host time``. New: ``ROBOTLASER1 type start_angle fov resolution max_range accuracy
remission_mode n r₁…rₙ m e₁…eₘ lx ly lθ x y θ …``, where the first pose is the lidar's and the
second the robot's. FLASER says no angles: 180° (181 beams: with both ends), one beam per degree or
finer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.logs.log_record import LogRecord, lines_of
from gazelle.mapping.se2 import between

__all__ = ["read_carmen"]

_NOTHING_M = 80.0
"""SICK lidars say about 81.9 m where they meet nothing."""

_MIN_M = 0.05


def read_carmen(path: Path, diagnostics: Diagnostics) -> Iterator[LogRecord]:
    """Yield the scans of the front lidar with their odometry.

    The robot's pose is taken from the scan's line itself, which carries it. Lines of other kinds
    (PARAM, SYNC, RLASER, GPS …) are passed over; broken ones are reported and left out. The file
    may be packed by gzip.

    Raises:
        OSError: the file cannot be read, is damaged, or longer than is read.
    """
    for number, line in enumerate(lines_of(path), 1):
        fields = line.split()
        parse = _PARSERS.get(fields[0]) if fields else None
        if parse is None:
            continue
        try:
            record = parse(fields)
        except (IndexError, ValueError, OverflowError) as error:
            _report(diagnostics, SourceSpan(str(path), number), fields[0], error)
            continue
        yield record


def _flaser(fields: list[str]) -> LogRecord:
    count = _count(fields[1])
    ranges = np.array(fields[2 : 2 + count], dtype=np.float32)
    lidar = _pose(fields[2 + count : 5 + count])
    robot = _pose(fields[5 + count : 8 + count])
    stamp = _stamp_ns(fields[8 + count])
    if len(ranges) != count:
        raise ValueError(f"{count} ranges are announced, {len(ranges)} are there")
    fov = math.pi
    ends = count if count % 2 == 0 else count - 1
    step = fov / max(1, ends)
    # With 180 beams CARMEN's first looks along −90°, the last half a beam short of +90°.
    return _record(stamp, ranges, (-fov / 2, step, _NOTHING_M), lidar, robot)


def _robotlaser(fields: list[str]) -> LogRecord:
    start, fov, step, most = (float(word) for word in fields[2:6])
    count = _count(fields[8])
    ranges = np.array(fields[9 : 9 + count], dtype=np.float32)
    after = 9 + count
    after += 1 + _count(fields[after])
    lidar, robot = _pose(fields[after : after + 3]), _pose(fields[after + 3 : after + 6])
    stamp = _stamp_ns(fields[after + 11])
    if len(ranges) != count:
        raise ValueError(f"{count} ranges are announced, {len(ranges)} are there")
    if not step > 0:
        step = fov / max(1, count - 1)
    limit = most if most > 0 else _NOTHING_M
    return _record(stamp, ranges, (start, step, limit), lidar, robot)


def _record(
    stamp_ns: int,
    ranges: np.ndarray[tuple[int], np.dtype[np.float32]],
    beams: tuple[float, float, float],
    lidar: np.ndarray[tuple[int], np.dtype[np.float64]],
    robot: np.ndarray[tuple[int], np.dtype[np.float64]],
) -> LogRecord:
    start, step, most = beams
    # What is at the limit met nothing.
    ranges = np.where(ranges >= 0.99 * most, np.inf, ranges).astype(np.float32)
    mount = tuple(float(value) for value in between(robot, lidar))
    scan = Scan(stamp_ns, start, step, ranges, _MIN_M, most, (mount[0], mount[1], mount[2]))
    return LogRecord(scan, robot)


_PARSERS: dict[str, Callable[[list[str]], LogRecord]] = {
    "FLASER": _flaser,
    "ROBOTLASER1": _robotlaser,
}


def _count(word: str) -> int:
    count = int(word)
    if not 0 <= count <= 100_000:
        raise ValueError(f"{count} is no number of beams")
    return count


def _pose(fields: list[str]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    pose = np.array([float(word) for word in fields])
    if len(pose) != 3 or not np.isfinite(pose).all():
        raise ValueError(
            f"'{' '.join(fields)}' is no pose" if fields else "the line ends too early"
        )
    return pose


def _stamp_ns(word: str) -> int:
    return round(float(word) * 1e9)


def _report(diagnostics: Diagnostics, span: SourceSpan, kind: str, error: Exception) -> None:
    what = "the line ends too early" if isinstance(error, IndexError) else str(error)
    diagnostics.report("mapping.bad-line", f"this {kind} line is left out: {what}", span)
