"""The gz-sim system ``DiffDrive`` (and its Ignition names)."""

from __future__ import annotations

import math
from typing import Any

from gazelle.simulator.messages import (
    header,
    message_class,
    pose_message,
    transform_stamped,
    twist_message,
)
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.diff_drive_table import GZ_TABLE
from gazelle.simulator.plugins.parameters import PluginReader
from gazelle.simulator.plugins.wheel_checks import check_drive
from gazelle.simulator.plugins.wheel_motion import EncoderOdometry, wheel_speeds
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["load"]

# gz-sim commands joint velocities outright; the engine needs some bound on the torque.
_TORQUE_NM = 1e3
# gz-sim limits and commands at every step; a hundredth of a second is fine enough.
_CONTROL_HZ = 100.0


def load(context: PluginContext) -> None:
    """Start a drive; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(GZ_TABLE)
    left = [context.joint_name(name) for name in parameters.texts("left_joint")]
    right = [context.joint_name(name) for name in parameters.texts("right_joint")]
    if not left or not right:
        text = f"plug-in '{context.plugin.name}' names no left or no right joint; it is left out"
        context.report("plugin.missing-joint", text)
    elif None not in left and None not in right:
        names = ([name for name in left if name], [name for name in right if name])
        _GzDrive(context, parameters, names)
    parameters.report_unread()


class _Limiter:
    """Keeps a speed and its rate of change within bounds."""

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


class _GzDrive:
    """One running drive."""

    def __init__(
        self,
        context: PluginContext,
        parameters: PluginReader,
        names: tuple[list[str], list[str]],
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._joints = [[self._engine.joint(name) for name in side] for side in names]
        separation = parameters.number("wheel_separation")
        self._separation_m = separation
        self._radius_m = parameters.number("wheel_radius")
        check_drive(
            context, (names[0][0], names[1][0]), separation, 2 * self._radius_m, exchanged=False
        )
        self._odometry = EncoderOdometry(separation, self._radius_m, exchanged=False)
        self._last_angles = self._angles()
        self._command = (0.0, 0.0)
        self._linear = _limiter(parameters, "velocity", "acceleration")
        self._angular = _limiter(parameters, "angular_velocity", "angular_acceleration")
        self._offer(parameters)
        self._start(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        model, resources = self._context.model, self._context.resources

        def named(key: str) -> str:
            text = parameters.text(key)
            return text.replace("{model}", model.name).replace("{link}", model.canonical_link)

        self._frames = (named("frame_id"), named("child_frame_id"))
        command_topic = join_names("/", named("topic"))
        # Twist and TwistStamped are both taken.
        resources.subscription(
            command_topic, None, self._take_command, announced="geometry_msgs/msg/Twist"
        )
        odom_topic, tf_topic = join_names("/", named("odom_topic")), named("tf_topic")
        self._odom_publisher = resources.publisher(odom_topic, "nav_msgs/Odometry")
        self._tf_publisher = resources.publisher(join_names("/", tf_topic), "tf2_msgs/TFMessage")

    def _start(self, parameters: PluginReader) -> None:
        step_ns, resources = self._engine.step_ns, self._context.resources
        period = period_in_steps(parameters.number("odom_publish_frequency"), step_ns)
        self._publish_period_s = float(period * step_ns) * 1e-9
        control = period_in_steps(_CONTROL_HZ, step_ns)
        self._control_period_s = float(control * step_ns) * 1e-9
        resources.task(f"{self._context.plugin.name} drive", control, self._control)
        resources.task(f"{self._context.plugin.name} odometry", period, self._publish)
        resources.on_reset(self._reset)
        resources.on_close(self._release)

    def _take_command(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        self._command = (float(twist.linear.x), float(twist.angular.z))

    def _control(self) -> None:
        linear = self._linear.follow(self._command[0], self._control_period_s)
        angular = self._angular.follow(self._command[1], self._control_period_s)
        speeds = wheel_speeds(linear, angular, self._separation_m, exchanged=False)
        for joints, speed in zip(self._joints, speeds, strict=True):
            for joint in joints:
                joint.set_velocity_target(speed / self._radius_m, _TORQUE_NM)

    def _publish(self) -> None:
        angles, last = self._angles(), self._last_angles
        self._last_angles = angles
        odometry = self._odometry
        odometry.update(angles[0] - last[0], angles[1] - last[1], self._publish_period_s)
        time_ns = self._engine.time_ns
        frame, child = self._frames
        if self._odom_publisher.matched:
            message = message_class("nav_msgs/Odometry")(
                header=header(time_ns, frame), child_frame_id=child
            )
            message.pose.pose = pose_message(odometry.pose())
            linear = (odometry.forward_m_s, 0.0, 0.0)
            message.twist.twist = twist_message(linear, (0.0, 0.0, odometry.yaw_rate_rad_s))
            self._odom_publisher.publish(message)
        if self._tf_publisher.matched:
            transform = transform_stamped(time_ns, frame, child, odometry.pose())
            self._tf_publisher.publish(message_class("tf2_msgs/TFMessage")(transforms=[transform]))

    def _angles(self) -> tuple[float, float]:
        left, right = (math.fsum(j.position for j in side) / len(side) for side in self._joints)
        return left, right

    def _reset(self) -> None:
        self._command = (0.0, 0.0)
        self._linear.value = self._angular.value = 0.0
        self._odometry.reset()
        self._last_angles = self._angles()

    def _release(self) -> None:
        for joint in (joint for side in self._joints for joint in side):
            joint.release()


def _limiter(parameters: PluginReader, speed: str, rate: str) -> _Limiter:
    return _Limiter(
        parameters.number(f"min_{speed}"),
        parameters.number(f"max_{speed}"),
        parameters.number(f"min_{rate}"),
        parameters.number(f"max_{rate}"),
    )
