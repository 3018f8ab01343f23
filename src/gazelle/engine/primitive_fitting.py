"""Recognising tessellated cylinders and spheres.

A wheel exported from CAD is a prism with some dozens of corners. Rolling on corners shakes a
robot and lets its wheels lose the ground; the round shape that was meant rolls smoothly.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose

__all__ = ["RoundShape", "fitted_round_shape"]

Array = NDArray[np.float64]
_TOLERANCE = 2e-3
_MIN_CORNERS = 16
_MIN_SPHERE_POINTS = 60
_SPHERE_SHARE = 0.93


class RoundShape(NamedTuple):
    """A cylinder about z of its frame, or a sphere when `half_length_m` is None."""

    radius_m: float
    half_length_m: float | None
    T_mesh_shape: Pose


def fitted_round_shape(points_m: Array, volume_m3: float) -> RoundShape | None:
    """Return the cylinder or sphere whose tessellation a convex hull is, None for others.

    Args:
        points_m: corners of the hull, (N, 3).
        volume_m3: its volume.
    """
    sphere = _sphere(points_m, volume_m3)
    if sphere is not None:
        return sphere
    for axis in _candidate_axes(points_m):
        cylinder = _cylinder(points_m, axis)
        if cylinder is not None:
            return cylinder
    return None


def _sphere(points: Array, volume: float) -> RoundShape | None:
    if len(points) < _MIN_SPHERE_POINTS:
        return None
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    distances = np.linalg.norm(points - center, axis=1)
    radius = float(distances.max())
    full = 4.0 / 3.0 * math.pi * radius**3
    if np.ptp(distances) > _TOLERANCE * radius or volume < _SPHERE_SHARE * full:
        return None
    return RoundShape(radius, None, Pose(_vector(center)))


def _candidate_axes(points: Array) -> list[Array]:
    centered = points - points.mean(axis=0)
    _, vectors = np.linalg.eigh(centered.T @ centered)
    return [*np.eye(3), *vectors.T]


def _cylinder(points: Array, axis: Array) -> RoundShape | None:
    """Return the cylinder about an axis: all corners on its two rims, evenly spread."""
    heights = points @ axis
    low, high = float(heights.min()), float(heights.max())
    rotation = _frame_of(axis)
    flat = points @ rotation[:, :2]
    center = (flat.min(axis=0) + flat.max(axis=0)) / 2
    distances = np.linalg.norm(flat - center, axis=1)
    radius = float(distances.max())
    if radius <= 0 or high <= low or np.ptp(distances) > _TOLERANCE * radius:
        return None
    on_rim = np.minimum(heights - low, high - heights) <= _TOLERANCE * radius
    upper = heights > (low + high) / 2
    if not on_rim.all() or not all(_is_round(flat[side] - center) for side in (upper, ~upper)):
        return None
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = rotation @ np.array([*center, (low + high) / 2])
    return RoundShape(radius, (high - low) / 2, Pose.from_matrix(matrix))


def _is_round(rim: Array) -> bool:
    """Whether corners lie all around without a large gap."""
    if len(rim) < _MIN_CORNERS:
        return False
    angles = np.sort(np.arctan2(rim[:, 1], rim[:, 0]))
    gaps = np.diff(np.append(angles, angles[0] + 2 * math.pi))
    return bool(gaps.max() <= 2 * math.pi / _MIN_CORNERS * 1.01)


def _frame_of(axis: Array) -> Array:
    """Return a rotation whose z column is the axis."""
    reference = np.eye(3)[int(np.argmin(np.abs(axis)))]
    x = np.cross(reference, axis)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(axis, x), axis], axis=1)


def _vector(values: Array) -> tuple[float, float, float]:
    return (float(values[0]), float(values[1]), float(values[2]))
