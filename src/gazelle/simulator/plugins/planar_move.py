"""``libgazebo_ros_planar_move``: a robot that slides over the floor as it is told, ROS 1 and 2."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from gazelle.geometry import Pose
from gazelle.parameters import Parameter, ParameterTable
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.drive import (
    COMMAND_TOPIC,
    Velocity,
    covariances,
    frames,
    odometry_topics,
    take_velocities,
    topics,
)
from gazelle.simulator.plugins.drive_odometry import (
    DriveOdometry,
    OdometrySetup,
    frame_prefix,
    given_covariance,
    turned_back,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

_EVERY_STEP = Fraction(1)

TABLE = PluginTable(
    ParameterTable(
        "planar_move",
        "Gives a robot the commanded velocity in the plane, without wheels (omnidirectional).",
        ("gazebo_ros_planar_move",),
        (
            *topics(),
            *frames("base_footprint"),
            Parameter(
                "odometryRate",
                "number",
                20.0,
                "publish rate, 0 for never",
                "Hz",
                aliases=("publish_rate",),
            ),
            Parameter(
                "update_rate",
                "number",
                20.0,
                "how often the velocity is set (ROS 2)",
                "Hz",
                ros_versions=(2,),
            ),
            Parameter(
                "cmdTimeout",
                "number",
                -1.0,
                "age at which a command ends (ROS 1)",
                "s",
                ros_versions=(1,),
            ),
            Parameter("publish_odom", "flag", True, "publish odometry (ROS 2)", ros_versions=(2,)),
            Parameter(
                "publish_odom_tf", "flag", True, "publish odom → base (ROS 2)", ros_versions=(2,)
            ),
            *covariances(1e-5, 1e-3, "covariance {} (ROS 2)", (2,)),
        ),
    ),
    topics=(
        COMMAND_TOPIC,
        *odometry_topics("odometryRate"),
    ),
    behaviour=(
        "ROS 1 sets the velocity at every step, ROS 2 at `update_rate`; in between friction and"
        " gravity act, so what stands on the floor should have little friction. The vertical speed"
        " is set to 0.",
        "Without a command the robot is kept still; it floats where it is.",
        "The velocity is that of the model's frame; the joints keep their own speeds.",
        "ROS 1 measures the twist as the difference of two poses over the time between them.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start moving the model."""
    parameters = context.reader(TABLE)
    _PlanarMove(context, parameters)
    parameters.report_unread()


class _PlanarMove:
    """One running plug-in."""

    def __init__(self, context: PluginContext, parameters: PluginReader) -> None:
        self._context = context
        self._engine = context.host.engine
        self._is_ros2 = parameters.is_ros2("update_rate")
        self._command = Velocity()
        self._stamp_ns = 0
        timeout = parameters.number("cmdTimeout")
        self._timeout_ns = math.inf if timeout < 0 else timeout * 1e9
        self._odometry = DriveOdometry(context, _setup(context, parameters, ros2=self._is_ros2))
        self._last: tuple[int, Pose] = (self._engine.time_ns, self._pose())
        topic = context.topic(parameters, parameters.text("commandTopic"))
        take_velocities(context, topic, self._take)
        self._start(parameters)

    def _start(self, parameters: PluginReader) -> None:
        resources, step_ns = self._context.resources, self._engine.step_ns
        name = self._context.plugin.name
        period = _EVERY_STEP
        if self._is_ros2:
            period = period_in_steps(parameters.number("update_rate"), step_ns)
        resources.task(f"{name} move", period, self._move)
        rate = parameters.number("odometryRate")
        if rate > 0:
            resources.task(f"{name} odometry", period_in_steps(rate, step_ns), self._publish)
        resources.on_reset(self._reset)

    def _take(self, command: Velocity) -> None:
        self._command = command
        self._stamp_ns = self._engine.time_ns

    def _move(self) -> None:
        if self._engine.time_ns - self._stamp_ns > self._timeout_ns:
            self._command = Velocity()
        forward, sideways, turn = self._command
        if not any(self._command) and self._is_asleep():
            return
        yaw = self._pose().rpy_rad[2]
        cos, sin = math.cos(yaw), math.sin(yaw)
        linear = (forward * cos - sideways * sin, sideways * cos + forward * sin, 0.0)
        self._engine.set_model_velocity(self._context.model.name, linear, (0.0, 0.0, turn))

    def _publish(self) -> None:
        pose, time_ns = self._pose(), self._engine.time_ns
        (last_ns, last), self._last = self._last, (time_ns, pose)
        if self._is_ros2 or time_ns == last_ns:
            self._odometry.publish(pose)
            return
        period_s = (time_ns - last_ns) * 1e-9
        gap = np.subtract(pose.position_m, last.position_m)[:2] / period_s
        yaw = pose.rpy_rad[2]
        turn = math.remainder(yaw - last.rpy_rad[2], 2 * math.pi) / period_s
        self._odometry.publish(pose, (*turned_back(gap[0], gap[1], yaw), turn))

    def _pose(self) -> Pose:
        return self._engine.model_pose(self._context.model.name)

    def _is_asleep(self) -> bool:
        model = self._context.model
        link = model.canonical_link or model.links[0].name
        return self._engine.is_asleep(self._engine.body_id(f"{model.name}::{link}"))

    def _reset(self) -> None:
        self._command = Velocity()
        self._last = (self._engine.time_ns, self._pose())


def _setup(context: PluginContext, parameters: PluginReader, *, ros2: bool) -> OdometrySetup:
    prefix = "" if ros2 else frame_prefix(context, parameters)
    covariance = given_covariance(parameters)
    topic = context.topic(parameters, parameters.text("odometryTopic"))
    return OdometrySetup(
        topic if parameters.flag("publish_odom") else "",
        parameters.flag("publish_odom_tf"),
        prefix + parameters.text("odometryFrame"),
        prefix + parameters.text("robotBaseFrame"),
        covariance,
        covariance if ros2 else np.zeros(36),
        is_flat=not ros2,
    )
