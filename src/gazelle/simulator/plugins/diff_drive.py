"""``libgazebo_ros_diff_drive``: ROS 1 and ROS 2 under one implementation."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.diff_drive_geometry import check_drive, exchange_wheels
from gazelle.simulator.plugins.diff_drive_kinematics import EncoderOdometry, WheelRamp, wheel_speeds
from gazelle.simulator.plugins.drive import (
    ALWAYS_ON,
    COMMAND_TOPIC,
    DEBUG_LEVEL,
    GZ_COMMANDS,
    GZ_NO_JERK,
    GZ_ODOMETRY,
    GZ_RATE,
    GZ_SEPARATION,
    GZ_SIDES,
    GZ_TOPICS,
    GZ_WHEEL_RADIUS,
    UPDATE_RATE,
    WHEEL_TF,
    Velocity,
    covariances,
    frames,
    odometry_topics,
    run_drive,
    take_velocities,
    topics,
)
from gazelle.simulator.plugins.drive_odometry import (
    DriveOdometry,
    OdometrySetup,
    given_covariance,
    turned_back,
    wheel_transform,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["GZ_TABLE", "TABLE", "load"]


TABLE = PluginTable(
    ParameterTable(
        "diff_drive",
        "Drives two wheels from velocity commands and publishes odometry.",
        ("gazebo_ros_diff_drive",),
        (
            *topics(has_aliases=True),
            *frames("base_footprint"),
            Parameter(
                "leftJoint", "text", "left_joint", "left wheel's joint", "", aliases=("left_joint",)
            ),
            Parameter(
                "rightJoint",
                "text",
                "right_joint",
                "right wheel's joint",
                "",
                aliases=("right_joint",),
            ),
            Parameter(
                "wheelSeparation",
                "number",
                0.34,
                "distance of the wheels",
                "m",
                aliases=("wheel_separation",),
            ),
            Parameter(
                "wheelDiameter",
                "number",
                0.15,
                "diameter of the wheels",
                "m",
                aliases=("wheel_diameter",),
            ),
            Parameter(
                "wheelTorque",
                "number",
                5.0,
                "largest motor torque",
                "N·m",
                aliases=("torque", "max_wheel_torque"),
            ),
            Parameter(
                "wheelAcceleration",
                "number",
                0.0,
                "rim acceleration, 0 for unlimited",
                "m/s²",
                aliases=("max_wheel_acceleration",),
            ),
            UPDATE_RATE,
            Parameter(
                "odometrySource",
                "text",
                "world",
                "where odometry comes from",
                "",
                aliases=("odometry_source",),
            ),
            Parameter(
                "publishTf",
                "flag",
                True,
                "publish odometry at all",
                "",
                aliases=("publish_odom",),
                ros2_default=False,
            ),
            Parameter(
                "publishOdomTF",
                "flag",
                True,
                "publish odom → base",
                "",
                aliases=("publish_odom_tf",),
                ros2_default=False,
            ),
            WHEEL_TF,
            Parameter(
                "publishWheelJointState",
                "flag",
                False,
                "publish wheel joint states",
                ros_versions=(1,),
            ),
            Parameter("legacyMode", "flag", True, "exchange the wheels", ros_versions=(1,)),
            *covariances(1e-5, 1e-3, "pose covariance {}"),
            Parameter(
                "num_wheel_pairs", "number", 1.0, "pairs of wheels (ROS 2)", ros_versions=(2,)
            ),
            DEBUG_LEVEL,
            ALWAYS_ON,
            Parameter("broadcastTF", "refused", "", "no release of the plug-in reads it"),
        ),
    ),
    topics=(
        COMMAND_TOPIC,
        *odometry_topics("updateRate", tf_frame="`odometryFrame`, wheel parents"),
        Topic(
            "joint_states",
            "sensor_msgs/msg/JointState",
            rate="`updateRate`",
            frame="none",
            ros_versions=(1,),
        ),
    ),
    behaviour=(
        "Updates and publishes at `updateRate`; the wheels are ODE-like motors (`wheelTorque` is"
        " fmax), ramped by `wheelAcceleration` as the plug-in of ROS Kinetic does.",
        "`odometrySource` is `encoder` (or 0) for dead reckoning from the wheels' angles and"
        " `world` (or 1) for the true pose; any other word means `world`, as in Gazebo.",
        "`legacyMode` true exchanges the wheels (ROS Kinetic). Absent, the mode that turns the"
        " robot as REP 103 says is chosen from the geometry.",
        "The command topic takes `geometry_msgs/Twist` and `geometry_msgs/TwistStamped`.",
        "Wheel joint states carry positions only, as the ROS 1 plug-in's.",
    ),
    in_both_ros=True,
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim diff_drive",
        "The gz-sim system of the same purpose, under its own keys.",
        (
            "gz-sim-diff-drive-system",
            "ignition-gazebo-diff-drive-system",
            "gz::sim::systems::DiffDrive",
            "ignition::gazebo::systems::DiffDrive",
        ),
        (
            Parameter("topic", "text", "/model/{model}/cmd_vel", "commands"),
            *GZ_ODOMETRY,
            *GZ_SIDES,
            GZ_SEPARATION,
            GZ_WHEEL_RADIUS,
            GZ_RATE,
            Parameter(
                "min_velocity",
                "number",
                -1e12,
                "lowest speed",
                "m/s",
                aliases=("min_linear_velocity",),
            ),
            Parameter(
                "max_velocity",
                "number",
                1e12,
                "highest speed",
                "m/s",
                aliases=("max_linear_velocity",),
            ),
            Parameter(
                "min_acceleration",
                "number",
                -1e12,
                "hardest braking",
                "m/s²",
                aliases=("min_linear_acceleration",),
            ),
            Parameter(
                "max_acceleration",
                "number",
                1e12,
                "hardest acceleration",
                "m/s²",
                aliases=("max_linear_acceleration",),
            ),
            Parameter("min_angular_velocity", "number", -1e12, "lowest yaw rate", "rad/s"),
            Parameter("max_angular_velocity", "number", 1e12, "highest yaw rate", "rad/s"),
            Parameter(
                "min_angular_acceleration", "number", -1e12, "hardest turn braking", "rad/s²"
            ),
            Parameter("max_angular_acceleration", "number", 1e12, "hardest turning", "rad/s²"),
            *GZ_NO_JERK,
        ),
    ),
    topics=(
        GZ_COMMANDS,
        *GZ_TOPICS,
    ),
    behaviour=(
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
        "Odometry is dead reckoning from the wheels' angles; speeds and accelerations of the"
        " command are limited.",
    ),
)

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
        self._reckoning = EncoderOdometry(self._separation_m, self._radius_m, self._exchanged)
        self._last_angles = self._angles()
        self._command = Velocity()
        # Motors keep their orders until the engine is compiled anew.
        self._ordered: tuple[float, float] | None = None
        self._revision = -1
        self._source = _odometry_source(context, parameters)
        self._offer(parameters)
        self._start(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        namespace = context.namespace(parameters)
        prefix = context.tf_prefix(namespace) or (
            "" if parameters.is_ros2() else namespace.strip("/")
        )
        self._prefix = prefix.strip("/")
        topic = context.topic(parameters, parameters.text("commandTopic"))
        take_velocities(context, topic, self._take)
        topic = ""
        if parameters.flag("publishTf"):
            topic = context.topic(parameters, parameters.text("odometryTopic"))
        setup = OdometrySetup(
            topic,
            # The ROS 1 plug-in sends odom → base from the function that publishTf switches.
            parameters.flag("publishOdomTF") and (bool(topic) or parameters.is_ros2()),
            self._prefixed(parameters.text("odometryFrame")),
            self._prefixed(parameters.text("robotBaseFrame")),
            given_covariance(parameters),
        )
        wheels = self._wheel_transforms if parameters.flag("publishWheelTF") else None
        self._odometry = DriveOdometry(context, setup, wheels)
        self._joint_publisher = None
        if parameters.flag("publishWheelJointState"):
            topic = join_names(namespace, parameters.ros.remapped("joint_states"))
            self._joint_publisher = resources.publisher(topic, "sensor_msgs/JointState")

    def _start(self, parameters: PluginReader) -> None:
        step_ns = self._engine.step_ns
        period = period_in_steps(parameters.number("updateRate"), step_ns)
        self._period_s = float(period * step_ns) * 1e-9
        self._drive((0.0, 0.0))
        joints = (joint for pair in self._wheels for joint in pair)
        run_drive(self._context, joints, period, self._update, self._reset)

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _update(self) -> None:
        if self._source == "encoder":
            angles = self._angles()
            last, self._last_angles = self._last_angles, angles
            self._reckoning.update(angles[0] - last[0], angles[1] - last[1], self._period_s)
        self._publish()
        forward, _, turn = self._command
        self._drive(wheel_speeds(forward, turn, self._separation_m, exchanged=self._exchanged))

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
        if self._odometry.matched:
            pose = self._pose()
            self._odometry.publish(pose, self._velocity(pose))
        if self._joint_publisher is not None and self._joint_publisher.matched:
            self._publish_joints(self._engine.time_ns)

    def _pose(self) -> Pose:
        if self._source == "world":
            return self._engine.model_pose(self._context.model.name)
        return self._reckoning.pose()

    def _velocity(self, pose: Pose) -> tuple[float, float, float]:
        if self._source != "world":
            return self._reckoning.forward_m_s, 0.0, self._reckoning.yaw_rate_rad_s
        model = self._context.model
        linear, angular = self._engine.link(
            f"{model.name}::{model.canonical_link}"
        ).velocity_world()
        forward, sideways = turned_back(float(linear[0]), float(linear[1]), pose.rpy_rad[2])
        return forward, sideways, float(angular[2])

    def _wheel_transforms(self) -> list[Any]:
        return [
            wheel_transform(
                self._context,
                joint,
                self._prefixed(joint.joint.parent),
                self._prefixed(joint.joint.child),
            )
            for pair in self._wheels
            for joint in pair
        ]

    def _prefixed(self, frame: str) -> str:
        has_own = frame.startswith("/") or not self._prefix
        return frame if has_own else f"{self._prefix}/{frame}"

    def _publish_joints(self, time_ns: int) -> None:
        joints = [joint for pair in self._wheels for joint in pair]
        message = message_type("sensor_msgs/JointState")(
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
        self._command = Velocity()
        self._ramp.reset()
        self._reckoning.reset()
        self._last_angles = self._angles()
        self._ordered = None
        self._drive((0.0, 0.0))


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
