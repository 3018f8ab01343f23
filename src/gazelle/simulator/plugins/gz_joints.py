"""The gz-sim systems that drive single joints: by force, velocity or position."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from gazelle.engine import JointHandle
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

__all__ = [
    "FORCE_TABLE",
    "POSITION_TABLE",
    "TRAJECTORY_TABLE",
    "VELOCITY_TABLE",
    "load_force",
    "load_position",
    "load_velocity",
]


_SAME_TOPICS = (
    "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to."
)

_ACTUATORS = (
    Parameter("use_actuator_msg", "refused", "", "there is no actuators message in ROS"),
    Parameter("actuator_number", "refused", "", "there is no actuators message in ROS"),
)

_TOPICS = (
    Parameter("topic", "text", "", "commands, by default below the joint"),
    Parameter("sub_topic", "text", "", "the same, below /model/M"),
)


def _names(word: str, system: str) -> tuple[str, ...]:
    return (
        f"gz-sim-{word}-system",
        f"ignition-gazebo-{word}-system",
        f"gz::sim::systems::{system}",
        f"ignition::gazebo::systems::{system}",
    )


def _gains(p: float, i: float, d: float) -> tuple[Parameter, ...]:
    return (
        Parameter("p_gain", "number", p, "proportional"),
        Parameter("i_gain", "number", i, "integral"),
        Parameter("d_gain", "number", d, "derivative"),
        Parameter("i_max", "number", 1.0, "upper bound of the integral's term", "N·m, N"),
        Parameter("i_min", "number", -1.0, "lower bound of the integral's term", "N·m, N"),
        Parameter("cmd_max", "number", 1000.0, "upper bound of the command", "N·m, N"),
        Parameter("cmd_min", "number", -1000.0, "lower bound of the command", "N·m, N"),
        Parameter("cmd_offset", "number", 0.0, "added to the command", "N·m, N"),
    )


FORCE_TABLE = PluginTable(
    ParameterTable(
        "gz-sim apply joint force",
        "Applies the last effort of a topic to a joint.",
        _names("apply-joint-force", "ApplyJointForce"),
        (Parameter("joint_name", "text", "", "the joint"),),
    ),
    topics=(Topic("/model/M/joint/J/cmd_force", "std_msgs/msg/Float64", kind="listens"),),
    behaviour=(_SAME_TOPICS,),
)

VELOCITY_TABLE = PluginTable(
    ParameterTable(
        "gz-sim joint controller",
        "Drives joints at the velocity of a topic, outright or by a PID.",
        _names("joint-controller", "JointController"),
        (
            Parameter("joint_name", "text", "", "a joint, repeatable"),
            Parameter("initial_velocity", "number", 0.0, "at the start", "rad/s, m/s"),
            Parameter("use_force_commands", "flag", False, "use the PID"),
            Parameter("disable_braking", "flag", False, "the PID never slows the joint down"),
            *_gains(1.0, 0.0, 0.0),
            *_TOPICS,
            *_ACTUATORS,
        ),
    ),
    topics=(Topic("/model/M/joint/J/cmd_vel", "std_msgs/msg/Float64", kind="listens"),),
    behaviour=(
        "Without `use_force_commands` the velocity is reached within a step, with as much effort"
        " as the joint's limit allows.",
        "The PID is Gazebo's own (`gz::math::PID`) and runs at every step.",
        _SAME_TOPICS,
    ),
)

POSITION_TABLE = PluginTable(
    ParameterTable(
        "gz-sim joint position controller",
        "Drives joints to the position of a topic by a PID, or by velocity.",
        _names("joint-position-controller", "JointPositionController"),
        (
            Parameter("joint_name", "text", "", "a joint, repeatable"),
            Parameter("joint_index", "number", 0.0, "part of the topic's name; axis 0 is driven"),
            Parameter("initial_position", "number", 0.0, "at the start", "rad, m"),
            Parameter("use_velocity_commands", "flag", False, "go there by velocity"),
            *_gains(1.0, 0.1, 0.01),
            *_TOPICS,
            *_ACTUATORS,
        ),
    ),
    topics=(
        Topic("/model/M/joint/J/{joint_index}/cmd_pos", "std_msgs/msg/Float64", kind="listens"),
    ),
    behaviour=(
        "With `use_velocity_commands` the joint goes to the position within a step, at most at"
        " `cmd_max` where it is given.",
        "The PID is Gazebo's own (`gz::math::PID`) and runs at every step.",
        _SAME_TOPICS,
    ),
)


def _gains_of(kind: str) -> tuple[Parameter, ...]:
    rows = (
        ("p_gain", 0.0, "proportional"),
        ("i_gain", 0.0, "integral"),
        ("d_gain", 0.0, "derivative"),
        ("i_max", -1.0, "upper bound of the integral's term"),
        ("i_min", 0.0, "lower bound of the integral's term"),
        ("cmd_max", -1.0, "upper bound of the command"),
        ("cmd_min", 0.0, "lower bound of the command"),
        ("cmd_offset", 0.0, "added to the command"),
    )
    return tuple(
        Parameter(f"{kind}_{key}", "number", default, f"{text}, of the {kind}'s PID; one a joint")
        for key, default, text in rows
    )


TRAJECTORY_TABLE = PluginTable(
    ParameterTable(
        "gz-sim joint trajectory controller",
        "Takes joints to the points of a trajectory by PIDs of position and velocity.",
        _names("joint-trajectory-controller", "JointTrajectoryController"),
        (
            Parameter("topic", "text", "", "trajectories, by default /model/M/joint_trajectory"),
            Parameter(
                "joint_name", "text", "", "a joint, repeatable; by default all with one axis"
            ),
            Parameter("initial_position", "number", 0.0, "at the start; one a joint", "rad, m"),
            Parameter(
                "use_header_start_time", "flag", False, "time counts from the message's stamp"
            ),
            *_gains_of("position"),
            *_gains_of("velocity"),
        ),
    ),
    topics=(
        Topic("{topic}", "trajectory_msgs/msg/JointTrajectory", kind="listens"),
        Topic("{topic}_progress", "std_msgs/msg/Float32", rate="each point that is aimed at"),
    ),
    behaviour=(
        "A point is aimed at, without interpolation, from the `time_from_start` of the one before"
        " it on; what it does not give (positions, velocities, effort) stays as it was."
        " Accelerations have no effect.",
        "A joint gets the sum of both PIDs and of the point's effort. The first element of a key"
        " is the first joint's, and so on; a pair of bounds whose lower one is above the upper"
        " one bounds nothing.",
        _SAME_TOPICS,
    ),
)


def load_force(context: PluginContext) -> None:
    """Start ``ApplyJointForce``."""
    _load(context, FORCE_TABLE, _Force)


def load_velocity(context: PluginContext) -> None:
    """Start ``JointController``."""
    _load(context, VELOCITY_TABLE, _Velocity)


def load_position(context: PluginContext) -> None:
    """Start ``JointPositionController``."""
    _load(context, POSITION_TABLE, _Position)


class _JointSystem:
    """Joints that one topic commands."""

    topic = ""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, joints: list[JointHandle]
    ) -> None:
        self._step_s = context.host.engine.step_ns * 1e-9
        self._joints = joints
        self._initial = self._read(parameters)
        self._command = self._initial
        resources = context.resources
        topic = _topic(context, parameters, self.topic, joints[0])
        resources.subscription(topic, "std_msgs/Float64", self._take)
        resources.task(f"{context.plugin.name} {topic}", Fraction(1), self._update)
        resources.on_reset(self._reset)
        resources.on_close(self._release)

    def _read(self, parameters: PluginReader) -> float:
        """Read the keys and return the command at the start."""
        return 0.0

    def _update(self) -> None:
        for joint in self._joints:
            joint.set_effort(self._command)

    def _take(self, message: Any) -> None:
        self._command = float(message.data)

    def _reset(self) -> None:
        self._command = self._initial

    def _release(self) -> None:
        for joint in self._joints:
            joint.release()


class _Force(_JointSystem):
    topic = "cmd_force"


class _Velocity(_JointSystem):
    topic = "cmd_vel"

    def _read(self, parameters: PluginReader) -> float:
        self._by_force = parameters.flag("use_force_commands")
        self._coasts = parameters.flag("disable_braking")
        self._pids = [_pid(parameters) for _ in self._joints]
        return parameters.number("initial_velocity")

    def _update(self) -> None:
        for joint, pid in zip(self._joints, self._pids, strict=True):
            if not self._by_force:
                joint.set_velocity_target(self._command, math.inf)
                continue
            error = joint.velocity - self._command
            drives = self._command != 0 and math.copysign(1.0, self._command) * error <= 0
            acts = drives or not self._coasts
            effort = pid.update(error, self._step_s) if acts else 0.0
            joint.set_feedback(effort, 0.0, pid.p if acts else 0.0)

    def _reset(self) -> None:
        super()._reset()
        for pid in self._pids:
            pid.reset()


class _Position(_JointSystem):
    def _read(self, parameters: PluginReader) -> float:
        self.topic = f"{int(parameters.number('joint_index'))}/cmd_pos"
        self._by_velocity = parameters.flag("use_velocity_commands")
        self._fastest = parameters.number("cmd_max") if parameters.has("cmd_max") else math.inf
        self._pids = [_pid(parameters) for _ in self._joints]
        return parameters.number("initial_position")

    def _update(self) -> None:
        for joint, pid in zip(self._joints, self._pids, strict=True):
            error = joint.position - self._command
            if self._by_velocity:
                rate = min(max(-error / self._step_s, -self._fastest), self._fastest)
                joint.set_velocity_target(rate, math.inf)
            else:
                joint.set_feedback(pid.update(error, self._step_s), pid.p, pid.d)

    def _reset(self) -> None:
        super()._reset()
        for pid in self._pids:
            pid.reset()


def _load(context: PluginContext, table: PluginTable, system: type[_JointSystem]) -> None:
    parameters = context.reader(table)
    wanted = parameters.texts("joint_name")
    if not wanted:
        text = f"plug-in '{context.plugin.name}' names no <joint_name>; it is left out"
        context.report("plugin.missing-joint", text)
    joints = _joints(context, wanted)
    if joints:
        system(context, parameters, joints)
    parameters.report_unread()


def _joints(context: PluginContext, wanted: Sequence[str]) -> list[JointHandle]:
    """Return the joints that are there; the first one decides about the command."""
    found = [context.joint_name(name) for name in wanted]
    handles = [context.host.engine.joint(name) for name in found if name is not None]
    return [handle for handle in handles if handle.is_driveable]


def _topic(
    context: PluginContext, parameters: PluginReader, default: str, joint: JointHandle
) -> str:
    model = f"/model/{context.model.name}"
    for key, prefix in (("topic", "/"), ("sub_topic", model)):
        if parameters.knows(key) and parameters.text(key):
            return join_names(prefix, parameters.text(key))
    return join_names(model, "joint", joint.joint.name, default)


def _pid(parameters: PluginReader) -> GazeboPid:
    keys = ("p_gain", "i_gain", "d_gain", "i_max", "i_min", "cmd_max", "cmd_min", "cmd_offset")
    return GazeboPid(*(parameters.number(key) for key in keys))
