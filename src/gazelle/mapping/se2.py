"""Poses in the plane, SE(2): (x_m, y_m, yaw_rad), as rows of float64 arrays.

Every function takes single poses, shape (3,), and stacks of them, shape (…, 3). ``a ⊕ b`` is the
pose b, given in the frame a, in the frame that a is given in; ``a ⊖ b`` is b seen from a.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Poses", "between", "compose", "inverse", "transform_points", "wrap_angle"]

Poses = NDArray[np.float64]


def wrap_angle(angle_rad: ArrayLike) -> NDArray[np.float64]:
    """Return the same directions, in their shape, within [−π, π)."""
    return np.asarray((np.asarray(angle_rad, dtype=float) + np.pi) % (2 * np.pi) - np.pi)


def compose(first: ArrayLike, second: ArrayLike) -> Poses:
    """Return ``first ⊕ second``, shape (…, 3)."""
    a, b = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    turn = wrap_angle(a[..., 2] + b[..., 2])
    out = np.empty((*turn.shape, 3))
    out[..., 0] = a[..., 0] + cos * b[..., 0] - sin * b[..., 1]
    out[..., 1] = a[..., 1] + sin * b[..., 0] + cos * b[..., 1]
    out[..., 2] = turn
    return out


def between(first: ArrayLike, second: ArrayLike) -> Poses:
    """Return ``second`` in the frame of ``first``, shape (…, 3): ``first⁻¹ ⊕ second``."""
    a, b = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    dx, dy = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    turn = wrap_angle(b[..., 2] - a[..., 2])
    out = np.empty((*turn.shape, 3))
    out[..., 0] = cos * dx + sin * dy
    out[..., 1] = cos * dy - sin * dx
    out[..., 2] = turn
    return out


def inverse(pose: ArrayLike) -> Poses:
    """Return the pose, shape (…, 3), that composes with `pose` to the identity."""
    a = np.asarray(pose, dtype=float)
    return between(a, np.zeros_like(a))


def transform_points(pose: ArrayLike, points_m: ArrayLike) -> NDArray[np.float64]:
    """Return points, shape (n, 2), given in the frame `pose`, in the frame it is given in."""
    a, points = np.asarray(pose, dtype=float), np.asarray(points_m, dtype=float)
    cos, sin = np.cos(a[2]), np.sin(a[2])
    return np.asarray(points @ np.array([[cos, sin], [-sin, cos]]) + a[:2])
