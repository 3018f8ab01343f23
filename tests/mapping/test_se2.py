"""Poses in the plane."""

from __future__ import annotations

import numpy as np

from gazelle.mapping.se2 import between, compose, inverse, transform_points, wrap_angle

RNG = np.random.default_rng(1)
POSES = RNG.uniform(-5, 5, (50, 3))


def test_between_undoes_compose() -> None:
    other = RNG.uniform(-3, 3, (50, 3))
    np.testing.assert_allclose(between(POSES, compose(POSES, other)), other, atol=1e-12)


def test_a_pose_and_its_inverse_compose_to_the_identity() -> None:
    np.testing.assert_allclose(compose(POSES, inverse(POSES)), np.zeros((50, 3)), atol=1e-12)


def test_composing_moves_points_as_moving_twice_does() -> None:
    a, b, points = POSES[0], POSES[1], RNG.uniform(-2, 2, (7, 2))
    twice = transform_points(a, transform_points(b, points))
    np.testing.assert_allclose(transform_points(compose(a, b), points), twice, atol=1e-12)


def test_angles_are_wrapped_to_plus_minus_pi() -> None:
    np.testing.assert_allclose(wrap_angle([0.0, 3 * np.pi / 2, -np.pi]), [0, -np.pi / 2, -np.pi])
