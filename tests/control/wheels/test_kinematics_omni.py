"""Omnidirectional wheels: round trip, and a wheel's own law."""

from __future__ import annotations

import math

import pytest

from gazelle.control.wheels.kinematics import OmniDrive, PlanarTwist


@pytest.mark.parametrize("count", [3, 4, 5])
def test_twist_of_the_wheel_speeds_is_the_twist(count):
    drive = OmniDrive(count, 0.3, 0.05, 0.4)
    twist = PlanarTwist(0.3, -0.2, 0.9)
    assert drive.twist(drive.wheel_speeds(twist)) == pytest.approx(twist, abs=1e-14)


def test_rim_moves_like_the_body_along_the_wheel():
    radius, wheel, offset = 0.3, 0.05, 0.2
    twist = PlanarTwist(0.3, -0.2, 0.9)
    speeds = OmniDrive(3, radius, wheel, offset).wheel_speeds(twist)
    for place, speed in enumerate(speeds):
        theta = offset + 2 * math.pi * place / 3
        x, y = radius * math.cos(theta), radius * math.sin(theta)
        body = (twist.linear_x - twist.angular_z * y, twist.linear_y + twist.angular_z * x)
        along = math.sin(theta) * body[0] - math.cos(theta) * body[1]
        assert speed * wheel == pytest.approx(along)
