"""How far one orientation is from another, in the two ways that MoveIt measures it."""

from __future__ import annotations

import enum
import math

import numpy as np

from gazelle.motion.space import FloatArray

__all__ = ["Parameterization", "euler_xyz", "matrix_of", "rotation_error", "rotation_vector"]


class Parameterization(enum.IntEnum):
    """``moveit_msgs/OrientationConstraint.parameterization``."""

    XYZ_EULER_ANGLES = 0
    ROTATION_VECTOR = 1


def euler_xyz(rotation: FloatArray) -> FloatArray:
    """Return angles about x, then the new y, then the new z (Eigen's ``eulerAngles(0, 1, 2)``)."""
    middle = math.asin(max(-1.0, min(1.0, float(rotation[0, 2]))))
    first = math.atan2(-rotation[1, 2], rotation[2, 2])
    last = math.atan2(-rotation[0, 1], rotation[0, 0])
    return np.array([first, middle, last])


def rotation_vector(rotation: FloatArray) -> FloatArray:
    """Return the axis of a rotation (3, 3) times its angle, (3,), rad."""
    twice_sine = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    norm = float(np.linalg.norm(twice_sine))
    angle = math.atan2(norm, float(np.trace(rotation)) - 1.0)
    if norm > 1e-7:
        return twice_sine * (angle / norm)
    if angle < 1.0:
        return twice_sine * 0.5
    # Half a turn: the axis is the column of (R + I) / 2 that is longest.
    columns = (rotation + np.eye(3)) / 2.0
    column = columns[:, int(np.diag(columns).argmax())]
    axis: FloatArray = column / np.linalg.norm(column) * angle
    return axis


def matrix_of(angles: FloatArray, kind: Parameterization) -> FloatArray:
    """Return the rotation (3, 3) whose error is `angles` (3,); `rotation_error` inverted."""
    if kind is Parameterization.ROTATION_VECTOR:
        angle = float(np.linalg.norm(angles))
        if angle == 0.0:
            return np.eye(3)
        x, y, z = angles / angle
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        turned: FloatArray = (
            np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
        )
        return turned
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles), np.sin(angles)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, ca, -sa], [0.0, sa, ca]])
    about_y = np.array([[cb, 0.0, sb], [0.0, 1.0, 0.0], [-sb, 0.0, cb]])
    about_z = np.array([[cc, -sc, 0.0], [sc, cc, 0.0], [0.0, 0.0, 1.0]])
    product: FloatArray = about_x @ about_y @ about_z
    return product


def rotation_error(wanted: FloatArray, actual: FloatArray, kind: Parameterization) -> FloatArray:
    """Return how far `actual` is from `wanted` (3×3 each), about the axes of `wanted`, rad."""
    difference = wanted.T @ actual
    if kind is Parameterization.ROTATION_VECTOR:
        return rotation_vector(difference)
    return euler_xyz(difference)
