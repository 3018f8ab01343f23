"""Steered bases: every wheel rolls about one point."""

from __future__ import annotations

import math

import pytest

from gazelle.control.wheels.kinematics import AxlePair, SteeringGeometry, reduced_until_steered

CAR = SteeringGeometry(1.2, 0.3, 0.8, 0.9)


@pytest.mark.parametrize("angle", [-0.6, -1e-3, 0.0, 0.2, 0.9])
def test_round_trip_of_angles_and_speeds(angle):
    assert CAR.virtual_angle(CAR.wheel_angles(angle)) == pytest.approx(angle, abs=1e-12)
    assert CAR.axle_linear(CAR.axle_speeds(0.7, angle), angle) == pytest.approx(0.7)


@pytest.mark.parametrize("twist", [(0.5, 0.3), (-0.5, 0.3), (1.0, -0.1)])
def test_yaw_rate_of_the_steering_angle_is_the_one_commanded(twist):
    angle = CAR.steering_angle(*twist)
    assert CAR.yaw_rate(twist[0], angle) == pytest.approx(twist[1])


def test_axes_of_steered_wheels_meet_the_other_axle_in_one_point():
    right, left = CAR.wheel_angles(0.4)
    centre = CAR.wheelbase_m / math.tan(0.4)
    assert CAR.wheelbase_m / math.tan(left) + CAR.steering_track_m / 2 == pytest.approx(centre)
    assert CAR.wheelbase_m / math.tan(right) - CAR.steering_track_m / 2 == pytest.approx(centre)
    assert left > right


def test_driven_wheels_run_like_their_distance_from_the_centre_of_the_turn():
    angle, centre = 0.4, CAR.wheelbase_m / math.tan(0.4)
    right, left = CAR.axle_speeds(1.0, angle)
    outer, inner = centre + CAR.traction_track_m / 2, centre - CAR.traction_track_m / 2
    assert right / left == pytest.approx(outer / inner)
    assert CAR.axle_speeds(1.0, 0.0) == AxlePair(
        right=pytest.approx(1 / 0.3), left=pytest.approx(1 / 0.3)
    )


def test_standing_base_steers_a_quarter_turn_and_a_still_one_straight():
    assert CAR.steering_angle(0.0, -0.1) == pytest.approx(-math.pi / 2)
    assert CAR.steering_angle(0.0, 0.0) == 0.0


def test_speed_is_reduced_only_beyond_thirty_degrees():
    assert reduced_until_steered(2.0, 0.5) == 2.0
    assert reduced_until_steered(2.0, 1.0) == pytest.approx(
        2 * math.cos(1.0) / math.cos(math.pi / 6)
    )
    assert reduced_until_steered(2.0, 3.0) == pytest.approx(
        2 * math.cos(1.5608) / math.cos(math.pi / 6)
    )
