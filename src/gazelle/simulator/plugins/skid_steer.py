"""``libgazebo_ros_skid_steer_drive``: four wheels, two a side (ROS 1)."""

from __future__ import annotations

from typing import Any

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.body_odometry import (
    BodyOdometry,
    OdometrySetup,
    frame_prefix,
    planar_covariance,
)
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.parameters import PluginReader
from gazelle.simulator.plugins.table import PluginTable
from gazelle.simulator.plugins.wheel_motion import wheel_speeds
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

_JOINTS = ("leftFrontJoint", "rightFrontJoint", "leftRearJoint", "rightRearJoint")

TABLE = PluginTable(
    ParameterTable(
        "skid_steer_drive",
        "Drives four wheels from velocity commands and publishes odometry (ROS 1).",
        ("gazebo_ros_skid_steer_drive",),
        (
            Parameter("robotNamespace", "text", "", "namespace of all topics"),
            Parameter("commandTopic", "text", "cmd_vel", "commands"),
            Parameter("odometryTopic", "text", "odom", "odometry"),
            Parameter("odometryFrame", "text", "odom", "its frame"),
            Parameter("robotBaseFrame", "text", "base_footprint", "child frame"),
            Parameter("leftFrontJoint", "text", "left_front_joint", "a wheel's joint"),
            Parameter("rightFrontJoint", "text", "right_front_joint", "a wheel's joint"),
            Parameter("leftRearJoint", "text", "left_rear_joint", "a wheel's joint"),
            Parameter("rightRearJoint", "text", "right_rear_joint", "a wheel's joint"),
            Parameter("wheelSeparation", "number", 0.4, "distance of both sides", "m"),
            Parameter("wheelDiameter", "number", 0.15, "diameter of the wheels", "m"),
            Parameter("torque", "number", 5.0, "largest motor torque", "N·m"),
            Parameter("updateRate", "number", 100.0, "update and publish rate", "Hz"),
            Parameter("broadcastTF", "flag", False, "publish odom → base"),
            Parameter("covariance_x", "number", 1e-4, "covariance x", "m²"),
            Parameter("covariance_y", "number", 1e-4, "covariance y", "m²"),
            Parameter("covariance_yaw", "number", 1e-2, "covariance yaw", "rad²"),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic("{commandTopic}", "geometry_msgs/msg/Twist", kind="listens"),
        Topic(
            "{odometryTopic}", "nav_msgs/msg/Odometry", rate="`updateRate`", frame="`odometryFrame`"
        ),
        Topic("/tf", "tf2_msgs/msg/TFMessage", rate="`updateRate`", frame="`odometryFrame`"),
    ),
    behaviour=(
        "Both wheels of a side turn at v ∓ ω · `wheelSeparation`/2 over the wheel's radius, each"
        " with at most `torque` (ODE's fmax).",
        "Odometry is the true pose and velocity; the message has no height.",
        "Pose and twist have the same covariance.",
    ),
)


def load(context: PluginContext) -> None:
    """Start a drive; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(TABLE)
    found = [context.joint_name(parameters.text(key)) for key in _JOINTS]
    names = [name for name in found if name is not None]
    if len(names) == len(_JOINTS):
        _SkidSteer(context, parameters, names)
    parameters.report_unread()


class _SkidSteer:
    """One running drive."""

    def __init__(self, context: PluginContext, parameters: PluginReader, names: list[str]) -> None:
        engine, resources = context.host.engine, context.resources
        self._joints = [engine.joint(name) for name in names]
        self._separation_m = parameters.number("wheelSeparation")
        self._radius_m = parameters.number("wheelDiameter") / 2
        self._torque_nm = parameters.number("torque")
        self._command = (0.0, 0.0)
        self._odometry = BodyOdometry(context, _setup(context, parameters))
        topic = context.topic(parameters, parameters.text("commandTopic"))
        # Twist and TwistStamped are both taken.
        resources.subscription(topic, None, self._take, announced="geometry_msgs/msg/Twist")
        period = period_in_steps(parameters.number("updateRate"), engine.step_ns)
        self._drive()
        resources.task(f"{context.plugin.name} drive", period, self._update)
        resources.on_reset(self._reset)
        resources.on_close(self._release)

    def _take(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        self._command = (float(twist.linear.x), float(twist.angular.z))

    def _update(self) -> None:
        self._odometry.publish()
        self._drive()

    def _drive(self) -> None:
        left, right = wheel_speeds(*self._command, self._separation_m, exchanged=False)
        for joint, speed in zip(self._joints, (left, right, left, right), strict=True):
            joint.set_velocity_target(speed / self._radius_m, self._torque_nm)

    def _reset(self) -> None:
        self._command = (0.0, 0.0)
        self._drive()

    def _release(self) -> None:
        for joint in self._joints:
            joint.release()


def _setup(context: PluginContext, parameters: PluginReader) -> OdometrySetup:
    prefix = frame_prefix(context, parameters)
    covariance = planar_covariance(
        *(parameters.number(f"covariance_{axis}") for axis in ("x", "y", "yaw"))
    )
    return OdometrySetup(
        context.topic(parameters, parameters.text("odometryTopic")),
        parameters.flag("broadcastTF"),
        prefix + parameters.text("odometryFrame"),
        prefix + parameters.text("robotBaseFrame"),
        covariance,
        covariance,
        is_flat=True,
    )
