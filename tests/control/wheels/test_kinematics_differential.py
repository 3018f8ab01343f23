"""A differential drive: wheel speeds and twist are each other's inverse."""

from __future__ import annotations

import pytest

from gazelle.control.wheels.kinematics import DifferentialDrive


@pytest.mark.parametrize("twist", [(0.4, 0.0), (0.0, 1.2), (-0.3, 0.7)])
def test_twist_of_the_wheel_speeds_is_the_twist(twist):
    drive = DifferentialDrive(0.44, 0.1, 0.12)
    assert drive.twist(*drive.wheel_speeds(*twist)) == pytest.approx(twist, abs=1e-15)


def test_turn_on_the_spot_turns_the_wheels_against_each_other():
    left, right = DifferentialDrive(0.5, 0.1, 0.1).wheel_speeds(0.0, 2.0)
    assert (left, right) == pytest.approx((-5.0, 5.0))


def test_inner_wheel_of_a_curve_about_itself_stands():
    left, right = DifferentialDrive(0.5, 0.1, 0.1).wheel_speeds(0.25, 1.0)
    assert left == pytest.approx(0.0)
    assert right == pytest.approx(5.0)
