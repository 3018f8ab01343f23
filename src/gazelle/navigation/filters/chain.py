"""The filters of the package laser_filters, by their names."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.filters.record import ScanArrays

__all__ = ["FILTERS", "REFUSED_FILTERS", "FilterSetup", "apply_chain"]

Transform = Callable[[str, NDArray[np.float64]], NDArray[np.float64]]
"""Takes a frame and points of the lidar's frame (n, 3), returns them in that frame."""


@dataclass(frozen=True, slots=True)
class FilterSetup:
    """One filter of a chain.

    Attributes:
        name: its own.
        type: with or without the package.
        params: its parameters; the names and defaults are those of laser_filters.
    """

    name: str
    type: str
    params: Mapping[str, Any] = field(default_factory=dict)

    def number(self, key: str, default: float) -> float:
        """Return a number; text such as ``.inf`` is read too.

        Raises:
            ValueError: it is none.
        """
        value = self.params.get(key, default)
        try:
            return float(str(value).replace(".inf", "inf").replace(".nan", "nan"))
        except ValueError:
            raise ValueError(f"filter {self.name}: {key} is {value!r}, not a number") from None


def apply_chain(scan: ScanArrays, chain: Iterable[FilterSetup], transform: Transform) -> ScanArrays:
    """Return a scan after all filters, one after the other.

    Raises:
        KeyError: a type is not in `FILTERS`.
        ValueError: a parameter is none.
    """
    for one in chain:
        scan = FILTERS[one.type.rpartition("/")[2]](scan, one, transform)
    return scan


def _without(scan: ScanArrays, gone: NDArray[np.bool_], value: float = math.nan) -> ScanArrays:
    return replace(scan, ranges_m=np.where(gone, value, scan.ranges_m))


def _range(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    low, high = setup.number("lower_threshold", 0.0), setup.number("upper_threshold", 100000.0)
    if setup.params.get("use_message_range_limits"):
        low, high = scan.range_min_m, scan.range_max_m
    below = _without(scan, scan.ranges_m <= low, setup.number("lower_replacement_value", math.nan))
    above = setup.number("upper_replacement_value", math.nan)
    return _without(below, scan.ranges_m >= high, above)


def _bounds(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    low, high = setup.number("lower_angle", 0.0), setup.number("upper_angle", 0.0)
    angles = scan.angles_rad
    kept = (angles >= low - 1e-9) & (angles <= high + 1e-9)
    first = float(angles[kept][0]) if kept.any() else low
    held = scan.intensities[kept] if len(scan.intensities) else scan.intensities
    return replace(scan, angle_min_rad=first, ranges_m=scan.ranges_m[kept], intensities=held)


def _bounds_in_place(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    low, high = setup.number("lower_angle", 0.0), setup.number("upper_angle", 0.0)
    angles = scan.angles_rad
    return _without(scan, (angles > low) & (angles < high), scan.range_max_m + 1.0)


def _intensity(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    if not len(scan.intensities):
        return scan
    low, high = setup.number("lower_threshold", 8000.0), setup.number("upper_threshold", 100000.0)
    gone = np.asarray((scan.intensities <= low) | (scan.intensities >= high))
    return _without(scan, np.asarray(gone != bool(setup.params.get("invert")), bool))


def _box(scan: ScanArrays, setup: FilterSetup, transform: Transform) -> ScanArrays:
    frame = str(setup.params.get("box_frame", ""))
    flat = scan.points
    points = transform(frame, np.column_stack([flat, np.zeros(len(flat))]))
    inside = np.isfinite(points).all(axis=1)
    for axis, name in enumerate("xyz"):
        low, high = setup.number(f"min_{name}", 0.0), setup.number(f"max_{name}", 0.0)
        inside &= (points[:, axis] > low) & (points[:, axis] < high)
    outside = np.isfinite(points).all(axis=1) & ~inside
    gone = outside if setup.params.get("invert") else inside
    return _without(scan, np.asarray(gone, bool))


def _shadows(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    """Take out points behind edges: what lies on a line almost along the beam."""
    low, high = (
        math.radians(setup.number(key, default))
        for key, default in (("min_angle", 10.0), ("max_angle", 170.0))
    )
    window, neighbours = int(setup.number("window", 1)), int(setup.number("neighbors", 20))
    ranges, count = scan.ranges_m, len(scan.ranges_m)
    gone = np.zeros(count, bool)
    for offset in (k for k in range(-window, window + 1) if k):
        i = np.arange(max(0, -offset), count - max(0, offset))
        turn = abs(offset) * abs(scan.increment_rad)
        here, there = ranges[i], ranges[i + offset]
        # Angle at the point between its beam and the line to its neighbour.
        with np.errstate(invalid="ignore"):
            across = there * math.sin(turn)
            angle = np.abs(np.arctan2(across, here - there * math.cos(turn)))
            flat = np.isfinite(angle) & ((angle < low) | (angle > high))
        for k in i[flat]:
            first, last = max(k - neighbours, 0), min(k + neighbours, count - 1) + 1
            part = ranges[first:last]
            gone[first:last] |= part > ranges[k]
    if setup.params.get("remove_shadow_start_point"):
        gone |= np.isnan(ranges)
    return _without(scan, gone)


def _interpolation(scan: ScanArrays, _setup: FilterSetup, _transform: Transform) -> ScanArrays:
    ranges = scan.ranges_m
    good = np.isfinite(ranges) & (ranges > scan.range_min_m) & (ranges < scan.range_max_m)
    if not good.any():
        return scan
    k = np.arange(len(ranges))
    filled = np.interp(k, k[good], ranges[good])
    within = (k >= k[good][0]) & (k <= k[good][-1])
    return replace(scan, ranges_m=np.where(good | ~within, ranges, filled))


def _median(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    half = int(setup.number("window_size", 3)) // 2
    padded = np.pad(scan.ranges_m, half, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    unknown = np.isnan(scan.ranges_m)
    return replace(scan, ranges_m=np.where(unknown, math.nan, _nan_median(windows)))


def _nan_median(windows: NDArray[np.float64]) -> NDArray[np.float64]:
    ordered = np.sort(windows, axis=1)
    counts = (~np.isnan(windows)).sum(axis=1)
    middle = np.maximum(counts - 1, 0) // 2
    return np.asarray(ordered[np.arange(len(windows)), middle])


def _speckle(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    """Take out beams that no neighbour within a window agrees with."""
    most = setup.number("max_range", 2.0)
    difference = setup.number("max_range_difference", 0.1)
    window = int(setup.number("filter_window", 2))
    ranges, count = scan.ranges_m, len(scan.ranges_m)
    agrees = np.zeros(count, bool)
    for offset in range(1, window):
        with np.errstate(invalid="ignore"):
            same = np.abs(ranges[offset:] - ranges[:-offset]) < difference
        agrees[offset:] |= same
        agrees[:-offset] |= same
    return _without(scan, ~agrees & (ranges < most))


def _sector(scan: ScanArrays, setup: FilterSetup, _transform: Transform) -> ScanArrays:
    first, last = setup.number("angle_min", 0.0), setup.number("angle_max", 0.0)
    low, high = setup.number("range_min", 0.0), setup.number("range_max", scan.range_max_m)
    angles, ranges = scan.angles_rad, scan.ranges_m
    inside = (angles >= first) & (angles <= last) & (ranges >= low) & (ranges <= high)
    gone = inside if setup.params.get("clear_inside", True) else ~inside
    return _without(scan, gone, scan.range_max_m + 1.0)


def _footprint(scan: ScanArrays, setup: FilterSetup, transform: Transform) -> ScanArrays:
    radius = setup.number("inscribed_radius", 0.0)
    flat = scan.points
    points = transform(str(setup.params.get("target_frame", "base_link")),
                       np.column_stack([flat, np.zeros(len(flat))]))  # fmt: skip
    with np.errstate(invalid="ignore"):
        return _without(scan, np.abs(points[:, :2]).max(axis=1) < radius)


_Filter = Callable[[ScanArrays, FilterSetup, Transform], ScanArrays]

FILTERS: Mapping[str, _Filter] = {
    "LaserScanRangeFilter": _range,
    "LaserScanAngularBoundsFilter": _bounds,
    "LaserScanAngularBoundsFilterInPlace": _bounds_in_place,
    "LaserScanIntensityFilter": _intensity,
    "LaserScanBoxFilter": _box,
    "ScanShadowsFilter": _shadows,
    "InterpolationFilter": _interpolation,
    "LaserMedianSpatialFilter": _median,
    "LaserScanSpeckleFilter": _speckle,
    "LaserScanSectorFilter": _sector,
    "LaserScanFootprintFilter": _footprint,
}
"""Filters by type, without the package's name."""

REFUSED_FILTERS: Mapping[str, str] = {
    "LaserArrayFilter": "it runs chains of the package filters over time; LaserMedianSpatialFilter "
    "smooths over neighbours",
    "LaserScanMaskFilter": "LaserScanSectorFilter and LaserScanAngularBoundsFilterInPlace take "
    "out beams by angle",
    "LaserScanPolygonFilter": "LaserScanBoxFilter takes out beams by place",
    "LaserMedianFilter": "LaserMedianSpatialFilter smooths over neighbours",
}
"""Why a filter is not there, and what is."""
