"""Kinematics of a differential drive."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["DifferentialDrive"]


class DifferentialDrive(NamedTuple):
    """Two driven sides across the direction of travel (Siegwart 2011, section 3.2).

    Attributes:
        separation_m: distance of the two sides.
        left_radius_m, right_radius_m: of the wheels.
    """

    separation_m: float
    left_radius_m: float
    right_radius_m: float

    def wheel_speeds(self, linear_m_s: float, angular_rad_s: float) -> tuple[float, float]:
        """Return the speeds of the left and right wheels, rad/s."""
        turn = angular_rad_s * self.separation_m / 2
        return (linear_m_s - turn) / self.left_radius_m, (linear_m_s + turn) / self.right_radius_m

    def twist(self, left_rad_s: float, right_rad_s: float) -> tuple[float, float]:
        """Return forward speed (m/s) and yaw rate (rad/s); also takes angles and gives a path."""
        left, right = left_rad_s * self.left_radius_m, right_rad_s * self.right_radius_m
        return (left + right) / 2, (right - left) / self.separation_m
