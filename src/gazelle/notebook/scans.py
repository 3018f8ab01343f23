"""Laser scans, seen from above."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.notebook.charts import COLOURS, plane_of, sheet_bundle
from gazelle.notebook.clouds import cloud_bundle
from gazelle.notebook.drawing import INK, Dots, Label, Sheet, Stroke
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.mapping.laser_scan import Scan
    from gazelle.sensors import LidarRecord

__all__ = ["lidar_bundle", "mapping_scan_bundle", "polar_bundle"]

_MAX_BEAMS = 1440
_RINGS = 4


def lidar_bundle(record: LidarRecord) -> Bundle:
    """Return a scan; one of many rows as a cloud."""
    angles, ranges = record.angles, record.ranges_m
    if ranges.shape[0] == 1:
        return polar_bundle(angles.horizontal, ranges[0])
    flat = np.cos(angles.vertical)[:, None] * ranges
    finite = np.isfinite(ranges)
    points = np.stack(
        [
            flat * np.cos(angles.horizontal),
            flat * np.sin(angles.horizontal),
            np.sin(angles.vertical)[:, None] * ranges,
        ],
        axis=-1,
    )
    return cloud_bundle(points[finite], f"{ranges.shape[1]}×{ranges.shape[0]} beams")


def mapping_scan_bundle(scan: Scan) -> Bundle:
    """Return a scan of mapping in the robot's frame."""
    ranges = np.where(scan.hits(), scan.ranges_m, np.nan)
    return polar_bundle(scan.bearings_rad, ranges)


def polar_bundle(bearings_rad: ArrayLike, ranges_m: ArrayLike) -> Bundle:
    """Return a scan from above, x to the right, the scanner at the crossing of the axes.

    Args:
        bearings_rad: (N,), anticlockwise from x.
        ranges_m: (N,), infinite or no number where a beam met nothing.
    """
    bearings = np.asarray(bearings_rad, np.float64).ravel()
    ranges = np.asarray(ranges_m, np.float64).ravel()
    met = np.isfinite(ranges)
    words = f"{len(ranges)} beams, {int(met.sum())} met something"
    if met.any():
        words += f", {float(ranges[met].min()):.2f} m to {float(ranges[met].max()):.2f} m"
    bearings, ranges = _nearest_of_groups(bearings, np.where(met, ranges, np.nan))
    points = np.stack([ranges * np.cos(bearings), ranges * np.sin(bearings)], axis=1)
    points = points[np.isfinite(points).all(axis=1)]
    plane, width, height = plane_of(np.concatenate([points, np.zeros((1, 2))]))
    origin = plane.place(np.zeros((1, 2)))[0]
    items: list[Any] = [
        *_rings(float(np.hypot(*points.T).max(initial=0.0)), plane, (width, height))
    ]
    items.append(Dots(plane.place(points), COLOURS[3], 1.3))
    nose = np.array([[-5.0, -4.0], [7.0, 0.0], [-5.0, 4.0], [-5.0, -4.0]]) + origin
    items.append(Stroke(nose, COLOURS[0], 2.0))
    return sheet_bundle(Sheet(width, height, tuple(items)), words)


def _nearest_of_groups(
    bearings: NDArray[np.float64], ranges: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return at most 1440 beams: of neighbours, the one that met the nearest."""
    size = math.ceil(len(ranges) / _MAX_BEAMS)
    if size <= 1:
        return bearings, ranges
    missing = -len(ranges) % size
    padded = np.append(ranges, np.full(missing, np.nan))
    rows = np.where(np.isnan(padded), np.inf, padded).reshape(-1, size)
    chosen = np.arange(len(rows)) * size + rows.argmin(axis=1)
    return np.append(bearings, np.full(missing, np.nan))[chosen], padded[chosen]


def _rings(reach_m: float, plane: Any, size: tuple[float, float]) -> list[Any]:
    """Return circles of round radii around the scanner, with their radii."""
    if reach_m <= 0:
        return []
    power = 10.0 ** math.floor(math.log10(reach_m / _RINGS))
    step = next(power * one for one in (1.0, 2.0, 5.0, 10.0) if power * one * _RINGS >= reach_m)
    turn = np.linspace(0.0, 2.0 * math.pi, 73)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    items: list[Any] = []
    for number in range(1, _RINGS + 1):
        points = plane.place(number * step * circle)
        inside = ((points >= 0) & (points <= np.array(size))).all(axis=1)
        items.append(Stroke(np.where(inside[:, None], points, np.nan), INK, 0.7, 0.25))
        x, y = plane.place([[number * step, 0.0]])[0].tolist()
        if x < size[0] - 16.0:
            items.append(Label(x + 2.0, y - 3.0, f"{number * step:g} m", size=10.0, opacity=0.6))
    return items
