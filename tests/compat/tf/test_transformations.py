"""tf.transformations: every axis order there and back, and the values its documentation shows."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from gazelle.compat.tf import transformations as tft
from gazelle.compat.tf.matrices import compose_matrix

_ORDERS = [
    frame + "".join(axes)
    for frame in "sr"
    for axes in itertools.product("xyz", repeat=3)
    if axes[0] != axes[1] and axes[1] != axes[2]
]


def _turn(axis: str, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array({
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis])  # fmt: skip


def test_there_are_24_orders() -> None:
    assert len(_ORDERS) == 24


@pytest.mark.parametrize("order", _ORDERS)
def test_every_order_goes_there_and_back(order: str) -> None:
    generator = np.random.default_rng(1)
    for angles in generator.uniform(-math.pi, math.pi, (20, 3)):
        turns = [_turn(axis, angle) for axis, angle in zip(order[1:], angles, strict=True)]
        expected = (
            turns[2] @ turns[1] @ turns[0] if order[0] == "s" else turns[0] @ turns[1] @ turns[2]
        )
        matrix = tft.euler_matrix(*angles, axes=order)
        assert np.allclose(matrix[:3, :3], expected)
        assert np.allclose(tft.euler_matrix(*tft.euler_from_matrix(matrix, order), order), matrix)
        quaternion = tft.quaternion_from_euler(*angles, axes=order)
        assert np.allclose(tft.quaternion_matrix(quaternion), matrix)
        back = tft.quaternion_from_euler(*tft.euler_from_quaternion(quaternion, order), order)
        assert np.allclose(np.abs(np.dot(back, quaternion)), 1.0)


@pytest.mark.parametrize("order", _ORDERS)
def test_poles_keep_the_rotation(order: str) -> None:
    middle = 0.0 if order[1] == order[3] else math.pi / 2
    matrix = tft.euler_matrix(0.3, middle, 0.4, order)
    assert np.allclose(tft.euler_matrix(*tft.euler_from_matrix(matrix, order), order), matrix)


def test_documented_values() -> None:
    quaternion = tft.quaternion_from_euler(1, 2, 3, "ryxz")
    assert np.allclose(quaternion, [0.310622, -0.718287, 0.444435, 0.435953])
    assert np.allclose(
        tft.euler_from_quaternion([0.06146124, 0, 0, 0.99810947]), [0.123, 0, 0], atol=1e-6
    )
    assert np.allclose(tft.quaternion_about_axis(0.123, (1, 0, 0)), [0.06146124, 0, 0, 0.99810947])
    product = tft.quaternion_multiply([1, -2, 3, 4], [-5, 6, 7, 8])
    assert np.allclose(product, [-44, -14, 48, 28])
    assert tft.vector_norm([3, 4]) == 5


def test_inverse_conjugate_and_slerp_follow_their_laws() -> None:
    first, second = tft.random_quaternion([0.1, 0.2, 0.3]), tft.random_quaternion([0.9, 0.4, 0.6])
    identity = tft.quaternion_multiply(first, tft.quaternion_inverse(first))
    assert np.allclose(identity, [0, 0, 0, 1])
    assert np.allclose(tft.quaternion_conjugate(first), tft.quaternion_inverse(first))
    assert np.allclose(tft.quaternion_slerp(first, second, 0), first)
    assert np.allclose(tft.quaternion_slerp(first, second, 1), second)
    middle = tft.quaternion_slerp(first, second, 0.5)
    assert np.isclose(np.dot(first, middle), abs(np.dot(middle, second)))


def test_matrices_compose_invert_and_turn_about_points() -> None:
    matrix = tft.concatenate_matrices(
        tft.translation_matrix((1, 2, 3)), tft.euler_matrix(0.1, 0.2, 0.3)
    )
    assert tft.is_same_transform(matrix @ tft.inverse_matrix(matrix), tft.identity_matrix())
    composed = compose_matrix(angles=(0.1, 0.2, 0.3), translate=(1, 2, 3))
    assert np.allclose(composed, matrix)
    assert np.allclose(tft.translation_from_matrix(matrix), [1, 2, 3])
    about = tft.rotation_matrix(math.pi / 2, (0, 0, 1), point=(1, 0, 0))
    assert np.allclose(about @ [1, 0, 0, 1], [1, 0, 0, 1])
    angle, axis, point = tft.rotation_from_matrix(about)
    assert tft.is_same_transform(tft.rotation_matrix(angle, axis, point[:3]), about)


def test_wrong_order_is_named() -> None:
    with pytest.raises(ValueError, match="'sxxy' is no axis order; write s or r and three axes"):
        tft.euler_matrix(0, 0, 0, "sxxy")
