"""Kinematics of a differential drive: commands to wheels, wheels to odometry. Pure functions."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.geometry import Pose

__all__ = ["EncoderOdometry", "SpeedLimiter", "WheelRamp", "wheel_speeds"]

# Below this difference Gazebo's plug-in commands the target at once (m/s).
_NEAR_M_S = 0.01


def wheel_speeds(
    linear_m_s: float, angular_rad_s: float, separation_m: float, *, exchanged: bool
) -> tuple[float, float]:
    """Return the rim speeds of the joints named left and right, m/s.

    Args:
        linear_m_s: forward speed.
        angular_rad_s: yaw rate, positive to the left (REP 103).
        separation_m: distance of the wheels.
        exchanged: ``legacyMode`` of Gazebo's plug-in up to ROS Kinetic: the joint named left
            gets what the right wheel needs.
    """
    turn = angular_rad_s * separation_m / 2
    if exchanged:
        turn = -turn
    return linear_m_s - turn, linear_m_s + turn


class SpeedLimiter:
    """Keeps a speed and its rate of change within bounds, as gz-sim does.

    Attributes:
        value: the last speed.
    """

    def __init__(self, lowest: float, highest: float, braking: float, acceleration: float) -> None:
        self._bounds = (lowest, highest)
        self._rates = (braking, acceleration)
        self.value = 0.0

    def follow(self, wanted: float, period_s: float) -> float:
        """Return the next value towards `wanted`."""
        wanted = max(self._bounds[0], min(wanted, self._bounds[1]))
        least, most = (self.value + rate * period_s for rate in self._rates)
        self.value = max(least, min(wanted, most))
        return self.value


class WheelRamp:
    """``wheelAcceleration`` as `gazebo_ros_diff_drive` ramps it (UpdateChild, ROS Kinetic).

    As soon as one wheel is within 0.01 m/s of its target both are commanded their targets; until
    then each wheel's command moves towards the target by at most one period's acceleration.
    """

    def __init__(self, acceleration_m_s2: float) -> None:
        self._acceleration_m_s2 = acceleration_m_s2
        self._issued = [0.0, 0.0]

    def command(
        self, target: tuple[float, float], actual: tuple[float, float], period_s: float
    ) -> tuple[float, float]:
        """Return the rim speeds to command, from the targets and the measured ones (m/s)."""
        left, right = target[0] - actual[0], target[1] - actual[1]
        near = abs(left) < _NEAR_M_S or abs(right) < _NEAR_M_S
        if near or self._acceleration_m_s2 == 0:
            return target
        most = self._acceleration_m_s2 * period_s
        self._issued[0] += max(-most, min(left, most))
        self._issued[1] += max(-most, min(right, most))
        return self._issued[0], self._issued[1]

    def reset(self) -> None:
        """Start from rest."""
        self._issued = [0.0, 0.0]


@dataclass(slots=True)
class EncoderOdometry:
    """Dead reckoning from the wheels' angles (Siegwart 2011, Autonomous Mobile Robots, p. 337).

    Attributes:
        separation_m, radius_m: the parameters, which need not be the geometry's.
        exchanged: ``legacyMode``: left and right change places.
    """

    separation_m: float
    radius_m: float
    exchanged: bool
    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0
    forward_m_s: float = 0.0
    yaw_rate_rad_s: float = 0.0

    def update(self, left_rad: float, right_rad: float, period_s: float) -> None:
        """Go on by the angles both wheels turned within a period."""
        left, right = left_rad * self.radius_m, right_rad * self.radius_m
        if self.exchanged:
            left, right = right, left
        distance, turn = (left + right) / 2, (right - left) / self.separation_m
        heading = self.yaw_rad + turn / 2
        self.x_m += distance * math.cos(heading)
        self.y_m += distance * math.sin(heading)
        self.yaw_rad += turn
        self.forward_m_s = distance / period_s
        self.yaw_rate_rad_s = turn / period_s

    def pose(self) -> Pose:
        """Return the pose in the odometry frame."""
        return Pose.from_xy_yaw(self.x_m, self.y_m, self.yaw_rad)

    def reset(self) -> None:
        """Start over at the origin."""
        self.x_m = self.y_m = self.yaw_rad = self.forward_m_s = self.yaw_rate_rad_s = 0.0
