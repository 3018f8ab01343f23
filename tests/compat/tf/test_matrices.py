"""Matrices beyond rigid bodies; the numbers are those of tf 1.13's tf.transformations."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.compat.tf import matrices
from gazelle.compat.tf.transformations import euler_matrix, unit_vector, vector_norm

POINT, NORMAL = [1, 2, 3], [1, 1, 0]


def test_parts_come_back_from_their_product() -> None:
    parts: dict[str, Any] = {
        "scale": [1.5, 2, 0.5],
        "shear": [0.1, 0.2, -0.3],
        "angles": [0.3, -0.4, 1.2],
        "translate": [1, 2, 3],
        "perspective": [0.1, 0, 0.2, 1],
    }
    # Perspective and translation together are scaled by their product's corner.
    for left_out in ("perspective", "translate"):
        chosen = {name: value for name, value in parts.items() if name != left_out}
        matrix = matrices.compose_matrix(**chosen)
        found = matrices.decompose_matrix(matrix)
        for name, value in zip(parts, found[:3], strict=False):
            assert value == pytest.approx(parts[name]), name
        assert matrices.compose_matrix(*found) == pytest.approx(matrix)
    mirrored = matrices.compose_matrix(scale=[-1, 1, 1], angles=[0.1, 0.2, 0.3])
    assert matrices.compose_matrix(*matrices.decompose_matrix(mirrored)) == pytest.approx(mirrored)


@pytest.mark.reference
@pytest.mark.parametrize(
    ("matrix", "rows"),
    [
        (matrices.reflection_matrix(POINT, NORMAL), [[0, -1, 0, 3], [-1, 0, 0, 3], [0, 0, 1, 0]]),
        (matrices.scale_matrix(2, POINT), [[2, 0, 0, -1], [0, 2, 0, -2], [0, 0, 2, -3]]),
        (
            matrices.scale_matrix(2, POINT, [1, 0, 1]),
            [[1.5, 0, 0.5, -2], [0, 1, 0, 0], [0.5, 0, 1.5, -2]],
        ),
        (
            matrices.projection_matrix(POINT, NORMAL),
            [[0.5, -0.5, 0, 1.5], [-0.5, 0.5, 0, 1.5], [0, 0, 1, 0]],
        ),
        (
            matrices.projection_matrix(POINT, NORMAL, direction=[1, 0, 0]),
            [[0, -1, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0]],
        ),
        (
            matrices.projection_matrix(POINT, NORMAL, perspective=[4, 5, 6]),
            [
                [1.414214, -2.828427, 0, 8.485281],
                [-3.535534, 0.707107, 0, 10.606602],
                [-4.242641, -4.242641, 4.242641, 12.727922],
                [-0.707107, -0.707107, 0, 6.363961],
            ],
        ),
        (
            matrices.projection_matrix(POINT, NORMAL, perspective=[4, 5, 6], pseudo=True),
            [[0.914214, -3.328427, 0, 9.985281], [-4.035534, 0.207107, 0, 12.106602]],
        ),
        (
            matrices.clip_matrix(-1, 2, -3, 4, 1, 5),
            [[0.666667, 0, 0, -0.333333], [0, 0.285714, 0, -0.142857], [0, 0, 0.5, -1.5]],
        ),
        (
            matrices.clip_matrix(-1, 2, -3, 4, 1, 5, perspective=True),
            [
                [-0.666667, 0, 0.333333, 0],
                [0, -0.285714, 0.142857, 0],
                [0, 0, -1.5, 2.5],
                [0, 0, -1, 0],
            ],
        ),
        (
            matrices.shear_matrix(0.5, [1, 0, 0], POINT, [0, 1, 1]),
            [[1, 0.386294, 0.386294, -1.931471], [0, 1, 0, 0], [0, 0, 1, 0]],
        ),
        (
            matrices.orthogonalization_matrix((10, 11, 12), (80, 90, 100)),
            [[9.843316, 0, 0, 0], [-1.76327, 10.832885, 0, 0], [0, 1.91013, 12, 0]],
        ),
        (
            matrices.random_rotation_matrix([0.1, 0.5, 0.9]),
            [[-0.869098, 0.095106, -0.48541, 0], [-0.095106, 0.930902, 0.352671, 0]],
        ),
    ],
)
def test_matrix_is_the_originals(matrix: np.ndarray, rows: list[list[float]]) -> None:
    assert matrix[: len(rows)] == pytest.approx(np.array(rows), abs=2e-6)


def test_points_are_brought_to_where_they_should_be() -> None:
    points = np.random.default_rng(1).random((3, 10))
    turn = euler_matrix(0.3, -0.4, 1.2)[:3, :3]
    there = 2 * turn @ points + np.array([[1], [2], [3]])
    found = matrices.superimposition_matrix(points, there, scaling=True)
    assert found[:3, :3] == pytest.approx(2 * turn)
    assert found[:3, 3] == pytest.approx([1, 2, 3])
    rigid = matrices.superimposition_matrix(points, there)
    assert rigid[:3, :3] == pytest.approx(turn)
    # A mirror image has no rigid motion onto it; the nearest one is still a rotation.
    mirror = matrices.superimposition_matrix(points, points * [[-1], [1], [1]])
    assert math.isclose(float(np.linalg.det(mirror[:3, :3])), 1.0)


def test_what_makes_no_sense_is_refused() -> None:
    with pytest.raises(ValueError, match=r"M\[3, 3\] is zero"):
        matrices.decompose_matrix(np.zeros((4, 4)))
    with pytest.raises(ValueError, match="matrix is singular"):
        matrices.decompose_matrix(np.diag([1, 1, 0, 1]))
    with pytest.raises(ValueError, match="direction and normal vectors are not orthogonal"):
        matrices.shear_matrix(0.5, [1, 0, 0], POINT, [1, 1, 1])
    with pytest.raises(ValueError, match="invalid frustrum"):
        matrices.clip_matrix(1, -2, -3, 4, 1, 5)
    with pytest.raises(ValueError, match="near <= 0"):
        matrices.clip_matrix(-1, 2, -3, 4, 0, 5, perspective=True)
    assert matrices.random_vector(5).shape == (5,)


def test_reflection_scale_and_shear_are_read_back_from_their_matrices() -> None:
    point, normal = [1.0, 2.0, 3.0], [0.0, 0.6, 0.8]
    mirror = matrices.reflection_matrix(point, normal)
    assert np.allclose(mirror, matrices.reflection_matrix(*matrices.reflection_from_matrix(mirror)))
    for direction in (None, normal):
        scaled = matrices.scale_matrix(-2.5, point, direction)
        assert np.allclose(scaled, matrices.scale_matrix(*matrices.scale_from_matrix(scaled)))
    sheared = matrices.shear_matrix(0.4, [1.0, 0.0, 0.0], point, normal)
    assert np.allclose(sheared, matrices.shear_matrix(*matrices.shear_from_matrix(sheared)))
    for read in (
        matrices.reflection_from_matrix,
        matrices.scale_from_matrix,
        matrices.shear_from_matrix,
    ):
        with pytest.raises(ValueError, match="eigenvector"):
            read(np.identity(4))


def test_lengths_and_unit_vectors_go_into_an_array() -> None:
    out = np.zeros(3)
    assert unit_vector([0.0, 3.0, 4.0], out=out) is None
    assert np.allclose(out, [0.0, 0.6, 0.8])
    lengths = np.zeros(2)
    assert vector_norm([[3.0, 4.0], [6.0, 8.0]], axis=1, out=lengths) is None
    assert np.allclose(lengths, [5.0, 10.0])
