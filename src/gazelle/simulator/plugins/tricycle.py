"""``libgazebo_ros_tricycle_drive``: one steered and driven wheel in front, ROS 1 and 2."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.engine import JointHandle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.drive import (
    ALWAYS_ON,
    COMMAND_TOPIC,
    DEBUG_LEVEL,
    UPDATE_RATE,
    WHEEL_TF,
    Velocity,
    frames,
    needed_joints,
    odometry_topics,
    run_drive,
    take_velocities,
    topics,
)
from gazelle.simulator.plugins.drive_odometry import (
    DriveOdometry,
    OdometrySetup,
    frame_prefix,
    planar_covariance,
    wheel_transform,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]


TABLE = PluginTable(
    ParameterTable(
        "tricycle_drive",
        "Drives and steers one front wheel; two rear wheels measure (ROS 1 and 2).",
        ("gazebo_ros_tricycle_drive",),
        (
            *topics(),
            *frames("base_link"),
            Parameter(
                "steeringJoint",
                "text",
                "front_steering_joint",
                "steers",
                "",
                aliases=("steering_joint",),
            ),
            Parameter(
                "actuatedWheelJoint",
                "text",
                "front_wheel_joint",
                "drives",
                "",
                aliases=("actuated_wheel_joint",),
            ),
            Parameter(
                "encoderWheelLeftJoint",
                "text",
                "left_wheel_joint",
                "measures",
                "",
                aliases=("encoder_wheel_left_joint",),
            ),
            Parameter(
                "encoderWheelRightJoint",
                "text",
                "right_wheel_joint",
                "measures",
                "",
                aliases=("encoder_wheel_right_joint",),
            ),
            Parameter(
                "actuatedWheelDiameter",
                "number",
                0.15,
                "of the driven wheel",
                "m",
                aliases=("actuated_wheel_diameter",),
            ),
            Parameter(
                "encoderWheelDiameter",
                "number",
                0.15,
                "of the measuring wheels",
                "m",
                aliases=("encoder_wheel_diameter",),
            ),
            Parameter(
                "encoderWheelSeparation",
                "number",
                0.5,
                "their distance",
                "m",
                aliases=("wheel_separation",),
            ),
            Parameter(
                "wheelTorque",
                "number",
                5.0,
                "largest torque of both motors; 0.15 in ROS 2",
                "N·m",
                aliases=("max_wheel_torque",),
            ),
            Parameter(
                "wheelAcceleration",
                "number",
                0.0,
                "of the driven wheel, 0 for unlimited",
                "rad/s²",
                aliases=("max_wheel_acceleration",),
            ),
            Parameter(
                "wheelDeceleration",
                "number",
                0.0,
                "by default as the acceleration",
                "rad/s²",
                aliases=("max_wheel_deceleration",),
            ),
            Parameter(
                "wheelSpeedTolerance",
                "number",
                0.01,
                "differences that are left alone",
                "rad/s",
                aliases=("max_wheel_speed_tolerance",),
            ),
            Parameter(
                "steeringSpeed",
                "number",
                0.0,
                "rate of steering, 0 for at once",
                "rad/s",
                aliases=("max_steering_speed",),
            ),
            Parameter(
                "steeringAngleTolerance",
                "number",
                0.01,
                "where steering by rate stops",
                "rad",
                aliases=("max_steering_angle_tolerance",),
            ),
            Parameter(
                "odometrySource",
                "text",
                "world",
                "world (1) or encoder (0)",
                "",
                aliases=("odometry_source",),
            ),
            UPDATE_RATE,
            Parameter(
                "publish_odom",
                "flag",
                False,
                "publish odometry and odom → base (ROS 2)",
                ros_versions=(2,),
            ),
            WHEEL_TF,
            Parameter(
                "publishWheelJointState",
                "flag",
                False,
                "publish joint states",
                "",
                aliases=("publish_wheel_joint_state",),
            ),
            DEBUG_LEVEL,
            ALWAYS_ON,
        ),
    ),
    topics=(
        COMMAND_TOPIC,
        *odometry_topics("updateRate", tf_frame="`odometryFrame`, wheel parents"),
        Topic("joint_states", "sensor_msgs/msg/JointState", rate="`updateRate`", frame="none"),
    ),
    behaviour=(
        "`linear.x` is the speed of the driven wheel's rim, `angular.z` the steering angle, at"
        " most ±90°.",
        "Without `steeringSpeed` the steering joint is held at its angle (`SetPosition`); with it"
        " the joint turns at that rate until it is within `steeringAngleTolerance`.",
        "With `wheelAcceleration` the wheel's rate changes from the measured one by at most that"
        " much.",
        "`odometrySource` encoder counts left minus right, as both originals do.",
        "odom → base is sent with the odometry; ROS 2 sends neither unless `publish_odom`.",
    ),
    in_both_ros=True,
)

_JOINTS = ("steeringJoint", "actuatedWheelJoint", "encoderWheelLeftJoint", "encoderWheelRightJoint")

# What the ROS 2 plug-in takes where none is given; ROS 1's is the table's.
_ROS2_TORQUE_NM = 0.15

_ENCODER = frozenset({"encoder", "0"})


def load(context: PluginContext) -> None:
    """Start a drive; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(TABLE)
    names = needed_joints(context, parameters, _JOINTS)
    if names is not None:
        _Tricycle(context, parameters, list(names.values()))
    parameters.report_unread()


class _Tricycle:
    """One running drive."""

    def __init__(self, context: PluginContext, parameters: PluginReader, names: list[str]) -> None:
        self._context = context
        self._engine = context.host.engine
        self._joints = [self._engine.joint(name) for name in names]
        self._steering, self._wheel, *self._encoders = self._joints
        self._read(parameters)
        self._command = Velocity()
        self._place = (0.0, 0.0, 0.0)
        self._motion = (0.0, 0.0, 0.0)
        self._last_angles = self._angles()
        self._offer(parameters)
        self._start(parameters)

    def _read(self, parameters: PluginReader) -> None:
        number = parameters.number
        self._is_ros2 = parameters.is_ros2("publish_odom")
        self._radius_m = number("actuatedWheelDiameter") / 2
        self._encoder_radius_m = number("encoderWheelDiameter") / 2
        self._separation_m = number("encoderWheelSeparation")
        torque = _ROS2_TORQUE_NM if self._is_ros2 else None
        self._torque_nm = number("wheelTorque", torque)
        self._acceleration = number("wheelAcceleration")
        self._deceleration = number("wheelDeceleration", self._acceleration)
        self._speed_tolerance = number("wheelSpeedTolerance")
        self._steering_rate = number("steeringSpeed")
        self._angle_tolerance = number("steeringAngleTolerance")
        self._by_encoder = parameters.text("odometrySource").lower() in _ENCODER

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        self._prefix = "" if self._is_ros2 else frame_prefix(context, parameters)
        topic = context.topic(parameters, parameters.text("odometryTopic"))
        shown = parameters.flag("publish_odom") if self._is_ros2 else True
        setup = OdometrySetup(
            topic if shown else "",
            shown,
            self._prefix + parameters.text("odometryFrame"),
            self._prefix + parameters.text("robotBaseFrame"),
            planar_covariance(1e-5, 1e-5, 1e-3),
        )
        self._odometry = DriveOdometry(context, setup)
        command = context.topic(parameters, parameters.text("commandTopic"))
        take_velocities(context, command, self._take)
        self._tf = self._states = None
        if parameters.flag("publishWheelTF"):
            self._tf = resources.publisher("/tf", "tf2_msgs/TFMessage")
        if parameters.flag("publishWheelJointState"):
            name = parameters.ros.remapped("joint_states")
            topic = join_names(context.namespace(parameters), name)
            self._states = resources.publisher(topic, "sensor_msgs/JointState")

    def _start(self, parameters: PluginReader) -> None:
        step_ns = self._engine.step_ns
        period = period_in_steps(parameters.number("updateRate"), step_ns)
        self._steps = max(1, round(float(period)))
        self._period_s = max(1.0, float(period)) * step_ns * 1e-9
        self._drive()
        run_drive(self._context, self._joints, period, self._update, self._reset)

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _update(self) -> None:
        if self._by_encoder:
            self._reckon()
            self._odometry.publish(Pose.from_xy_yaw(*self._place), self._motion)
        else:
            self._odometry.publish()
        self._publish_wheels()
        self._publish_states()
        self._drive()

    def _drive(self) -> None:
        speed, _, angle = self._command
        rate = self._ramped(speed / self._radius_m, self._wheel.velocity)
        self._wheel.set_velocity_target(rate, self._torque_nm)
        angle = min(max(angle, -math.pi / 2), math.pi / 2)
        if self._steering_rate <= 0:
            self._steering.lock_position(angle, steps=self._steps)
            return
        gap = angle - self._steering.position
        turn = 0.0 if abs(gap) < self._angle_tolerance else math.copysign(self._steering_rate, gap)
        self._steering.set_velocity_target(turn, self._torque_nm)

    def _ramped(self, target: float, now: float) -> float:
        """Return the wheel's rate within its acceleration, from the rate it has."""
        if self._acceleration <= 0:
            return target
        if abs(target - now) < self._speed_tolerance:
            return now
        most = self._acceleration * self._period_s
        least = -self._deceleration * self._period_s
        return now + min(max(target - now, least), most)

    def _reckon(self) -> None:
        """Dead reckoning (Siegwart 2011, p. 337) with left minus right, as the originals have it.

        Their example robot names its wheels the other way round, so that its yaw comes out right.
        """
        angles, last = self._angles(), self._last_angles
        self._last_angles = angles
        left, right = (
            (new - old) * self._encoder_radius_m for new, old in zip(angles, last, strict=True)
        )
        x, y, yaw = self._place
        moved, turned = (left + right) / 2, (left - right) / self._separation_m
        dx = moved * math.cos(yaw + turned / 2)
        dy = moved * math.sin(yaw + turned / 2)
        self._place = (x + dx, y + dy, yaw + turned)
        self._motion = (dx / self._period_s, dy / self._period_s, turned / self._period_s)

    def _publish_wheels(self) -> None:
        if self._tf is None or not self._tf.matched:
            return
        transforms = [self._wheel_transform(joint) for joint in self._joints]
        self._tf.publish(message_type("tf2_msgs/TFMessage")(transforms=transforms))

    def _wheel_transform(self, joint: JointHandle) -> Any:
        described = joint.joint
        # ROS 1 names the frame after the joint, ROS 2 after the link.
        child = described.child if self._is_ros2 else described.name
        parent, child = self._prefix + described.parent, self._prefix + child
        return wheel_transform(self._context, joint, parent, child)

    def _publish_states(self) -> None:
        if self._states is None or not self._states.matched:
            return
        message = message_type("sensor_msgs/JointState")(
            header=header(self._engine.time_ns, ""),
            name=[joint.joint.name for joint in self._joints],
            position=np.array([joint.position for joint in self._joints]),
            velocity=np.array([joint.velocity for joint in self._joints]),
            effort=np.array([joint.effort for joint in self._joints]),
        )
        self._states.publish(message)

    def _angles(self) -> tuple[float, float]:
        left, right = self._encoders
        return left.position, right.position

    def _reset(self) -> None:
        self._command = Velocity()
        self._place = self._motion = (0.0, 0.0, 0.0)
        self._last_angles = self._angles()
        self._drive()
