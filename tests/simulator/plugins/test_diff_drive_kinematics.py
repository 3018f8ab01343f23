from __future__ import annotations

import math

import pytest

from gazelle.simulator.plugins.diff_drive_kinematics import EncoderOdometry, WheelRamp, wheel_speeds


def test_a_left_turn_drives_the_right_wheel_faster() -> None:
    assert wheel_speeds(0.2, 0.5, 0.4, exchanged=False) == pytest.approx((0.1, 0.3))


def test_legacy_mode_exchanges_the_wheels() -> None:
    assert wheel_speeds(0.2, 0.5, 0.4, exchanged=True) == pytest.approx((0.3, 0.1))


def test_without_an_acceleration_the_target_is_commanded_at_once() -> None:
    assert WheelRamp(0.0).command((1.0, -1.0), (0.0, 0.0), 0.01) == (1.0, -1.0)


def test_the_ramp_moves_by_the_acceleration_until_a_wheel_is_near() -> None:
    ramp = WheelRamp(2.0)
    assert ramp.command((1.0, 1.0), (0.0, 0.0), 0.01) == pytest.approx((0.02, 0.02))
    assert ramp.command((1.0, 1.0), (0.02, 0.02), 0.01) == pytest.approx((0.04, 0.04))
    # One wheel within 0.01 m/s is enough for both to get their targets, as in Gazebo.
    assert ramp.command((1.0, 1.0), (0.995, 0.2), 0.01) == (1.0, 1.0)


def test_odometry_closes_a_full_circle() -> None:
    odometry = EncoderOdometry(0.3, 0.1, exchanged=False)
    # Radius 1 m: the left wheel runs on 0.85 m, the right one on 1.15 m.
    steps = 1000
    for _ in range(steps):
        turn = 2 * math.pi / steps
        odometry.update(0.85 * turn / 0.1, 1.15 * turn / 0.1, 0.01)
    assert odometry.x_m == pytest.approx(0.0, abs=1e-9)
    assert odometry.y_m == pytest.approx(0.0, abs=1e-9)
    assert odometry.yaw_rad == pytest.approx(2 * math.pi)
    assert odometry.forward_m_s == pytest.approx(2 * math.pi / steps / 0.01)


def test_exchanged_odometry_turns_the_other_way() -> None:
    straight = EncoderOdometry(0.3, 0.1, exchanged=False)
    swapped = EncoderOdometry(0.3, 0.1, exchanged=True)
    straight.update(0.1, 0.3, 0.01)
    swapped.update(0.1, 0.3, 0.01)
    assert swapped.yaw_rad == -straight.yaw_rad
