"""Front and rear steering: each wheel rolls along itself about the centre of the turn."""

from __future__ import annotations

import math

import pytest

from gazelle.control.wheels.kinematics import FourWheelSteering, virtual_angle

BASE = FourWheelSteering(0.6, 0.05, 0.2, 1.0)
LAW = [
    ("front_left", 0.5, 0.3),
    ("front_right", 0.5, -0.3),
    ("rear_left", -0.5, 0.3),
    ("rear_right", -0.5, -0.3),
]


@pytest.mark.parametrize(("name", "x", "y"), LAW)
@pytest.mark.parametrize("twist", [(0.8, 0.5), (-0.8, 0.5), (0.8, -0.2)])
def test_wheels_do_not_slip_sideways(name, x, y, twist):
    linear, angular = twist
    speeds, angles = BASE.from_twist(linear, angular)
    angle = getattr(angles, name)
    velocity = (linear - angular * y, angular * x)
    sideways = -math.sin(angle) * velocity[0] + math.cos(angle) * velocity[1]
    rolling = math.cos(angle) * velocity[0] + math.sin(angle) * velocity[1]
    outside = math.copysign(BASE.y_offset_m, y)
    assert sideways == pytest.approx(0.0, abs=1e-12)
    assert getattr(speeds, name) * BASE.wheel_radius_m == pytest.approx(rolling - angular * outside)


@pytest.mark.parametrize(
    "order", [(0.6, 0.3, -0.3), (0.6, 0.3, 0.3), (-0.4, 0.2, 0.0), (0.5, 0, 0)]
)
def test_odometry_of_the_commanded_wheels_is_the_command(order):
    speed, front, rear = order
    speeds, angles = BASE.from_angles(speed, front, rear)
    fronts = virtual_angle(angles.front_left, angles.front_right)
    rears = virtual_angle(angles.rear_left, angles.rear_right)
    assert (fronts, rears) == pytest.approx((front, rear), abs=1e-12)
    twist = BASE.twist(speeds, fronts, rears)
    sideways = speed * (math.tan(front) + math.tan(rear)) / 2
    turn = speed * (math.tan(front) - math.tan(rear)) / BASE.wheel_base_m
    assert twist == pytest.approx((speed, sideways, turn), abs=1e-12)


def test_twist_round_trip():
    speeds, angles = BASE.from_twist(0.8, 0.5)
    front = virtual_angle(angles.front_left, angles.front_right)
    rear = virtual_angle(angles.rear_left, angles.rear_right)
    assert BASE.twist(speeds, front, rear) == pytest.approx((0.8, 0.0, 0.5), abs=1e-12)


def test_crab_walk_steers_all_wheels_alike():
    _, angles = BASE.from_angles(0.5, 0.4, 0.4)
    assert angles == pytest.approx((0.4,) * 4)


def test_nothing_is_driven_below_a_millimetre_per_second():
    speeds, _ = BASE.from_twist(0.0009, 0.0)
    assert speeds == (0.0,) * 4
