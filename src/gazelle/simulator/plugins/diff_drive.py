"""``libgazebo_ros_diff_drive``: ROS 1 and ROS 2 under one implementation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose
from gazelle.simulator.messages import (
    header,
    message_class,
    pose_message,
    transform_stamped,
    twist_message,
)
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.diff_drive_table import TABLE
from gazelle.simulator.plugins.parameters import PluginReader
from gazelle.simulator.plugins.wheel_checks import check_drive, exchange_wheels
from gazelle.simulator.plugins.wheel_motion import EncoderOdometry, WheelRamp, wheel_speeds
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["load"]

# Gazebo's plug-in marks what it does not measure (z, roll, pitch) with this variance.
_UNMEASURED = 1e12
_SOURCES = {"world": "world", "1": "world", "encoder": "encoder", "0": "encoder"}


def load(context: PluginContext) -> None:
    """Start a diff drive; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(TABLE)
    pairs = zip(
        parameters.texts("leftJoint") or (parameters.text("leftJoint"),),
        parameters.texts("rightJoint") or (parameters.text("rightJoint"),),
        strict=False,
    )
    names = [(context.joint_name(left), context.joint_name(right)) for left, right in pairs]
    wheels = [(left, right) for left, right in names if left is not None and right is not None]
    if len(wheels) == len(names) and wheels:
        _Drive(context, parameters, wheels)
    parameters.report_unread()


@dataclass(frozen=True, slots=True)
class _Frames:
    odometry: str
    base: str
    prefix: str

    def prefixed(self, name: str) -> str:
        return f"{self.prefix}/{name}" if self.prefix and not name.startswith("/") else name


class _Drive:
    """One running drive."""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, wheels: list[tuple[str, str]]
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._wheels = [
            (self._engine.joint(left), self._engine.joint(right)) for left, right in wheels
        ]
        self._separation_m = parameters.number("wheelSeparation")
        self._radius_m = parameters.number("wheelDiameter") / 2
        self._torque_nm = parameters.number("wheelTorque")
        self._ramp = WheelRamp(parameters.number("wheelAcceleration"))
        self._exchanged = exchange_wheels(context, parameters, wheels[0])
        check_drive(
            context, wheels[0], self._separation_m, 2 * self._radius_m, exchanged=self._exchanged
        )
        self._odometry = EncoderOdometry(self._separation_m, self._radius_m, self._exchanged)
        self._last_angles = self._angles()
        self._command = (0.0, 0.0)
        # Motors keep their orders until the engine is compiled anew.
        self._ordered: tuple[float, float] | None = None
        self._revision = -1
        self._source = _odometry_source(context, parameters)
        self._covariance = _covariance(parameters)
        self._offer(parameters)
        self._start(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        namespace = context.namespace(parameters)
        prefix = context.tf_prefix(namespace) or (
            "" if parameters.is_ros2() else namespace.strip("/")
        )
        self._frames = _Frames(
            parameters.text("odometryFrame"), parameters.text("robotBaseFrame"), prefix.strip("/")
        )
        command_topic = context.topic(parameters, parameters.text("commandTopic"))
        # Twist and TwistStamped are both taken.
        resources.subscription(
            command_topic, None, self._take_command, announced="geometry_msgs/msg/Twist"
        )
        self._odom_publisher = None
        if parameters.flag("publishTf"):
            topic = context.topic(parameters, parameters.text("odometryTopic"))
            self._odom_publisher = resources.publisher(topic, "nav_msgs/Odometry")
        # The ROS 1 plug-in sends odom → base from the function that publishTf switches.
        self._sends_odom_tf = parameters.flag("publishOdomTF") and (
            self._odom_publisher is not None or parameters.is_ros2()
        )
        self._sends_wheel_tf = parameters.flag("publishWheelTF")
        self._tf_publisher = None
        if self._sends_odom_tf or self._sends_wheel_tf:
            self._tf_publisher = resources.publisher("/tf", "tf2_msgs/TFMessage")
        self._joint_publisher = None
        if parameters.flag("publishWheelJointState"):
            topic = join_names(namespace, parameters.ros.remapped("joint_states"))
            self._joint_publisher = resources.publisher(topic, "sensor_msgs/JointState")

    def _start(self, parameters: PluginReader) -> None:
        step_ns = self._engine.step_ns
        period = period_in_steps(parameters.number("updateRate"), step_ns)
        self._period_s = float(period * step_ns) * 1e-9
        self._drive(self._command)
        self._context.resources.task(f"{self._context.plugin.name} drive", period, self._update)
        self._context.resources.on_reset(self._reset)
        self._context.resources.on_close(self._release)

    def _take_command(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        self._command = (float(twist.linear.x), float(twist.angular.z))

    def _update(self) -> None:
        if self._source == "encoder":
            angles = self._angles()
            last, self._last_angles = self._last_angles, angles
            self._odometry.update(angles[0] - last[0], angles[1] - last[1], self._period_s)
        self._publish()
        linear, angular = self._command
        self._drive(wheel_speeds(linear, angular, self._separation_m, exchanged=self._exchanged))

    def _drive(self, target_m_s: tuple[float, float]) -> None:
        left, right = self._wheels[0]
        actual = (left.velocity * self._radius_m, right.velocity * self._radius_m)
        speeds = self._ramp.command(target_m_s, actual, self._period_s)
        revision = self._engine.revision
        if speeds == self._ordered and revision == self._revision:
            return
        self._ordered, self._revision = speeds, revision
        for pair in self._wheels:
            for joint, speed in zip(pair, speeds, strict=True):
                joint.set_velocity_target(speed / self._radius_m, self._torque_nm)

    def _publish(self) -> None:
        time_ns = self._engine.time_ns
        wants_odom = self._odom_publisher is not None and self._odom_publisher.matched
        wants_tf = self._tf_publisher is not None and self._tf_publisher.matched
        pose = self._pose() if wants_odom or wants_tf else None
        if pose is not None and wants_tf:
            self._publish_tf(time_ns, pose)
        if pose is not None and wants_odom:
            self._publish_odometry(time_ns, pose)
        if self._joint_publisher is not None and self._joint_publisher.matched:
            self._publish_joints(time_ns)

    def _pose(self) -> Pose:
        if self._source == "world":
            return self._engine.model_pose(self._context.model.name)
        return self._odometry.pose()

    def _publish_odometry(self, time_ns: int, pose: Pose) -> None:
        forward, sideways, yaw_rate = self._velocity(pose)
        frames = self._frames
        message = message_class("nav_msgs/Odometry")(
            header=header(time_ns, frames.prefixed(frames.odometry)),
            child_frame_id=frames.prefixed(frames.base),
        )
        message.pose.pose = pose_message(pose)
        message.pose.covariance = self._covariance
        message.twist.twist = twist_message((forward, sideways, 0.0), (0.0, 0.0, yaw_rate))
        assert self._odom_publisher is not None
        self._odom_publisher.publish(message)

    def _velocity(self, pose: Pose) -> tuple[float, float, float]:
        if self._source != "world":
            return self._odometry.forward_m_s, 0.0, self._odometry.yaw_rate_rad_s
        model = self._context.model
        linear, angular = self._engine.link(
            f"{model.name}::{model.canonical_link}"
        ).velocity_world()
        yaw = pose.rpy_rad[2]
        cos, sin = float(np.cos(yaw)), float(np.sin(yaw))
        vx, vy = float(linear[0]), float(linear[1])
        return cos * vx + sin * vy, cos * vy - sin * vx, float(angular[2])

    def _publish_tf(self, time_ns: int, pose: Pose) -> None:
        frames = self._frames
        transforms = []
        if self._sends_odom_tf:
            parent, child = frames.prefixed(frames.odometry), frames.prefixed(frames.base)
            transforms.append(transform_stamped(time_ns, parent, child, pose))
        if self._sends_wheel_tf:
            transforms += [
                self._wheel_tf(time_ns, joint) for pair in self._wheels for joint in pair
            ]
        assert self._tf_publisher is not None
        self._tf_publisher.publish(message_class("tf2_msgs/TFMessage")(transforms=transforms))

    def _wheel_tf(self, time_ns: int, joint: Any) -> Any:
        model = self._context.model
        described = model.joint(joint.name.removeprefix(f"{model.name}::"))
        assert described is not None
        T_world_parent = self._engine.link(f"{model.name}::{described.parent}").T_world_link()
        T_world_child = self._engine.link(f"{model.name}::{described.child}").T_world_link()
        parent = self._frames.prefixed(described.parent)
        child = self._frames.prefixed(described.child)
        return transform_stamped(time_ns, parent, child, T_world_parent.inverse() @ T_world_child)

    def _publish_joints(self, time_ns: int) -> None:
        joints = [joint for pair in self._wheels for joint in pair]
        message = message_class("sensor_msgs/JointState")(
            header=header(time_ns, ""),
            name=[joint.name.split("::", 1)[1] for joint in joints],
            position=np.array([joint.position for joint in joints]),
        )
        assert self._joint_publisher is not None
        self._joint_publisher.publish(message)

    def _angles(self) -> tuple[float, float]:
        left, right = self._wheels[0]
        return left.position, right.position

    def _reset(self) -> None:
        self._command = (0.0, 0.0)
        self._ramp.reset()
        self._odometry.reset()
        self._last_angles = self._angles()
        self._ordered = None
        self._drive((0.0, 0.0))

    def _release(self) -> None:
        for pair in self._wheels:
            for joint in pair:
                joint.release()


def _covariance(parameters: PluginReader) -> np.ndarray[Any, np.dtype[np.float64]]:
    covariance = np.zeros(36)
    covariance[[14, 21, 28]] = _UNMEASURED
    covariance[0] = parameters.number("covariance_x")
    covariance[7] = parameters.number("covariance_y")
    covariance[35] = parameters.number("covariance_yaw")
    return covariance


def _odometry_source(context: PluginContext, parameters: PluginReader) -> str:
    """Gazebo compares with the words encoder and world; ROS 2 with 0 and 1; else it is world."""
    word = parameters.text("odometrySource")
    source = _SOURCES.get(word.lower())
    if source is None:
        text = f"<odometrySource> is '{word}', not 'encoder' or 'world': 'world' is used"
        context.report("parameter.bad-value", text, fix=did_you_mean(word, _SOURCES))
    tag = parameters.tag("odometrySource")
    if word == "0" and tag is not None and tag.name == "odometrySource":
        # ROS 1 knows only the words; its reader falls back to the default.
        return "world"
    return source or "world"
