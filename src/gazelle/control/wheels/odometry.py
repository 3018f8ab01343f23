"""Dead reckoning in the plane."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.control.controller_node_interface import Ports

__all__ = [
    "PlanarOdometry",
    "PlanarPose",
    "RollingMean",
    "WheelTravel",
    "moved_euler",
    "moved_exact",
    "moved_runge_kutta",
    "offer_reset_odometry",
    "offer_set_odometry",
]


# ros_controllers integrate smaller turns along a chord (rad).
_STRAIGHT_RAD = 1e-6


class PlanarPose(NamedTuple):
    """A pose in the odometry frame."""

    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0


def moved_euler(pose: PlanarPose, forward_m: float, left_m: float, turn_rad: float) -> PlanarPose:
    """Return the pose after a path in the heading of its beginning: first order."""
    x, y = _turned(forward_m, left_m, pose.yaw_rad)
    return PlanarPose(pose.x_m + x, pose.y_m + y, pose.yaw_rad + turn_rad)


def moved_runge_kutta(
    pose: PlanarPose, forward_m: float, left_m: float, turn_rad: float
) -> PlanarPose:
    """Return the pose after a path in the mean heading: second order."""
    x, y = _turned(forward_m, left_m, pose.yaw_rad + turn_rad / 2)
    return PlanarPose(pose.x_m + x, pose.y_m + y, pose.yaw_rad + turn_rad)


def moved_exact(pose: PlanarPose, forward_m: float, left_m: float, turn_rad: float) -> PlanarPose:
    """Return the pose after an arc: exact while the velocity does not change."""
    if abs(turn_rad) < _STRAIGHT_RAD:
        return moved_runge_kutta(pose, forward_m, left_m, turn_rad)
    along, across = math.sin(turn_rad) / turn_rad, (1 - math.cos(turn_rad)) / turn_rad
    chord_x = along * forward_m - across * left_m
    chord_y = across * forward_m + along * left_m
    x, y = _turned(chord_x, chord_y, pose.yaw_rad)
    return PlanarPose(pose.x_m + x, pose.y_m + y, pose.yaw_rad + turn_rad)


def _turned(x: float, y: float, yaw_rad: float) -> tuple[float, float]:
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    return cos * x - sin * y, sin * x + cos * y


class RollingMean:
    """Mean of the last values, of fewer while there are fewer (``RollingMeanAccumulator``)."""

    def __init__(self, window: int) -> None:
        self._values: deque[float] = deque(maxlen=max(window, 1))

    def add(self, value: float) -> float:
        """Take a value and return the mean."""
        self._values.append(value)
        return math.fsum(self._values) / len(self._values)

    def clear(self) -> None:
        """Forget all."""
        self._values.clear()


class WheelTravel:
    """Differences of wheel angles; the first angles are the start and count as no travel.

    ros_controllers measure the first difference from angle 0, and after a stop from where the
    wheels were, so odometry jumps when wheels stand elsewhere or the world was reset; here every
    start begins where they stand.
    """

    def __init__(self) -> None:
        self._last: tuple[float, ...] | None = None

    def step(self, angles: tuple[float, ...]) -> tuple[float, ...]:
        """Return how far each wheel turned since the call before, rad."""
        last, self._last = self._last or angles, angles
        return tuple(now - before for now, before in zip(angles, last, strict=True))

    def clear(self) -> None:
        """Start anew with the next angles."""
        self._last = None


class PlanarOdometry:
    """Pose and mean velocity of a base.

    Attributes:
        pose: in the odometry frame.
        linear_x, linear_y: in the base frame, m/s, means over the window.
        angular_z: rad/s, mean over the window.

    Args:
        window: number of values a velocity is the mean of.
    """

    def __init__(self, window: int = 1) -> None:
        self.pose = PlanarPose()
        self.linear_x = self.linear_y = self.angular_z = 0.0
        self._means = (RollingMean(window), RollingMean(window), RollingMean(window))

    def drive(self, linear_x: float, linear_y: float, angular_z: float, period_s: float) -> None:
        """Go on by a velocity that was measured, and average it."""
        self._integrate(linear_x, linear_y, angular_z, period_s)
        self.linear_x = self._means[0].add(linear_x)
        self.linear_y = self._means[1].add(linear_y)
        self.angular_z = self._means[2].add(angular_z)

    def drive_open_loop(
        self, linear_x: float, linear_y: float, angular_z: float, period_s: float
    ) -> None:
        """Go on by a velocity that was commanded."""
        self._integrate(linear_x, linear_y, angular_z, period_s)
        self.linear_x, self.linear_y, self.angular_z = linear_x, linear_y, angular_z

    def forget_velocities(self) -> None:
        """Begin new means."""
        for mean in self._means:
            mean.clear()

    def put(self, pose: PlanarPose) -> None:
        """Say where the base is."""
        self.pose = pose
        self.forget_velocities()

    def _integrate(self, x: float, y: float, turn: float, period_s: float) -> None:
        self.pose = moved_exact(self.pose, x * period_s, y * period_s, turn * period_s)


def offer_set_odometry(
    ports: Ports, odometry: PlanarOdometry, is_active: Callable[[], bool]
) -> None:
    """Offer ``~/set_odometry`` of ros2_controllers."""

    def handle(request: Any, response: Any) -> None:
        response.success = is_active()
        if response.success:
            odometry.put(PlanarPose(float(request.x), float(request.y), float(request.yaw)))
            response.message = "Odometry set request accepted"
        else:
            response.message = "Controller is not active"

    ports.service("~/set_odometry", "control_msgs/SetOdometry", handle)


def offer_reset_odometry(ports: Ports, odometry: PlanarOdometry) -> None:
    """Offer ``~/reset_odometry`` of tricycle_controller."""

    def handle(request: Any, response: Any) -> None:
        odometry.put(PlanarPose())

    ports.service("~/reset_odometry", "std_srvs/Empty", handle)
