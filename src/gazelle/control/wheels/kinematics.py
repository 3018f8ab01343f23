"""Kinematics of steered bases: bicycle, tricycle and Ackermann.

Angles are positive to the left. The *virtual* wheel stands in the middle of the steered axle; its
angle is what a bicycle would steer. The origin is the middle of the axle that is not steered.
"""

from __future__ import annotations

import math
from typing import NamedTuple

__all__ = ["AxlePair", "SteeringGeometry", "reduced_until_steered"]

# Below this angle steering_controllers_library takes wheels as straight (rad).
_STRAIGHT_RAD = 1e-6


class AxlePair(NamedTuple):
    """Values of the right and the left wheel of an axle, in ros2_controllers' order."""

    right: float
    left: float


class SteeringGeometry(NamedTuple):
    """Measures of a steered base.

    Attributes:
        wheelbase_m: distance of the two axles.
        wheel_radius_m: of the driven wheels.
        traction_track_m: distance of the two driven wheels.
        steering_track_m: distance of the two steered wheels.
    """

    wheelbase_m: float
    wheel_radius_m: float
    traction_track_m: float = 0.0
    steering_track_m: float = 0.0

    def steering_angle(self, linear_m_s: float, angular_rad_s: float) -> float:
        """Return the virtual wheel's angle; a quarter turn for turning on the spot."""
        if linear_m_s == 0:
            return math.copysign(math.pi / 2, angular_rad_s) if angular_rad_s else 0.0
        return math.atan(angular_rad_s * self.wheelbase_m / linear_m_s)

    def yaw_rate(self, linear_m_s: float, angle_rad: float) -> float:
        """Return the yaw rate of a base that rolls along with its virtual wheel at an angle."""
        return math.tan(angle_rad) * linear_m_s / self.wheelbase_m

    def axle_speeds(self, linear_m_s: float, angle_rad: float) -> AxlePair:
        """Return the speeds of the two driven wheels, rad/s: the outer one is faster."""
        rate = linear_m_s / self.wheel_radius_m
        lean = self.traction_track_m / 2 * math.tan(angle_rad) / self.wheelbase_m
        if abs(angle_rad) < _STRAIGHT_RAD:
            lean = 0.0
        return AxlePair(rate * (1 + lean), rate * (1 - lean))

    def axle_linear(self, speeds: AxlePair, angle_rad: float) -> float:
        """Return the forward speed (m/s) that the two driven wheels (rad/s) tell, their mean."""
        lean = self.traction_track_m / 2 * math.tan(angle_rad) / self.wheelbase_m
        right = speeds.right * self.wheel_radius_m / (1 + lean)
        left = speeds.left * self.wheel_radius_m / (1 - lean)
        return (right + left) / 2

    def wheel_angles(self, angle_rad: float) -> AxlePair:
        """Return the angles of two steered wheels whose axes meet the other axle in one point."""
        if abs(angle_rad) < _STRAIGHT_RAD:
            return AxlePair(angle_rad, angle_rad)
        sine, cosine = math.sin(angle_rad), math.cos(angle_rad)
        along, across = 2 * self.wheelbase_m * sine, self.steering_track_m * sine
        ahead = 2 * self.wheelbase_m * cosine
        return AxlePair(math.atan2(along, ahead + across), math.atan2(along, ahead - across))

    def virtual_angle(self, angles: AxlePair) -> float:
        """Return the virtual wheel's angle from the two steered wheels, the mean of both."""
        half = self.steering_track_m / 2
        estimates = [
            math.atan(self.wheelbase_m * math.tan(a) / (self.wheelbase_m + side * math.tan(a)))
            for a, side in ((angles.right, -half), (angles.left, half))
        ]
        return sum(estimates) / 2


def reduced_until_steered(speed: float, error_rad: float) -> float:
    """Return a wheel's speed, lower while the steering is more than 30° from its target.

    `steering_controllers_library`, ``reduce_wheel_speed_until_steering_reached``.
    """
    free = math.pi / 6
    error = min(abs(error_rad), 1.5608)
    return speed if error < free else speed * math.cos(error) / math.cos(free)
