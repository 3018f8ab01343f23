"""What a sensor saw at one time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import compose, transform_points

__all__ = ["Observation", "observation_of_scan"]


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """Points in the costmap's frame.

    Attributes:
        stamp_ns: when they were seen.
        origin: x, y, z of the sensor, m.
        points: what is there, (n, 3), m; it marks, and clears what is before it.
        ends: ends of beams that met nothing, (m, 3), m; they only clear.
    """

    stamp_ns: int
    origin: tuple[float, float, float]
    points: NDArray[np.float64]
    ends: NDArray[np.float64] | None = None


def observation_of_scan(
    scan: Scan,
    T_global_base: tuple[float, float, float],
    *,
    height_m: float = 0.0,
    inf_is_valid: bool = False,
) -> Observation:
    """Return what a scan shows.

    Args:
        scan: the scan.
        T_global_base: the robot in the costmap's frame at the time of the scan.
        height_m: of the lidar above the ground, m.
        inf_is_valid: beams of infinite range clear up to just below the largest range, as the
            parameter of this name says; without it they say nothing.
    """
    pose = tuple(map(float, compose(T_global_base, scan.T_base_laser)))
    flat = transform_points(T_global_base, scan.points())
    ends = _beam_ends(scan, pose) if inf_is_valid else np.zeros((0, 2))
    return Observation(
        scan.stamp_ns,
        (pose[0], pose[1], height_m),
        _raised(flat, height_m),
        _raised(ends, height_m),
    )


def _beam_ends(scan: Scan, pose: tuple[float, ...]) -> NDArray[np.float64]:
    nothing = np.isposinf(scan.ranges_m)
    angles = scan.angles_rad[nothing] * (-1.0 if scan.upside_down else 1.0)
    # costmap_2d puts such beams 0.1 mm inside of the largest range.
    reach = scan.range_max_m - 1e-4
    ends = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=-1)
    return transform_points(pose, ends)


def _raised(points: NDArray[np.float64], height_m: float) -> NDArray[np.float64]:
    return np.column_stack([points, np.full(len(points), height_m)])
