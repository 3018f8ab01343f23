"""Sonars: the nearest surface inside a cone or a sphere."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import SonarSpec
from gazelle.geometry import Pose
from gazelle.sensors.lidar import cast
from gazelle.sensors.ray_scene import RayScene

__all__ = ["SonarRecord", "sonar_range"]

_RAYS = 512
_GOLDEN_ANGLE_RAD = math.pi * (3.0 - math.sqrt(5.0))


class SonarRecord(NamedTuple):
    """Distance to the nearest surface, metres."""

    range_m: float


def sonar_range(scene: RayScene, spec: SonarSpec, T_world_sensor: Pose) -> float:
    """Return the distance to the nearest surface, metres; the largest range when there is none.

    The cone opens along −z, with `radius_m` at `max_m` (Gazebo Classic's SonarSensor, so files
    turn it: rpy 0 -1.5708 0 looks along x); a ``sphere`` looks everywhere, as far as its radius.
    512 rays are spread evenly over it (Fibonacci lattice), so that things smaller
    than a few percent of the cone can slip through.

    Args:
        scene: collisions, as Gazebo's sonar touches them.
        spec: the sonar.
        T_world_sensor: its frame.
    """
    if spec.geometry == "sphere":
        half_angle, far = math.pi, spec.radius_m
    else:
        half_angle, far = math.atan2(spec.radius_m, spec.max_m), spec.max_m
    distances, _ = cast(scene, T_world_sensor, _cone(half_angle), near_m=spec.min_m, far_m=far)
    return float(min(distances.min(), far))


@lru_cache(maxsize=16)
def _cone(half_angle_rad: float) -> NDArray[np.float32]:
    """Return unit vectors about −z, the axis itself first, equally dense over the solid angle."""
    number = np.arange(_RAYS)
    along = 1.0 - number / (_RAYS - 1) * (1.0 - math.cos(half_angle_rad))
    aside = np.sqrt(np.maximum(0.0, 1.0 - along * along))
    turn = number * _GOLDEN_ANGLE_RAD
    vectors = np.stack([aside * np.cos(turn), aside * np.sin(turn), -along], axis=1)
    return np.ascontiguousarray(vectors, np.float32)
