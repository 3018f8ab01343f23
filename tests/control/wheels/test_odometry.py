"""Dead reckoning against arcs in closed form."""

from __future__ import annotations

import math

import pytest

from gazelle.control.wheels.odometry import (
    PlanarOdometry,
    PlanarPose,
    RollingMean,
    WheelTravel,
    moved_euler,
    moved_exact,
    moved_runge_kutta,
)


def _end(move, steps, *, radius=2.0, turn=math.pi / 2):
    pose = PlanarPose()
    for _ in range(steps):
        pose = move(pose, radius * turn / steps, 0.0, turn / steps)
    return math.dist(pose[:2], (radius, radius))


def test_quarter_circle_is_exact_in_any_number_of_steps():
    assert _end(moved_exact, 1) < 1e-12
    assert _end(moved_exact, 7) < 1e-12


@pytest.mark.parametrize(("move", "order"), [(moved_euler, 1), (moved_runge_kutta, 2)])
def test_order_of_the_approximations(move, order):
    assert _end(move, 100) / _end(move, 200) == pytest.approx(2**order, rel=0.02)


def test_sideways_arc_is_the_forward_arc_turned_by_a_quarter():
    forward = moved_exact(PlanarPose(), 0.7, 0.0, 0.5)
    sideways = moved_exact(PlanarPose(), 0.0, 0.7, 0.5)
    assert (sideways.x_m, sideways.y_m) == pytest.approx((-forward.y_m, forward.x_m))


def test_tiny_turn_joins_the_arc_smoothly():
    below = moved_exact(PlanarPose(), 1.0, 0.2, 0.99e-6)
    above = moved_exact(PlanarPose(), 1.0, 0.2, 1.01e-6)
    assert above == pytest.approx(below, abs=1e-7)


def test_path_and_its_reverse_lead_back():
    there = moved_exact(PlanarPose(1.0, 2.0, 0.3), 0.4, 0.1, 0.9)
    back = moved_exact(there, -0.4, -0.1, -0.9)
    assert back == pytest.approx((1.0, 2.0, 0.3))


def test_rolling_mean_forgets_what_is_older_than_its_window():
    mean = RollingMean(3)
    assert [mean.add(value) for value in (3.0, 5.0, 7.0, 0.0)] == [3.0, 4.0, 5.0, 4.0]
    mean.clear()
    assert mean.add(1.0) == 1.0


def test_travel_begins_where_the_wheels_stand():
    travel = WheelTravel()
    assert travel.step((4.0, -1.0)) == (0.0, 0.0)
    assert travel.step((4.5, -1.0)) == (0.5, 0.0)


def test_velocity_is_a_mean_and_open_loop_velocity_is_not():
    odometry = PlanarOdometry(2)
    odometry.drive(1.0, 0.0, 0.0, 0.1)
    odometry.drive(3.0, 0.0, 0.0, 0.1)
    assert odometry.linear_x == 2.0
    assert odometry.pose.x_m == pytest.approx(0.4)
    odometry.drive_open_loop(5.0, 0.0, 0.0, 0.1)
    assert odometry.linear_x == 5.0
    odometry.put(PlanarPose(7.0, 0.0, 0.0))
    odometry.drive(1.0, 0.0, 0.0, 0.1)
    assert (odometry.linear_x, odometry.pose.x_m) == (1.0, pytest.approx(7.1))
