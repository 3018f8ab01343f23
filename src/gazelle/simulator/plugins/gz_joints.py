"""The gz-sim systems that drive single joints: by force, velocity or position."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from gazelle.engine import JointHandle
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.plugins.gz_joints_table import FORCE_TABLE, POSITION_TABLE, VELOCITY_TABLE
from gazelle.simulator.plugins.parameters import PluginReader
from gazelle.simulator.plugins.table import PluginTable

__all__ = [
    "FORCE_TABLE",
    "POSITION_TABLE",
    "VELOCITY_TABLE",
    "load_force",
    "load_position",
    "load_velocity",
]


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
