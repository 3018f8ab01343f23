"""``libgazebo_ros_skid_steer_drive``: four wheels, two a side (ROS 1)."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.diff_drive_kinematics import wheel_speeds
from gazelle.simulator.plugins.drive import (
    ALWAYS_ON,
    Velocity,
    covariances,
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
    given_covariance,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

_JOINTS = ("leftFrontJoint", "rightFrontJoint", "leftRearJoint", "rightRearJoint")

TABLE = PluginTable(
    ParameterTable(
        "skid_steer_drive",
        "Drives four wheels from velocity commands and publishes odometry (ROS 1).",
        ("gazebo_ros_skid_steer_drive",),
        (
            *topics(in_ros2=False),
            *frames("base_footprint", in_ros2=False),
            Parameter("leftFrontJoint", "text", "left_front_joint", "a wheel's joint"),
            Parameter("rightFrontJoint", "text", "right_front_joint", "a wheel's joint"),
            Parameter("leftRearJoint", "text", "left_rear_joint", "a wheel's joint"),
            Parameter("rightRearJoint", "text", "right_rear_joint", "a wheel's joint"),
            Parameter("wheelSeparation", "number", 0.4, "distance of both sides", "m"),
            Parameter("wheelDiameter", "number", 0.15, "diameter of the wheels", "m"),
            Parameter("torque", "number", 5.0, "largest motor torque", "N·m"),
            Parameter("updateRate", "number", 100.0, "update and publish rate", "Hz"),
            Parameter("broadcastTF", "flag", False, "publish odom → base"),
            *covariances(1e-4, 1e-2),
            ALWAYS_ON,
        ),
    ),
    topics=(
        Topic("{commandTopic}", "geometry_msgs/msg/Twist", kind="listens"),
        *odometry_topics("updateRate", ros2=""),
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
    names = needed_joints(context, parameters, _JOINTS)
    if names is not None:
        _SkidSteer(context, parameters, list(names.values()))
    parameters.report_unread()


class _SkidSteer:
    """One running drive."""

    def __init__(self, context: PluginContext, parameters: PluginReader, names: list[str]) -> None:
        engine = context.host.engine
        self._joints = [engine.joint(name) for name in names]
        self._separation_m = parameters.number("wheelSeparation")
        self._radius_m = parameters.number("wheelDiameter") / 2
        self._torque_nm = parameters.number("torque")
        self._command = Velocity()
        self._odometry = DriveOdometry(context, _setup(context, parameters))
        topic = context.topic(parameters, parameters.text("commandTopic"))
        take_velocities(context, topic, self._take)
        period = period_in_steps(parameters.number("updateRate"), engine.step_ns)
        self._drive()
        run_drive(context, self._joints, period, self._update, self._reset)

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _update(self) -> None:
        self._odometry.publish()
        self._drive()

    def _drive(self) -> None:
        command = self._command
        left, right = wheel_speeds(
            command.forward, command.turn, self._separation_m, exchanged=False
        )
        for joint, speed in zip(self._joints, (left, right, left, right), strict=True):
            joint.set_velocity_target(speed / self._radius_m, self._torque_nm)

    def _reset(self) -> None:
        self._command = Velocity()
        self._drive()


def _setup(context: PluginContext, parameters: PluginReader) -> OdometrySetup:
    prefix = frame_prefix(context, parameters)
    covariance = given_covariance(parameters)
    return OdometrySetup(
        context.topic(parameters, parameters.text("odometryTopic")),
        parameters.flag("broadcastTF"),
        prefix + parameters.text("odometryFrame"),
        prefix + parameters.text("robotBaseFrame"),
        covariance,
        covariance,
        is_flat=True,
    )
