"""The 4×4 matrices of ``tf.transformations`` beyond rigid bodies: scale, shear, projection.

Textbook linear algebra; signs and argument orders are the original's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gazelle.compat.tf.transformations import (
    Matrix,
    euler_from_matrix,
    euler_matrix,
    quaternion_matrix,
    random_quaternion,
    translation_matrix,
    unit_vector,
)

__all__ = [
    "clip_matrix",
    "compose_matrix",
    "decompose_matrix",
    "orthogonalization_matrix",
    "projection_matrix",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
]

_SMALL = 1e-12
_NEAR = 1e-6


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: Sequence[float] | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Matrix:
    """Return perspective · translation · rotation (sxyz) · shear (xy, xz, yz) · scale."""
    matrix = np.identity(4)
    if perspective is not None:
        matrix[3, :] = np.asarray(perspective, float)[:4]
    if translate is not None:
        matrix = matrix @ translation_matrix(translate)
    if angles is not None:
        matrix = matrix @ euler_matrix(angles[0], angles[1], angles[2])
    if shear is not None:
        sheared = np.identity(4)
        sheared[0, 1], sheared[0, 2], sheared[1, 2] = np.asarray(shear, float)[:3]
        matrix = matrix @ sheared
    if scale is not None:
        matrix = matrix @ np.diag([*np.asarray(scale, float)[:3], 1.0])
    return np.asarray(matrix / matrix[3, 3])


def decompose_matrix(matrix: ArrayLike) -> tuple[Any, Any, Any, Any, Any]:
    """Return scale, shear, angles (sxyz), translation and perspective of a 4×4 matrix.

    Raises:
        ValueError: it has no such parts.
    """
    full = np.array(matrix, float)
    if abs(full[3, 3]) < _SMALL:
        raise ValueError("M[3, 3] is zero")
    full /= full[3, 3]
    affine = full.copy()
    affine[3] = 0.0, 0.0, 0.0, 1.0
    if abs(np.linalg.det(affine)) < _SMALL:
        raise ValueError("matrix is singular")
    perspective = full[3] @ np.linalg.inv(affine)
    # Rotation times upper triangle: the triangle holds scale, and shear times scale.
    turn, upper = np.linalg.qr(affine[:3, :3])
    signs = np.diag(np.where(np.diag(upper) < 0, -1.0, 1.0))
    turn, upper = turn @ signs, signs @ upper
    scale = np.diag(upper).copy()
    shear = np.array([upper[0, 1] / scale[1], upper[0, 2] / scale[2], upper[1, 2] / scale[2]])
    if np.linalg.det(turn) < 0:
        turn, scale = -turn, -scale
    rotation = np.identity(4)
    rotation[:3, :3] = turn
    return scale, shear, euler_from_matrix(rotation), affine[:3, 3].copy(), perspective


def reflection_matrix(point: ArrayLike, normal: ArrayLike) -> Matrix:
    """Return the reflection at a plane, 4×4; its point and normal are (x, y, z)."""
    axis = unit_vector(np.asarray(normal, float)[:3])
    matrix = np.identity(4)
    matrix[:3, :3] -= 2.0 * np.outer(axis, axis)
    matrix[:3, 3] = 2.0 * np.dot(np.asarray(point, float)[:3], axis) * axis
    return matrix


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Matrix, Matrix]:
    """Return a point of a 4×4 reflection's mirror (x, y, z, 1) and the normal (x, y, z).

    Raises:
        ValueError: it is no reflection.
    """
    given = np.asarray(matrix, float)
    values, vectors = np.linalg.eigh((np.identity(3) - given[:3, :3]) / 2)
    if abs(values[-1] - 1.0) > _NEAR or abs(values[:2]).max() > _NEAR:
        raise ValueError("no unit eigenvector corresponding to eigenvalue -1: it is no reflection")
    return np.append(given[:3, 3] / 2, 1.0), np.asarray(vectors[:, -1])


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix | None]:
    """Return factor, origin (x, y, z, 1) and direction (x, y, z) of a 4×4 scale.

    There is no direction when all are scaled.

    Raises:
        ValueError: it scales by one, so that its origin may be anywhere.
    """
    given = np.asarray(matrix, float)
    turn = given[:3, :3]
    factor, direction = float(np.trace(turn)) / 3, None
    if abs(turn - factor * np.identity(3)).max() > _NEAR:
        factor = float(np.trace(turn)) - 2
        vectors, _, _ = np.linalg.svd(np.identity(3) - turn)
        direction = np.asarray(vectors[:, 0])
    if abs(factor - 1.0) < _SMALL:
        raise ValueError("no eigenvector corresponding to eigenvalue 1: it scales by one")
    return factor, np.append(given[:3, 3] / (1.0 - factor), 1.0), direction


def scale_matrix(
    factor: float, origin: ArrayLike | None = None, direction: ArrayLike | None = None
) -> Matrix:
    """Return the scale (4×4) by a factor around an origin, in all directions or in one."""
    matrix = np.identity(4)
    if direction is None:
        matrix[:3, :3] *= factor
    else:
        axis = unit_vector(np.asarray(direction, float)[:3])
        matrix[:3, :3] -= (1.0 - factor) * np.outer(axis, axis)
    if origin is not None:
        centre = np.asarray(origin, float)[:3]
        matrix[:3, 3] = centre - matrix[:3, :3] @ centre
    return matrix


def projection_matrix(
    point: ArrayLike,
    normal: ArrayLike,
    direction: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
    pseudo: bool = False,
) -> Matrix:
    """Return the projection (4×4) onto a plane: orthogonal, along a direction, or from a point.

    Args:
        point: of the plane.
        normal: of the plane.
        direction: of the rays.
        perspective: where the rays come from.
        pseudo: keep the depth, so that the matrix has an inverse.
    """
    axis = unit_vector(np.asarray(normal, float)[:3])
    depth = float(np.dot(np.asarray(point, float)[:3], axis))
    matrix = np.identity(4)
    if perspective is not None:
        eye = np.asarray(perspective, float)[:3]
        matrix[:3, :3] *= np.dot(eye, axis) - depth
        matrix[:3, :3] -= np.outer(eye, axis)
        matrix[:3, 3] = depth * eye
        if pseudo:
            matrix[:3, :3] -= np.outer(axis, axis)
            matrix[:3, 3] += depth * axis
        matrix[3, :3] = -axis
        matrix[3, 3] = np.dot(eye, axis)
        return matrix
    ray = axis if direction is None else np.asarray(direction, float)[:3]
    ray = ray / np.dot(ray, axis)
    matrix[:3, :3] -= np.outer(ray, axis)
    matrix[:3, 3] = depth * ray
    return matrix


def clip_matrix(
    left: float,
    right: float,
    bottom: float,
    top: float,
    near: float,
    far: float,
    perspective: bool = False,
) -> Matrix:
    """Return the 4×4 matrix from a viewing volume to the cube from -1 to 1.

    Raises:
        ValueError: the volume is empty, or begins at the eye.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("invalid frustrum")
    spans = np.array([right - left, top - bottom, far - near])
    middles = np.array([right + left, top + bottom, far + near]) / spans
    matrix = np.diag([*(2.0 / spans), 1.0])
    if not perspective:
        matrix[:3, 3] = -middles
        return matrix
    if near <= _SMALL:
        raise ValueError("invalid frustrum: near <= 0")
    matrix[:2, :2] *= -near
    matrix[:2, 2] = middles[:2]
    matrix[2, 2:] = -middles[2], 2.0 * near * far / spans[2]
    matrix[3, 2:] = -1.0, 0.0
    return matrix


def shear_matrix(angle: float, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Matrix:
    """Return the shear (4×4) along a direction of a plane, by an angle in radians.

    Raises:
        ValueError: the direction is not in the plane.
    """
    axis = unit_vector(np.asarray(normal, float)[:3])
    along = unit_vector(np.asarray(direction, float)[:3])
    if abs(np.dot(axis, along)) > 1e-6:
        raise ValueError("direction and normal vectors are not orthogonal")
    slope = math.tan(angle)
    matrix = np.identity(4)
    matrix[:3, :3] += slope * np.outer(along, axis)
    matrix[:3, 3] = -slope * np.dot(np.asarray(point, float)[:3], axis) * along
    return matrix


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Matrix, Matrix, Matrix]:
    """Return angle (rad), direction, a point of the plane and the plane's normal of a 4×4 shear.

    Direction and normal are (x, y, z), the point is (x, y, z, 1).

    Raises:
        ValueError: it is no shear.
    """
    given = np.asarray(matrix, float)
    left, sizes, right = np.linalg.svd(given[:3, :3] - np.identity(3))
    direction, normal = left[:, 0], right[0]
    if sizes[0] < _SMALL or sizes[1] > _NEAR or abs(direction @ normal) > _NEAR:
        raise ValueError("no two linear independent eigenvectors found: it is no shear")
    point = -(given[:3, 3] @ direction) / sizes[0] * normal
    return math.atan(sizes[0]), direction, np.append(point, 1.0), normal


def orthogonalization_matrix(lengths: Sequence[float], angles: Sequence[float]) -> Matrix:
    """Return the 4×4 matrix from a crystal's cell to Cartesian axes; angles in degrees."""
    a, b, c = lengths
    alpha, beta, gamma = np.radians(angles)
    ratio = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (
        math.sin(alpha) * math.sin(beta)
    )
    matrix = np.identity(4)
    matrix[0, 0] = a * math.sin(beta) * math.sqrt(1.0 - ratio * ratio)
    matrix[1, :2] = -a * math.sin(beta) * ratio, b * math.sin(alpha)
    matrix[2, :3] = a * math.cos(beta), b * math.cos(alpha), c
    return matrix


def superimposition_matrix(
    v0: ArrayLike, v1: ArrayLike, scaling: bool = False, usesvd: bool = True
) -> Matrix:
    """Return the rigid motion that brings points nearest to others (Kabsch 1976).

    Args:
        v0: points of shape (3, n) or (4, n), one a column.
        v1: where they should be, of the same shape.
        scaling: find a common scale as well (Umeyama 1991, with the ratio of the spreads).
        usesvd: without effect: both ways of the original give the same.
    """
    first, second = np.asarray(v0, float)[:3], np.asarray(v1, float)[:3]
    here, there = first.mean(axis=1), second.mean(axis=1)
    first, second = first - here[:, None], second - there[:, None]
    left, _sizes, right = np.linalg.svd(second @ first.T)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    turn = left @ flip @ right
    if scaling:
        turn *= math.sqrt(float(np.sum(second**2) / np.sum(first**2)))
    matrix = np.identity(4)
    matrix[:3, :3] = turn
    matrix[:3, 3] = there - turn @ here
    return matrix


def random_vector(size: int) -> Matrix:
    """Return random numbers from 0 to 1, of shape (size,)."""
    return np.asarray(np.random.default_rng().random(size))


def random_rotation_matrix(rand: ArrayLike | None = None) -> Matrix:
    """Return a random rotation, 4×4, all equally likely."""
    return quaternion_matrix(random_quaternion(rand))
