"""A scan as arrays that filters change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["ScanArrays"]


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
