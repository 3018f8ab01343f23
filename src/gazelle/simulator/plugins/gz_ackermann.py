"""The gz-sim system ``AckermannSteering``."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from gazelle.geometry import Pose
from gazelle.simulator.plugins.ackermann import GZ_TABLE, steering_angles
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.diff_drive_kinematics import SpeedLimiter
from gazelle.simulator.plugins.drive import Velocity, run_drive, take_velocities
from gazelle.simulator.plugins.drive_odometry import DriveOdometry, gz_odometry_setup
from gazelle.simulator.plugins.plugin_parameters import PluginReader
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["load"]

# gz-sim commands joint velocities outright; the engine needs some bound on the torque.
_TORQUE_NM = 1e3
_STRAIGHT_M = 1e9
_NO_TURN_RAD_S = 1e-3


def load(context: PluginContext) -> None:
    """Start a car; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(GZ_TABLE)
    keys = ["left_steering_joint", "right_steering_joint"]
    if not parameters.flag("steering_only"):
        keys += ["left_joint", "right_joint"]
    names: dict[str, list[str]] = {}
    for key in keys:
        found = [context.joint_name(name) for name in parameters.texts(key)]
        names[key] = [name for name in found if name is not None]
        if not found:
            text = f"plug-in '{context.plugin.name}' names no <{key}>; it is left out"
            context.report("plugin.missing-joint", text)
    if all(names[key] and len(names[key]) == len(parameters.texts(key)) for key in keys):
        _GzCar(context, parameters, names)
    parameters.report_unread()


class _GzCar:
    """One running car."""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, names: dict[str, list[str]]
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._joints = {
            key: [self._engine.joint(name) for name in some] for key, some in names.items()
        }
        number = parameters.number
        self._separation_m, self._base_m = number("wheel_separation"), number("wheel_base")
        self._kingpin_m, self._radius_m = number("kingpin_width"), number("wheel_radius")
        self._limit, self._gain = number("steering_limit"), number("steer_p_gain")
        keys = ("min_velocity", "max_velocity", "min_acceleration", "max_acceleration")
        self._speed, self._turn = (SpeedLimiter(*map(number, keys)) for _ in range(2))
        self._only_steers = parameters.flag("steering_only")
        self._command = Velocity()
        self._place = (0.0, 0.0, 0.0)
        self._last_roll = self._roll()
        self._offer(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        own = parameters.text("sub_topic") or ("steer_angle" if self._only_steers else "cmd_vel")
        topic = parameters.text("topic") or f"/model/{context.model.name}/{own}"
        topic = join_names("/", topic)
        if self._only_steers:
            resources.subscription(topic, None, self._hear, announced="std_msgs/msg/Float64")
        else:
            take_velocities(context, topic, self._take)
        joints = (joint for some in self._joints.values() for joint in some)
        run_drive(context, joints, Fraction(1), self._control, self._reset)
        if self._only_steers:
            return
        self._odometry = DriveOdometry(context, gz_odometry_setup(context, parameters))
        rate = parameters.number("odom_publish_frequency")
        period = period_in_steps(rate, self._engine.step_ns)
        self._publish_period_s = max(1.0, float(period)) * self._engine.step_ns * 1e-9
        resources.task(f"{context.plugin.name} odometry", period, self._publish)

    def _hear(self, message: Any) -> None:
        self._command = Velocity(turn=float(message.data))

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _control(self) -> None:
        period_s = self._engine.step_ns * 1e-9
        speed = self._speed.follow(self._command.forward, period_s)
        turn = self._turn.follow(self._command.turn, period_s)
        if self._only_steers:
            angle = min(max(turn, -self._limit), self._limit)
            self._steer(*steering_angles(angle, self._separation_m, self._base_m))
            return
        radius = self._turning_radius(speed, turn)
        self._steer(
            math.atan(self._base_m / (radius - self._kingpin_m / 2)),
            math.atan(self._base_m / (radius + self._kingpin_m / 2)),
        )
        for key, side in (("left_joint", -1.0), ("right_joint", 1.0)):
            rim = speed * (1.0 + side * self._separation_m / (2.0 * radius))
            for joint in self._joints[key]:
                joint.set_velocity_target(rim / self._radius_m, _TORQUE_NM)

    def _turning_radius(self, speed: float, turn: float) -> float:
        if abs(turn) < _NO_TURN_RAD_S:
            return _STRAIGHT_M
        least = self._base_m / math.sin(self._limit)
        if speed == 0.0:
            return math.copysign(least, turn)
        radius = speed / turn
        return math.copysign(max(abs(radius), least), radius)

    def _steer(self, left: float, right: float) -> None:
        for key, angle in (("left_steering_joint", left), ("right_steering_joint", right)):
            rate = self._gain * (angle - self._joints[key][0].position)
            for joint in self._joints[key]:
                joint.set_velocity_target(rate, _TORQUE_NM)

    def _publish(self) -> None:
        moved, turned = self._reckon()
        motion = (moved / self._publish_period_s, 0.0, turned / self._publish_period_s)
        self._odometry.publish(Pose.from_xy_yaw(*self._place), motion)

    def _reckon(self) -> tuple[float, float]:
        """Go on by what wheels rolled since the last time; returns distance and turn."""
        roll, last = self._roll(), self._last_roll
        self._last_roll = roll
        moved = (roll - last) * self._radius_m
        sides = ("left_steering_joint", "right_steering_joint")
        steer = sum(self._joints[key][0].position for key in sides) / 2
        turned = moved * math.tan(steer) / self._base_m
        x, y, yaw = self._place
        yaw += turned
        self._place = (x + moved * math.cos(yaw), y + moved * math.sin(yaw), yaw)
        return moved, turned

    def _roll(self) -> float:
        if self._only_steers:
            return 0.0
        return sum(self._joints[key][0].position for key in ("left_joint", "right_joint")) / 2

    def _reset(self) -> None:
        self._command = Velocity()
        self._speed.value = self._turn.value = 0.0
        self._place, self._last_roll = (0.0, 0.0, 0.0), self._roll()
