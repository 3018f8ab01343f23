"""Kinematics of four mecanum wheels."""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["MecanumDrive", "MecanumSpeeds", "PlanarTwist"]


class PlanarTwist(NamedTuple):
    """A base's velocity in its own frame: m/s forward and to the left, rad/s."""

    linear_x: float
    linear_y: float
    angular_z: float


class MecanumSpeeds(NamedTuple):
    """Speeds of the wheels, rad/s, in mecanum_drive_controller's order."""

    front_left: float
    front_right: float
    rear_right: float
    rear_left: float


class MecanumDrive(NamedTuple):
    """Four wheels with rollers at 45° (mecanum_drive_controller, Lynch & Park section 13.2).

    Attributes:
        radius_m: of the wheels.
        half_sum_m: half the length plus half the width between the wheels' centres.
        offset_x_m, offset_y_m, offset_rad: pose of the base frame in the frame of the centre.
    """

    radius_m: float
    half_sum_m: float
    offset_x_m: float = 0.0
    offset_y_m: float = 0.0
    offset_rad: float = 0.0

    def wheel_speeds(self, twist: PlanarTwist) -> MecanumSpeeds:
        """Return the wheels' speeds for a velocity of the base frame."""
        x, y = self._rotated(twist.linear_x, twist.linear_y, self.offset_rad)
        x += self.offset_y_m * twist.angular_z
        y -= self.offset_x_m * twist.angular_z
        turn = self.half_sum_m * twist.angular_z
        rims = (x - y - turn, x + y + turn, x - y + turn, x + y - turn)
        return MecanumSpeeds(*(rim / self.radius_m for rim in rims))

    def twist(self, speeds: MecanumSpeeds) -> PlanarTwist:
        """Return the velocity of the base frame that fits the wheels' speeds best."""
        fl, fr, rr, rl = speeds
        quarter = self.radius_m / 4
        turn = quarter / self.half_sum_m * (-fl - rl + rr + fr)
        x = quarter * (fl + rl + rr + fr) - self.offset_y_m * turn
        y = quarter * (-fl + rl - rr + fr) + self.offset_x_m * turn
        return PlanarTwist(*self._rotated(x, y, -self.offset_rad), turn)

    @staticmethod
    def _rotated(x: float, y: float, angle_rad: float) -> tuple[float, float]:
        cos, sin = math.cos(angle_rad), math.sin(angle_rad)
        return cos * x - sin * y, sin * x + cos * y
