"""The Kalman filter."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.navigation.localization.ekf import STATES, Ekf, rotation_of


def _index(*names: str) -> list[int]:
    return [STATES.index(name) for name in names]


def test_velocities_measured_on_a_circle_lead_around_it() -> None:
    ekf = Ekf(planar=True)
    rows = _index("vx", "vyaw")
    for _ in range(628):
        ekf.predict(0.01)
        ekf.update(rows, np.array([0.5, 1.0]), np.diag([1e-6, 1e-6]))
    # Radius 0.5 m, once around; the first step begins at rest.
    np.testing.assert_allclose(ekf.state[:2], (0.0, 0.0), atol=0.02)
    assert abs(ekf.state[5]) < 0.02


def test_covariance_grows_between_measurements_and_shrinks_with_them() -> None:
    ekf = Ekf()
    sizes = []
    for k in range(20):
        ekf.predict(0.1)
        before = ekf.covariance[0, 0]
        if k % 5 == 4:
            ekf.update([0], np.array([1.0]), np.array([[0.01]]))
            assert ekf.covariance[0, 0] < before
        sizes.append(before)
        assert np.linalg.eigvalsh(ekf.covariance).min() > -1e-12
    assert sizes[3] > sizes[0]


def test_two_measurements_meet_at_their_weighted_mean() -> None:
    ekf = Ekf(initial_covariance=np.eye(15) * 1e6)
    ekf.update([0], np.array([1.0]), np.array([[1.0]]))
    ekf.update([0], np.array([4.0]), np.array([[2.0]]))
    assert ekf.state[0] == pytest.approx(2.0, abs=1e-4)
    assert ekf.covariance[0, 0] == pytest.approx(2 / 3, rel=1e-4)


def test_angles_are_compared_around_the_circle() -> None:
    ekf = Ekf(initial_covariance=np.eye(15))
    ekf.state[5] = 3.1
    ekf.update([5], np.array([-3.1]), np.array([[1.0]]))
    assert abs(abs(ekf.state[5]) - math.pi) < 1e-9


def test_outliers_are_not_taken() -> None:
    ekf = Ekf(initial_covariance=np.eye(15) * 0.01)
    assert not ekf.update([0], np.array([50.0]), np.array([[0.01]]), threshold=3.0)
    assert ekf.state[0] == 0.0
    assert ekf.update([0], np.array([0.1]), np.array([[0.01]]), threshold=3.0)


def test_on_the_plane_nothing_leaves_the_ground() -> None:
    ekf = Ekf(planar=True)
    ekf.update(_index("x", "z", "roll"), np.ones(3), np.eye(3) * 0.01)
    ekf.predict(1.0)
    assert not ekf.state[_index("z", "roll", "pitch", "vz", "vroll", "vpitch", "az")].any()


def test_acceleration_becomes_velocity_and_way() -> None:
    ekf = Ekf()
    ekf.state[_index("ax")] = 2.0
    ekf.state[_index("yaw")] = math.pi / 2
    ekf.predict(0.5)
    assert ekf.state[1] == pytest.approx(0.25)
    assert ekf.state[6] == pytest.approx(1.0)


def test_rotations_are_those_of_roll_pitch_yaw() -> None:
    turned = rotation_of(0.0, 0.0, math.pi / 2) @ [1.0, 0.0, 0.0]
    np.testing.assert_allclose(turned, [0, 1, 0], atol=1e-12)
    assert np.linalg.det(rotation_of(0.3, -0.4, 1.2)) == pytest.approx(1.0)
