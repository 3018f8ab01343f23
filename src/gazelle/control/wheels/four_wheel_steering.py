"""Kinematics of a base that steers front and rear wheels.

The origin is the middle of the base. Each axle has a *virtual* wheel in its middle; the real ones
stand beside it, so that all axes meet in one point.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gazelle.control.wheels.mecanum import PlanarTwist

__all__ = ["FourWheelSteering", "FourWheelValues", "virtual_angle"]

# four_wheel_steering_controller drives no wheel below this speed (m/s) and takes smaller angles
# as straight (rad).
_SLOW_M_S = 0.001
_STRAIGHT_RAD = 0.001


class FourWheelValues(NamedTuple):
    """A value for every wheel: speeds in rad/s or angles in rad."""

    front_left: float
    front_right: float
    rear_left: float
    rear_right: float


class _Axle(NamedTuple):
    """Virtual wheel of an axle: angle in rad, speed along it in m/s, yaw rate in rad/s."""

    angle: float
    speed: float
    yaw_rate: float


def virtual_angle(left_rad: float, right_rad: float) -> float:
    """Return the virtual wheel's angle; its cotangent is the mean of the wheels' cotangents."""
    if abs(left_rad) <= _STRAIGHT_RAD and abs(right_rad) <= _STRAIGHT_RAD:
        return 0.0
    left, right = math.tan(left_rad), math.tan(right_rad)
    return math.atan(2 * left * right / (left + right)) if left + right else 0.0


class FourWheelSteering(NamedTuple):
    """Measures of the base.

    Attributes:
        steering_track_m: distance of the two steering axes of an axle.
        y_offset_m: how far a wheel stands outside of its steering axis.
        wheel_radius_m: of all wheels.
        wheel_base_m: distance of the axles.
    """

    steering_track_m: float
    y_offset_m: float
    wheel_radius_m: float
    wheel_base_m: float

    def from_twist(self, linear: float, angular: float) -> tuple[FourWheelValues, FourWheelValues]:
        """Return speeds and angles for a twist, the rear wheels steered against the front ones."""
        half = angular * self.steering_track_m / 2
        along = self.wheel_base_m * angular / 2
        left = right = 0.0
        if abs(linear) > abs(half):
            left, right = math.atan(along / (linear - half)), math.atan(along / (linear + half))
        elif abs(linear) > _SLOW_M_S:
            left = right = math.copysign(math.pi / 2, angular)
        speeds = self._speeds(linear, angular, along, along)
        return speeds, FourWheelValues(left, right, -left, -right)

    def from_angles(
        self, speed: float, front_rad: float, rear_rad: float
    ) -> tuple[FourWheelValues, FourWheelValues]:
        """Return speeds and angles for a forward speed and the virtual wheels' angles."""
        front, rear = math.tan(front_rad), math.tan(rear_rad)
        base = self.wheel_base_m
        lean = self.steering_track_m * (front - rear) / 2
        angles = FourWheelValues(0.0, 0.0, 0.0, 0.0)
        if abs(base - abs(lean)) > _STRAIGHT_RAD:
            inner, outer = base / (base - lean), base / (base + lean)
            tangents = (front * inner, front * outer, rear * inner, rear * outer)
            angles = FourWheelValues(*map(math.atan, tangents))
        angular = speed * (front - rear) / base
        speeds = self._speeds(speed, angular, speed * front, speed * rear)
        return speeds, angles

    def twist(self, speeds: FourWheelValues, front_rad: float, rear_rad: float) -> PlanarTwist:
        """Return the base's velocity from the wheels' speeds and the virtual wheels' angles."""
        turn = (math.tan(front_rad) - math.tan(rear_rad)) / self.wheel_base_m
        ends = (
            self._axle(
                speeds.front_left, speeds.front_right, front_rad, math.cos(front_rad) * turn
            ),
            self._axle(speeds.rear_left, speeds.rear_right, rear_rad, math.cos(rear_rad) * turn),
        )
        return PlanarTwist(
            sum(end.speed * math.cos(end.angle) for end in ends) / 2,
            sum(end.speed * math.sin(end.angle) for end in ends) / 2,
            sum(end.yaw_rate for end in ends) / 2,
        )

    def _speeds(self, linear: float, angular: float, front: float, rear: float) -> FourWheelValues:
        """Return wheel speeds; `front` and `rear` are the axles' sideways speeds."""
        if abs(linear) <= _SLOW_M_S:
            return FourWheelValues(0.0, 0.0, 0.0, 0.0)
        half, offset = angular * self.steering_track_m / 2, angular * self.y_offset_m
        sign = math.copysign(1.0, linear)
        left, right = linear - half, linear + half
        rims = (
            sign * math.hypot(left, front) - offset,
            sign * math.hypot(right, front) + offset,
            sign * math.hypot(left, rear) - offset,
            sign * math.hypot(right, rear) + offset,
        )
        return FourWheelValues(*(rim / self.wheel_radius_m for rim in rims))

    def _axle(self, left: float, right: float, angle: float, curvature: float) -> _Axle:
        """`curvature` is yaw rate by the virtual wheel's speed."""
        bow = self.steering_track_m * curvature
        pivots = []
        for rate, side in ((left, -1), (right, 1)):
            stretch = math.sqrt(1 + side * bow * math.cos(angle) + (bow / 2) ** 2)
            pivots.append(
                rate * self.wheel_radius_m / (1 + side * self.y_offset_m * curvature / stretch)
            )
        size = math.sqrt((pivots[0] ** 2 + pivots[1] ** 2) / (2 + bow**2 / 2))
        speed = math.copysign(size, sum(pivots))
        return _Axle(angle, speed, speed * curvature)
