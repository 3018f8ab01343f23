"""Scans from depth pictures and clouds, as depthimage_to_laserscan and pointcloud_to_laserscan."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["CloudSlice", "FlatScan", "scan_of_depth", "scan_of_points"]


@dataclass(frozen=True, slots=True, eq=False)
class FlatScan:
    """A scan that something else was flattened to.

    Attributes:
        angle_min_rad, angle_max_rad, increment_rad: directions.
        ranges_m: (n,) float32; what nothing was seen in is NaN of pictures, `empty` of clouds.
    """

    angle_min_rad: float
    angle_max_rad: float
    increment_rad: float
    ranges_m: NDArray[np.float32]


def scan_of_depth(
    depth_m: NDArray[np.float64],
    *,
    fx: float,
    fy: float,
    cx: float,
    cy: float,
    rows: int = 1,
    range_min_m: float = 0.45,
    range_max_m: float = 10.0,
) -> FlatScan:
    """Return the nearest thing in each column of some rows of a depth picture.

    Args:
        depth_m: (height, width), m; 0, NaN and infinity say nothing.
        fx: focal length of the camera, pixels.
        fy: the same downwards; only looked at for being there, rows are flat.
        cx: column of the optical axis, pixels.
        cy: row of the optical axis, pixels.
        rows: how many, around the middle.
        range_min_m: nearest range that counts.
        range_max_m: farthest range that counts.

    Raises:
        ValueError: there are not so many rows, or no focal length.
    """
    height, width = depth_m.shape
    if fx <= 0 or fy <= 0:
        raise ValueError("the camera's focal length is 0: its camera_info has no matrix K")
    first = int(cy - rows / 2)
    if rows < 1 or first < 0 or first + rows > height:
        raise ValueError(
            f"scan_height ( {rows} pixels) is too large for the image height, {height} pixels."
        )
    angle_max, angle_min = math.atan2(cx, fx), -math.atan2(width - 1 - cx, fx)
    increment = (angle_max - angle_min) / (width - 1)
    columns = np.arange(width)
    part = depth_m[first : first + rows]
    across = (columns - cx) / fx
    ranges = part * np.hypot(1.0, across)
    index = ((-np.arctan2(columns - cx, fx) - angle_min) / increment).astype(np.int64)
    fits = np.isfinite(ranges) & (part > 0) & (ranges >= range_min_m) & (ranges <= range_max_m)
    nearest = np.where(fits, ranges, np.inf).min(axis=0)
    found = np.full(width, np.inf)
    np.minimum.at(found, index.clip(0, width - 1), nearest)
    found[np.isinf(found)] = np.nan
    return FlatScan(angle_min, angle_max, increment, found.astype(np.float32))


@dataclass(frozen=True, slots=True)
class CloudSlice:
    """Which points of a cloud are flattened to a scan.

    Attributes:
        angle_min_rad: first direction.
        angle_max_rad: last direction.
        increment_rad: from one direction to the next.
        low_m: lowest height that counts.
        high_m: highest height that counts.
        range_min_m: nearest distance on the ground that counts.
        range_max_m: farthest distance that counts.
        empty: what directions without a point say.
    """

    angle_min_rad: float = -math.pi
    angle_max_rad: float = math.pi
    increment_rad: float = math.pi / 180
    low_m: float = -math.inf
    high_m: float = math.inf
    range_min_m: float = 0.0
    range_max_m: float = math.inf
    empty: float = math.inf


_EVERYTHING = CloudSlice()


def scan_of_points(points_m: NDArray[np.float64], counted: CloudSlice = _EVERYTHING) -> FlatScan:
    """Return the nearest point in each direction, of those in a layer of heights.

    Args:
        points_m: (n, 3) in the frame of the scan.
        counted: which of them count.

    Raises:
        ValueError: the directions are no directions.
    """
    first, last, step = counted.angle_min_rad, counted.angle_max_rad, counted.increment_rad
    if step <= 0 or last <= first:
        raise ValueError("angle_increment must be above 0 and angle_max above angle_min")
    count = math.ceil((last - first) / step)
    x, y, z = points_m.T
    ranges, angles = np.hypot(x, y), np.arctan2(y, x)
    fits = np.isfinite(points_m).all(axis=1) & (z >= counted.low_m) & (z <= counted.high_m)
    fits &= (ranges >= counted.range_min_m) & (ranges <= counted.range_max_m)
    fits &= (angles >= first) & (angles <= last)
    index = ((angles[fits] - first) / step).astype(np.int64)
    found = np.full(count, np.inf)
    np.minimum.at(found, index.clip(0, count - 1), ranges[fits])
    found[np.isinf(found)] = counted.empty
    return FlatScan(first, last, step, found.astype(np.float32))
