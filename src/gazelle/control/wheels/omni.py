"""Kinematics of a round base on omnidirectional wheels."""

from __future__ import annotations

import numpy as np

from gazelle.control.interface_values import Array
from gazelle.control.wheels.mecanum import PlanarTwist

__all__ = ["OmniDrive"]


class OmniDrive:
    """Three or more wheels at equal angles on a circle (omni_wheel_drive_controller).

    Args:
        count: number of wheels, counter-clockwise.
        robot_radius_m: of the circle.
        wheel_radius_m: of the wheels.
        offset_rad: angle of the first wheel from the base's x axis.
    """

    def __init__(
        self, count: int, robot_radius_m: float, wheel_radius_m: float, offset_rad: float = 0.0
    ) -> None:
        theta = offset_rad + 2 * np.pi * np.arange(count) / count
        columns = (np.sin(theta), -np.cos(theta), np.full(count, -robot_radius_m))
        self._to_wheels: Array = np.column_stack(columns) / wheel_radius_m
        self._to_twist = np.linalg.pinv(self._to_wheels)

    def wheel_speeds(self, twist: PlanarTwist) -> Array:
        """Return the wheels' speeds (N,), rad/s."""
        return np.asarray(self._to_wheels @ np.array(twist))

    def twist(self, speeds: Array) -> PlanarTwist:
        """Return the velocity that fits the wheels' speeds (N,) best in the sense of squares."""
        x, y, turn = (self._to_twist @ speeds).tolist()
        return PlanarTwist(x, y, turn)
