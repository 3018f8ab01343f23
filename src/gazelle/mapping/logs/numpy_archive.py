"""Logs as numpy archives: ``t`` (n, s), ``scans`` (n, beams, m), ``odo`` (n, 3: m, m, rad).

Optional: ``angle_min``, ``angle_increment`` (rad; without them 180°, the first beam at −90°),
``range_max`` (m; 20 without it: what is as far met nothing), ``lidar`` (x, y, yaw on the robot).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.npz_files import ArchiveError, read_arrays
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.logs.log_record import LogRecord

__all__ = ["read_archive"]

_NEEDED = ("t", "scans", "odo")
_RANGE_MAX_M = 20.0
_MIN_M = 0.05


def read_archive(path: Path, diagnostics: Diagnostics) -> Iterator[LogRecord]:
    """Yield the scans of a numpy archive; what is wrong with it is reported."""
    try:
        columns: dict[str, Any] = read_arrays(path)
    except (OSError, ArchiveError) as error:
        diagnostics.report(
            "mapping.log-unreadable", f"this is no numpy archive: {error}", SourceSpan(str(path))
        )
        return
    problem = _problem(columns)
    if problem:
        diagnostics.report("mapping.log-unreadable", problem, SourceSpan(str(path)))
        return
    yield from _records(columns)


def _problem(columns: dict[str, Any]) -> str:
    missing = [name for name in _NEEDED if name not in columns]
    if missing:
        hints = [did_you_mean(name, columns) for name in missing]
        return (
            f"the archive has no {' and no '.join(missing)}, but {', '.join(sorted(columns))}; "
            f"t, scans and odo are needed. {' '.join(hints)}".rstrip()
        )
    times, scans, odometry = (columns[name] for name in _NEEDED)
    if scans.ndim != 2 or odometry.shape != (len(scans), 3) or times.shape != (len(scans),):
        return (
            f"t is {times.shape}, scans {scans.shape}, odo {odometry.shape}; "
            "(n,), (n, beams) and (n, 3) are needed"
        )
    return ""


def _records(columns: dict[str, Any]) -> Iterator[LogRecord]:
    times, scans, odometry = (columns[name] for name in _NEEDED)
    start = float(columns.get("angle_min", -math.pi / 2))
    step = float(columns.get("angle_increment", math.pi / max(1, scans.shape[1])))
    most = float(columns.get("range_max", _RANGE_MAX_M))
    mount = tuple(float(value) for value in columns.get("lidar", np.zeros(3)))
    for time_s, ranges, pose in zip(times, scans, odometry, strict=True):
        seen = np.where(ranges >= most, np.inf, ranges).astype(np.float32)
        stamp_ns = round(float(time_s) * 1e9)
        lidar = (mount[0], mount[1], mount[2])
        scan = Scan(stamp_ns, start, step, seen, _MIN_M, most, lidar)
        yield LogRecord(scan, np.asarray(pose, dtype=float))
