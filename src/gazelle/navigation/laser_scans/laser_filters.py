"""The filters of the package laser_filters, by their names, with their parameters and defaults."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.parameters import Parameter, refused
from gazelle.parameters.dataclass_tables import flag, integer, number, text

__all__ = [
    "FILTERS",
    "REFUSED_FILTERS",
    "BoundsOptions",
    "BoxOptions",
    "FilterSetup",
    "FootprintOptions",
    "IntensityOptions",
    "InterpolationOptions",
    "MedianOptions",
    "RangeOptions",
    "ScanArrays",
    "ScanFilter",
    "SectorOptions",
    "ShadowOptions",
    "SpeckleOptions",
    "apply_chain",
]


@dataclass(frozen=True, slots=True)
class RangeOptions:
    """``LaserScanRangeFilter``."""

    lower_threshold: float = number(0.0, "nearer beams are taken out", "m")
    upper_threshold: float = number(100000.0, "farther beams are taken out", "m")
    use_message_range_limits: bool = flag(False, "the lidar's own limits count instead")
    lower_replacement_value: float = number(math.nan, "what nearer beams become", "m")
    upper_replacement_value: float = number(math.nan, "what farther beams become", "m")


@dataclass(frozen=True, slots=True)
class BoundsOptions:
    """``LaserScanAngularBoundsFilter`` and ``LaserScanAngularBoundsFilterInPlace``."""

    lower_angle: float = number(0.0, "where the sector begins", "rad")
    upper_angle: float = number(0.0, "where it ends", "rad")


@dataclass(frozen=True, slots=True)
class IntensityOptions:
    """``LaserScanIntensityFilter``."""

    lower_threshold: float = number(8000.0, "beams of less intensity are taken out")
    upper_threshold: float = number(100000.0, "beams of more intensity are taken out")
    invert: bool = flag(False, "the others are taken out")


@dataclass(frozen=True, slots=True)
class BoxOptions:
    """``LaserScanBoxFilter``."""

    box_frame: str = text("", "frame of the box, the lidar's when empty")
    min_x: float = number(0.0, "the box begins here", "m")
    max_x: float = number(0.0, "the box ends here", "m")
    min_y: float = number(0.0, "the box begins here", "m")
    max_y: float = number(0.0, "the box ends here", "m")
    min_z: float = number(0.0, "the box begins here", "m")
    max_z: float = number(0.0, "the box ends here", "m")
    invert: bool = flag(False, "what lies outside is taken out")


@dataclass(frozen=True, slots=True)
class ShadowOptions:
    """``ScanShadowsFilter``."""

    min_angle: float = number(10.0, "flatter lines between neighbours are shadows", "deg")
    max_angle: float = number(170.0, "and so are those beyond", "deg")
    window: int = integer(1, "neighbours that are looked at on each side")
    neighbors: int = integer(20, "farther beams so near to a shadow are taken out")
    remove_shadow_start_point: bool = flag(False, "take out beams without a range, too")


@dataclass(frozen=True, slots=True)
class InterpolationOptions:
    """``InterpolationFilter``, which has none."""


@dataclass(frozen=True, slots=True)
class MedianOptions:
    """``LaserMedianSpatialFilter``."""

    window_size: int = integer(3, "beams whose median counts")


@dataclass(frozen=True, slots=True)
class SpeckleOptions:
    """``LaserScanSpeckleFilter``."""

    max_range: float = number(2.0, "farther beams stay", "m")
    max_range_difference: float = number(0.1, "neighbours that differ by less agree", "m")
    filter_window: int = integer(2, "neighbours that are looked at, the beam among them")


@dataclass(frozen=True, slots=True)
class SectorOptions:
    """``LaserScanSectorFilter``."""

    angle_min: float = number(0.0, "where the sector begins", "rad")
    angle_max: float = number(0.0, "where it ends", "rad")
    range_min: float = number(0.0, "nearer beams are not of it", "m")
    range_max: float = number(math.inf, "farther beams are not of it; the lidar's when inf", "m")
    clear_inside: bool = flag(True, "the sector is taken out, else all but it")


@dataclass(frozen=True, slots=True)
class FootprintOptions:
    """``LaserScanFootprintFilter``."""

    inscribed_radius: float = number(0.0, "half of the square that is taken out", "m")
    target_frame: str = text("base_link", "frame in whose origin the square is")


@dataclass(frozen=True, slots=True, eq=False)
class ScanArrays:
    """A scan.

    Attributes:
        angle_min_rad: direction of the first beam.
        increment_rad: from one beam to the next.
        ranges_m: (n,).
        intensities: (n,), or empty.
        range_min_m, range_max_m: limits of the lidar.
    """

    angle_min_rad: float
    increment_rad: float
    ranges_m: NDArray[np.float64]
    intensities: NDArray[np.float64]
    range_min_m: float
    range_max_m: float

    @property
    def angles_rad(self) -> NDArray[np.float64]:
        """Directions of the beams, (n,)."""
        steps = np.arange(len(self.ranges_m), dtype=float)
        return np.asarray(self.angle_min_rad + self.increment_rad * steps, float)

    @property
    def points(self) -> NDArray[np.float64]:
        """Ends of the beams in the lidar's frame, (n, 2); NaN and infinity stay."""
        angles = self.angles_rad
        ends = np.empty((len(angles), 2))
        with np.errstate(invalid="ignore"):
            ends[:, 0] = self.ranges_m * np.cos(angles)
            ends[:, 1] = self.ranges_m * np.sin(angles)
        return ends


_Filter = Callable[[ScanArrays, Any, "Transform"], ScanArrays]

Transform = Callable[[str, NDArray[np.float64]], NDArray[np.float64]]

"""Takes a frame and points of the lidar's frame (n, 3), returns them in that frame."""


@dataclass(frozen=True, slots=True)
class FilterSetup:
    """One filter of a chain.

    Attributes:
        name: its own.
        type: with or without the package.
        options: its parameters, of the class in `FILTERS`.
    """

    name: str
    type: str
    options: Any


class ScanFilter(NamedTuple):
    """A filter: what it does, and the class of its parameters.

    Attributes:
        apply: takes the scan and the parameters.
        options: see `gazelle.parameters.dataclass_tables`.
        does: one line about it.
        idle: rows of parameters that have no effect here.
    """

    apply: _Filter
    options: type
    does: str
    idle: tuple[Parameter, ...] = ()


def apply_chain(scan: ScanArrays, chain: Iterable[FilterSetup], transform: Transform) -> ScanArrays:
    """Return a scan after all filters, one after the other.

    Raises:
        KeyError: a type is not in `FILTERS`.
        ValueError: it cannot be filtered so.
    """
    for one in chain:
        scan = FILTERS[one.type.rpartition("/")[2]].apply(scan, one.options, transform)
    return scan


def _without(scan: ScanArrays, gone: NDArray[np.bool_], value: float = math.nan) -> ScanArrays:
    return replace(scan, ranges_m=np.where(gone, value, scan.ranges_m))


def _range(scan: ScanArrays, options: RangeOptions, _transform: Transform) -> ScanArrays:
    low, high = options.lower_threshold, options.upper_threshold
    if options.use_message_range_limits:
        low, high = scan.range_min_m, scan.range_max_m
    below = _without(scan, scan.ranges_m <= low, options.lower_replacement_value)
    return _without(below, scan.ranges_m >= high, options.upper_replacement_value)


def _bounds(scan: ScanArrays, options: BoundsOptions, _transform: Transform) -> ScanArrays:
    low, high = options.lower_angle, options.upper_angle
    angles = scan.angles_rad
    kept = (angles >= low - 1e-9) & (angles <= high + 1e-9)
    first = float(angles[kept][0]) if kept.any() else low
    held = scan.intensities[kept] if len(scan.intensities) else scan.intensities
    return replace(scan, angle_min_rad=first, ranges_m=scan.ranges_m[kept], intensities=held)


def _bounds_in_place(scan: ScanArrays, options: BoundsOptions, _transform: Transform) -> ScanArrays:
    angles = scan.angles_rad
    inside = (angles > options.lower_angle) & (angles < options.upper_angle)
    return _without(scan, inside, scan.range_max_m + 1.0)


def _intensity(scan: ScanArrays, options: IntensityOptions, _transform: Transform) -> ScanArrays:
    if not len(scan.intensities):
        return scan
    low, high = options.lower_threshold, options.upper_threshold
    gone = np.asarray((scan.intensities <= low) | (scan.intensities >= high))
    return _without(scan, np.asarray(gone != options.invert, bool))


def _box(scan: ScanArrays, options: BoxOptions, transform: Transform) -> ScanArrays:
    flat = scan.points
    points = transform(options.box_frame, np.column_stack([flat, np.zeros(len(flat))]))
    inside = np.isfinite(points).all(axis=1)
    o = options
    for axis, (low, high) in enumerate(
        ((o.min_x, o.max_x), (o.min_y, o.max_y), (o.min_z, o.max_z))
    ):
        inside &= (points[:, axis] > low) & (points[:, axis] < high)
    outside = np.isfinite(points).all(axis=1) & ~inside
    gone = outside if options.invert else inside
    return _without(scan, np.asarray(gone, bool))


def _shadows(scan: ScanArrays, options: ShadowOptions, _transform: Transform) -> ScanArrays:
    """Take out points behind edges: what lies on a line almost along the beam."""
    low, high = math.radians(options.min_angle), math.radians(options.max_angle)
    window, neighbours = options.window, options.neighbors
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
    if options.remove_shadow_start_point:
        gone |= np.isnan(ranges)
    return _without(scan, gone)


def _interpolation(
    scan: ScanArrays, _options: InterpolationOptions, _transform: Transform
) -> ScanArrays:
    ranges = scan.ranges_m
    good = np.isfinite(ranges) & (ranges > scan.range_min_m) & (ranges < scan.range_max_m)
    if not good.any():
        return scan
    k = np.arange(len(ranges))
    filled = np.interp(k, k[good], ranges[good])
    within = (k >= k[good][0]) & (k <= k[good][-1])
    return replace(scan, ranges_m=np.where(good | ~within, ranges, filled))


def _median(scan: ScanArrays, options: MedianOptions, _transform: Transform) -> ScanArrays:
    half = options.window_size // 2
    padded = np.pad(scan.ranges_m, half, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    unknown = np.isnan(scan.ranges_m)
    return replace(scan, ranges_m=np.where(unknown, math.nan, _nan_median(windows)))


def _nan_median(windows: NDArray[np.float64]) -> NDArray[np.float64]:
    ordered = np.sort(windows, axis=1)
    counts = (~np.isnan(windows)).sum(axis=1)
    middle = np.maximum(counts - 1, 0) // 2
    return np.asarray(ordered[np.arange(len(windows)), middle])


def _speckle(scan: ScanArrays, options: SpeckleOptions, _transform: Transform) -> ScanArrays:
    """Take out beams that no neighbour within a window agrees with."""
    ranges, count = scan.ranges_m, len(scan.ranges_m)
    agrees = np.zeros(count, bool)
    for offset in range(1, options.filter_window):
        with np.errstate(invalid="ignore"):
            same = np.abs(ranges[offset:] - ranges[:-offset]) < options.max_range_difference
        agrees[offset:] |= same
        agrees[:-offset] |= same
    return _without(scan, ~agrees & (ranges < options.max_range))


def _sector(scan: ScanArrays, options: SectorOptions, _transform: Transform) -> ScanArrays:
    high = scan.range_max_m if math.isinf(options.range_max) else options.range_max
    angles, ranges = scan.angles_rad, scan.ranges_m
    inside = (angles >= options.angle_min) & (angles <= options.angle_max)
    inside &= (ranges >= options.range_min) & (ranges <= high)
    gone = inside if options.clear_inside else ~inside
    return _without(scan, gone, scan.range_max_m + 1.0)


def _footprint(scan: ScanArrays, options: FootprintOptions, transform: Transform) -> ScanArrays:
    flat = scan.points
    points = transform(options.target_frame, np.column_stack([flat, np.zeros(len(flat))]))
    with np.errstate(invalid="ignore"):
        return _without(scan, np.abs(points[:, :2]).max(axis=1) < options.inscribed_radius)


FILTERS: Mapping[str, ScanFilter] = {
    "LaserScanRangeFilter": ScanFilter(_range, RangeOptions, "Takes out beams by range."),
    "LaserScanAngularBoundsFilter": ScanFilter(
        _bounds, BoundsOptions, "Cuts the scan to a sector."
    ),
    "LaserScanAngularBoundsFilterInPlace": ScanFilter(
        _bounds_in_place, BoundsOptions, "Puts the beams of a sector out of range."
    ),
    "LaserScanIntensityFilter": ScanFilter(
        _intensity,
        IntensityOptions,
        "Takes out beams by intensity.",
        (
            *refused("ranges are taken out", "filter_override_range", unless=True),
            *refused("intensities stay", "filter_override_intensity", unless=False),
            *refused("no histogram is printed", "disp_histogram", unless=0),
        ),
    ),
    "LaserScanBoxFilter": ScanFilter(_box, BoxOptions, "Takes out what lies in a box."),
    "ScanShadowsFilter": ScanFilter(
        _shadows, ShadowOptions, "Takes out what is seen between an edge and what is behind it."
    ),
    "InterpolationFilter": ScanFilter(
        _interpolation, InterpolationOptions, "Fills beams without a range from their neighbours."
    ),
    "LaserMedianSpatialFilter": ScanFilter(
        _median, MedianOptions, "Gives each beam the median of its neighbours."
    ),
    "LaserScanSpeckleFilter": ScanFilter(
        _speckle,
        SpeckleOptions,
        "Takes out beams that no neighbour agrees with.",
        refused("ranges are compared", "filter_type", unless=0),
    ),
    "LaserScanSectorFilter": ScanFilter(
        _sector,
        SectorOptions,
        "Puts a sector out of range.",
        refused("clear_inside: false does that", "invert", unless=False),
    ),
    "LaserScanFootprintFilter": ScanFilter(
        _footprint, FootprintOptions, "Takes out what lies in the robot."
    ),
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
