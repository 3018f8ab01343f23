"""One scan of a planar lidar, as mapping, localisation and costmaps take it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.se2 import transform_points
from gazelle.rich_display import shown_by

__all__ = ["Scan"]


@shown_by("scans:mapping_scan_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """A scan of a lidar whose plane is parallel to the ground.

    Attributes:
        stamp_ns: time of the first beam.
        angle_min_rad: direction of the first beam in the lidar's frame.
        angle_increment_rad: from one beam to the next, negative for clockwise lidars.
        ranges_m: float32, shape (n,); infinity, NaN and everything outside of the limits are
            beams that met nothing or that say nothing.
        range_min_m, range_max_m: a range is a measurement within these limits, as REP 117 says.
        T_base_laser: the lidar in the robot's frame, (x_m, y_m, yaw_rad).
        upside_down: the lidar's z axis points to the ground.
    """

    stamp_ns: int
    angle_min_rad: float
    angle_increment_rad: float
    ranges_m: NDArray[np.float32]
    range_min_m: float
    range_max_m: float
    T_base_laser: tuple[float, float, float] = (0.0, 0.0, 0.0)
    upside_down: bool = False

    @property
    def angles_rad(self) -> NDArray[np.float64]:
        """Directions of the beams in the lidar's own frame, shape (n,)."""
        beams = np.arange(len(self.ranges_m), dtype=np.float64)
        return np.asarray(self.angle_min_rad + self.angle_increment_rad * beams)

    @property
    def bearings_rad(self) -> NDArray[np.float64]:
        """Directions of the beams in the robot's frame, shape (n,), not wrapped."""
        sign = -1.0 if self.upside_down else 1.0
        return self.T_base_laser[2] + sign * self.angles_rad

    def hits(self, max_range_m: float = math.inf) -> NDArray[np.bool_]:
        """Return which beams met something, shape (n,).

        Args:
            max_range_m: what is farther than this counts as nothing.
        """
        ranges = self.ranges_m
        # Comparisons with NaN are false.
        limit = min(self.range_max_m, max_range_m)
        return np.asarray((ranges >= self.range_min_m) & (ranges <= limit) & (ranges > 0))

    def points(self, max_range_m: float = math.inf) -> NDArray[np.float64]:
        """Return what the beams met, in the robot's frame, metres, shape (m, 2), m ≤ n."""
        keep = self.hits(max_range_m)
        ranges = self.ranges_m[keep].astype(float)
        angles = self.angles_rad[keep] * (-1.0 if self.upside_down else 1.0)
        ends = np.stack([ranges * np.cos(angles), ranges * np.sin(angles)], axis=-1)
        return transform_points(self.T_base_laser, ends)
