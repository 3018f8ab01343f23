"""Parameters of the filters of the package laser_filters, with its names and defaults."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.parameters.dataclass_tables import flag, integer, number, text

__all__ = [
    "BoundsOptions",
    "BoxOptions",
    "FootprintOptions",
    "IntensityOptions",
    "InterpolationOptions",
    "MedianOptions",
    "RangeOptions",
    "SectorOptions",
    "ShadowOptions",
    "SpeckleOptions",
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
