"""The functions of ``tf.transformations`` that programs call; quaternions are (x, y, z, w).

Euler angles follow the names of the original: ``s`` or ``r`` for static or rotating axes, then
the three axes, such as ``sxyz`` (roll, pitch, yaw about fixed axes: the default and ROS's own).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.geometry import Pose

__all__ = [
    "concatenate_matrices",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random_quaternion",
    "rotation_from_matrix",
    "rotation_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]

Matrix = NDArray[np.float64]
Quaternion = Sequence[float] | NDArray[np.float64]
_AXES = {"x": 0, "y": 1, "z": 2}
_SMALL = 1e-12


def identity_matrix() -> Matrix:
    """Return the 4×4 identity."""
    return np.identity(4)


def translation_matrix(direction: ArrayLike) -> Matrix:
    """Return the 4×4 matrix of a translation."""
    matrix = np.identity(4)
    matrix[:3, 3] = np.asarray(direction, float)[:3]
    return matrix


def translation_from_matrix(matrix: ArrayLike) -> Matrix:
    """Return the translation of a 4×4 matrix."""
    return np.array(np.asarray(matrix, float)[:3, 3])


def rotation_matrix(
    angle: float, direction: Sequence[float], point: ArrayLike | None = None
) -> Matrix:
    """Return the 4×4 matrix of a turn about an axis, through a point if one is given."""
    matrix = quaternion_matrix(quaternion_about_axis(angle, direction))
    if point is not None:
        centre = np.asarray(point, float)[:3]
        matrix[:3, 3] = centre - matrix[:3, :3] @ centre
    return matrix


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix]:
    """Return angle (rad), axis (x, y, z) and a point (x, y, z, 1) of a turn, a 4×4 matrix."""
    full = np.asarray(matrix, float)
    x, y, z, w = quaternion_from_matrix(full)
    axis = np.array([x, y, z])
    length = float(np.linalg.norm(axis))
    axis = axis / length if length > _SMALL else np.array([0.0, 0.0, 1.0])
    point = np.linalg.pinv(np.identity(3) - full[:3, :3]) @ full[:3, 3]
    return 2 * math.atan2(length, w), axis, np.append(point, 1.0)


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Matrix:
    """Return the 4×4 matrix of three turns."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Matrix:
    """Return the quaternion (x, y, z, w) of three turns, in radians.

    Raises:
        ValueError: `axes` is no axis order.
    """
    frame, order = _axes(axes)
    turns = [quaternion_about_axis(angle, np.identity(3)[axis]) for angle, axis in
             zip((ai, aj, ak), order, strict=True)]  # fmt: skip
    if frame == "s":
        turns.reverse()
    return quaternion_multiply(quaternion_multiply(turns[0], turns[1]), turns[2])


def euler_from_matrix(matrix: ArrayLike, axes: str = "sxyz") -> tuple[float, float, float]:
    """Return the three angles (rad) of a rotation, 3×3 or 4×4; at a pole the last one is zero.

    Raises:
        ValueError: `axes` is no axis order.
    """
    frame, order = _axes(axes)
    rotation = np.asarray(matrix, float)[:3, :3]
    # Turns about rotating axes are turns about fixed ones in the opposite order.
    i, j, k = order if frame == "s" else order[::-1]
    angles = _repeated(rotation, i, j) if i == k else _distinct(rotation, i, j, k)
    return angles if frame == "s" else (angles[2], angles[1], angles[0])


def euler_from_quaternion(quaternion: Quaternion, axes: str = "sxyz") -> tuple[float, float, float]:
    """Return the three angles (rad) of a quaternion (x, y, z, w)."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def quaternion_about_axis(angle: float, axis: ArrayLike) -> Matrix:
    """Return the quaternion (x, y, z, w) of a turn by an angle (rad) about an axis (x, y, z)."""
    direction = unit_vector(np.asarray(axis, float)[:3])
    return np.append(direction * math.sin(angle / 2), math.cos(angle / 2))


def quaternion_matrix(quaternion: Quaternion) -> Matrix:
    """Return the 4×4 matrix of a quaternion, the identity for one of length zero."""
    values = np.asarray(quaternion, float)
    length = float(np.linalg.norm(values))
    if length < _SMALL:
        return np.identity(4)
    x, y, z, w = values / length
    return Pose((0.0, 0.0, 0.0), (float(x), float(y), float(z), float(w))).matrix()


def quaternion_from_matrix(matrix: ArrayLike) -> Matrix:
    """Return the quaternion (x, y, z, w) of a 4×4 rotation, with w not negative."""
    found = np.array(Pose.from_matrix(np.asarray(matrix, float)).quat_xyzw)
    return -found if found[3] < 0 else found


def quaternion_multiply(quaternion1: Quaternion, quaternion0: Quaternion) -> Matrix:
    """Return the product (x, y, z, w): turn by `quaternion0` first, then by `quaternion1`."""
    x1, y1, z1, w1 = quaternion1
    x0, y0, z0, w0 = quaternion0
    return np.array(
        [
            x1 * w0 + y1 * z0 - z1 * y0 + w1 * x0,
            -x1 * z0 + y1 * w0 + z1 * x0 + w1 * y0,
            x1 * y0 - y1 * x0 + z1 * w0 + w1 * z0,
            -x1 * x0 - y1 * y0 - z1 * z0 + w1 * w0,
        ]
    )


def quaternion_conjugate(quaternion: Quaternion) -> Matrix:
    """Return the conjugate of a quaternion (x, y, z, w)."""
    x, y, z, w = quaternion
    return np.array([-x, -y, -z, w])


def quaternion_inverse(quaternion: Quaternion) -> Matrix:
    """Return the inverse of a quaternion (x, y, z, w)."""
    return np.asarray(quaternion_conjugate(quaternion) / np.dot(quaternion, quaternion))


def quaternion_slerp(
    quat0: Quaternion, quat1: Quaternion, fraction: float, spin: int = 0,
    shortestpath: bool = True,
) -> Matrix:  # fmt: skip
    """Return the quaternion (x, y, z, w) a fraction of the way from one to another."""
    first, second = unit_vector(quat0), unit_vector(quat1)
    if fraction in (0, 1):
        return np.asarray(second if fraction else first)
    dot = float(np.dot(first, second))
    if shortestpath and dot < 0:
        dot, second = -dot, -second
    angle = math.acos(max(-1.0, min(1.0, dot))) + spin * math.pi
    if abs(angle) < _SMALL:
        return np.asarray(first)
    ratio = math.sin(angle)
    return np.asarray(
        (math.sin((1 - fraction) * angle) * first + math.sin(fraction * angle) * second) / ratio
    )


def random_quaternion(rand: Any = None) -> Matrix:
    """Return a uniformly distributed quaternion (Shoemake, Graphics Gems III, 1992)."""
    u, v, w = np.random.random(3) if rand is None else rand
    low, high = math.sqrt(1 - u), math.sqrt(u)
    return np.array(
        [
            low * math.sin(2 * math.pi * v),
            low * math.cos(2 * math.pi * v),
            high * math.sin(2 * math.pi * w),
            high * math.cos(2 * math.pi * w),
        ]
    )


def concatenate_matrices(*matrices: ArrayLike) -> Matrix:
    """Return the product of 4×4 matrices."""
    product = np.identity(4)
    for matrix in matrices:
        product = product @ np.asarray(matrix, float)
    return product


def inverse_matrix(matrix: ArrayLike) -> Matrix:
    """Return the inverse of a square matrix, n×n."""
    return np.asarray(np.linalg.inv(np.asarray(matrix, float)))


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Return whether two 4×4 matrices perform the same transformation."""
    first, second = np.asarray(matrix0, float), np.asarray(matrix1, float)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))


def vector_norm(data: ArrayLike, axis: int | None = None, out: Matrix | None = None) -> Any:
    """Return the length of a vector, or the lengths along an axis; into `out` if it is given.

    `data` is of any shape; the lengths are of its shape without that axis.
    """
    found = np.linalg.norm(np.asarray(data, float), axis=axis)
    if out is None:
        return found
    out[...] = found
    return None


def unit_vector(data: ArrayLike, axis: int | None = None, out: Matrix | None = None) -> Any:
    """Return a vector, or the vectors along an axis, at length one; in `out` if it is given.

    `data` is of any shape, which stays.
    """
    values = np.asarray(data, float)
    length = np.linalg.norm(values, axis=axis, keepdims=axis is not None)
    found = np.asarray(values / np.where(length == 0, 1.0, length))
    if out is None:
        return found
    out[...] = found
    return None


def _axes(axes: str) -> tuple[str, tuple[int, int, int]]:
    letters = axes.lower()
    legal = len(letters) == 4 and letters[0] in "sr" and set(letters[1:]) <= set(_AXES)
    if not legal or letters[1] == letters[2] or letters[2] == letters[3]:
        raise ValueError(f"'{axes}' is no axis order; write s or r and three axes, such as 'sxyz'")
    i, j, k = (_AXES[letter] for letter in letters[1:])
    return letters[0], (i, j, k)


def _distinct(m: Matrix, i: int, j: int, k: int) -> tuple[float, float, float]:
    """Angles of ``R_k(c) R_j(b) R_i(a)``, three different axes."""
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    cosine = math.hypot(m[i, i], m[j, i])
    second = math.atan2(-sign * m[k, i], cosine)
    if cosine > 1e-9:
        return math.atan2(sign * m[k, j], m[k, k]), second, math.atan2(sign * m[j, i], m[i, i])
    return math.atan2(-sign * m[j, k], m[j, j]), second, 0.0


def _repeated(m: Matrix, i: int, j: int) -> tuple[float, float, float]:
    """Angles of ``R_i(c) R_j(b) R_i(a)``, first and last axis the same."""
    k = 3 - i - j
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    sine = math.hypot(m[i, j], m[i, k])
    second = math.atan2(sine, m[i, i])
    if sine > 1e-9:
        return math.atan2(m[i, j], sign * m[i, k]), second, math.atan2(m[j, i], -sign * m[k, i])
    return math.atan2(-sign * m[j, k], m[j, j]), second, 0.0
