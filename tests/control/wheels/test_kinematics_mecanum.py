"""Mecanum wheels: round trip, and the patterns everybody knows."""

from __future__ import annotations

import pytest

from gazelle.control.wheels.kinematics import MecanumDrive, PlanarTwist

DRIVE = MecanumDrive(0.05, 0.4)


@pytest.mark.parametrize("offset", [(0.0, 0.0, 0.0), (0.1, -0.2, 0.7)])
def test_twist_of_the_wheel_speeds_is_the_twist(offset):
    drive = MecanumDrive(0.05, 0.4, *offset)
    twist = PlanarTwist(0.3, -0.2, 0.9)
    assert drive.twist(drive.wheel_speeds(twist)) == pytest.approx(twist, abs=1e-14)


def test_sideways_drive_turns_diagonal_wheels_alike():
    speeds = DRIVE.wheel_speeds(PlanarTwist(0.0, 0.2, 0.0))
    assert speeds._asdict() == pytest.approx(
        {"front_left": -4.0, "front_right": 4.0, "rear_right": -4.0, "rear_left": 4.0}
    )


def test_turn_drives_the_sides_against_each_other():
    speeds = DRIVE.wheel_speeds(PlanarTwist(0.0, 0.0, 1.0))
    assert speeds == pytest.approx((-8.0, 8.0, 8.0, -8.0))


def test_base_frame_ahead_of_the_centre_swings_out_when_the_centre_turns():
    ahead = MecanumDrive(0.05, 0.4, offset_x_m=0.3)
    assert ahead.twist(DRIVE.wheel_speeds(PlanarTwist(0, 0, 1.0))) == pytest.approx((0.0, 0.3, 1.0))
