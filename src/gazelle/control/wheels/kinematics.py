"""Kinematics of wheeled bases: differential, mecanum, omni, steered by one axle or by two.

Angles are positive to the left. The *virtual* wheel stands in the middle of the steered axle; its
angle is what a bicycle would steer. The origin of a base that steers one axle is the middle of the
other one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gazelle.control.interface_values import Array

__all__ = [
    "AxlePair",
    "DifferentialDrive",
    "FourWheelSteering",
    "FourWheelValues",
    "MecanumDrive",
    "MecanumSpeeds",
    "OmniDrive",
    "PlanarTwist",
    "SteeringGeometry",
    "reduced_until_steered",
    "virtual_angle",
]


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


# four_wheel_steering_controller drives no wheel below this speed (m/s) and takes smaller angles
# as straight (rad).
_SLOW_M_S = 0.001

_PARALLEL_RAD = 0.001


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
    if abs(left_rad) <= _PARALLEL_RAD and abs(right_rad) <= _PARALLEL_RAD:
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
        if abs(base - abs(lean)) > _PARALLEL_RAD:
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
