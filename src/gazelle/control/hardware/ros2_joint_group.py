"""The joints of a ROS 2 robot that are commanded in the same way just now."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gazelle.control.hardware.engine_joints import (
    EffortWriter,
    FeedbackLaw,
    JointStates,
    JointWriter,
    effort_writer,
    pid_law,
    position_writer,
    velocity_writer,
)
from gazelle.control.hardware.ros2_joint_setup import Ros2Joint
from gazelle.control.interface_values import Array, Indices, InterfaceValues
from gazelle.control.pid import PidArray

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["Method", "Ros2Section"]

Method = str
"""``position``, ``velocity``, ``effort``, ``servo`` (gz-sim's position), or with ``_pid``."""


class Ros2Section:
    """Joints with one control method, made anew whenever controllers are switched.

    What holds a joint goes on until its first command comes.

    Args:
        engine: the physics.
        interface_values: has the commands.
        model: name of the model in the world.
        joints: all joints of the hardware, in the order of its states.
        indices: those of this section.
        method: how they are commanded.
        servo_gain_1_s: of ``servo``: speed over position error, 1/s.
        max_effort: of ``velocity`` and ``servo`` motors (N,); infinite for ``SetVelocity``.
    """

    def __init__(
        self,
        engine: Engine,
        interface_values: InterfaceValues,
        model: str,
        joints: Sequence[Ros2Joint],
        indices: Sequence[int],
        method: Method,
        *,
        servo_gain_1_s: float,
        max_effort: Array,
    ) -> None:
        mine = [joints[index] for index in indices]
        self.method = method
        self.names = tuple(joint.name for joint in mine)
        interface = {"servo": "position"}.get(method, method.removesuffix("_pid"))
        self._interface_values = interface_values
        self._commands = interface_values.command_indices(
            [f"{name}/{interface}" for name in self.names]
        )
        self._indices: Indices = np.array(indices, dtype=np.intp)
        self._lower = np.array([joint.commands[interface].lower for joint in mine])
        self._upper = np.array([joint.commands[interface].upper for joint in mine])
        self._is_bounded = bool(np.isfinite(self._lower).any() or np.isfinite(self._upper).any())
        self._servo_gain_1_s = servo_gain_1_s
        self.pids = None
        if method.endswith("_pid"):
            self.pids = PidArray([joint.gains[interface] for joint in mine])
        names = [f"{model}::{name}" for name in self.names]
        self._writer = _WRITERS.get(method, _effort)(engine, names, max_effort)
        # An effort would do nothing to a joint that is still locked.
        self._waiting = np.ones(len(mine), dtype=bool)
        self._unlimited, self._given = np.full(len(mine), math.inf), b""
        self._must_release = method == "effort" or self.pids is not None

    def write(self, states: JointStates, step_s: float, steps: int, *, is_new: bool) -> None:
        """Act on the commands; NaN leaves a joint as it is.

        Args:
            states: as last read.
            step_s: length of a physics step.
            steps: until the next command.
            is_new: False when this step was written before: PIDs do not run again.
        """
        commands = self._interface_values.commands[self._commands]
        if self._is_bounded:
            commands = np.minimum(np.maximum(commands, self._lower), self._upper)
        if self._must_release and self._waiting.any():
            self._let_go(~np.isnan(commands))
        if self.method == "servo":
            error = commands - states.position[self._indices]
            self._writer.write(self._servo_gain_1_s * error, steps)
        elif self.pids is None and isinstance(self._writer, EffortWriter):
            self._write_efforts(self._writer, commands, states, step_s, steps)
        elif self.pids is None:
            self._writer.write(commands, steps)
        elif is_new:
            self._run_pids(self.pids, commands, states, step_s)

    def _write_efforts(
        self, writer: EffortWriter, commands: Array, states: JointStates, step_s: float, steps: int
    ) -> None:
        stiffness = self._interface_values.stiffness[self._commands]
        damping = self._interface_values.damping[self._commands]
        if not (stiffness.any() or damping.any()):
            writer.write(commands, steps)
            return
        raw = commands.tobytes()
        if raw == self._given:
            return
        self._given = raw
        velocity = states.velocity[self._indices]
        law = FeedbackLaw(commands, velocity, stiffness, damping, -self._unlimited, self._unlimited)
        writer.write_law(commands, law, step_s * steps, steps)

    def forget(self) -> None:
        """Send everything again: the engine was reset."""
        self._writer.forget()
        self._given = b""
        self._waiting[:] = True
        if self.pids is not None:
            self.pids.reset()

    def _let_go(self, commanded: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> None:
        leaving = np.flatnonzero(self._waiting & commanded)
        if len(leaving):
            self._writer.release(leaving.tolist())
            self._waiting[leaving] = False

    def _run_pids(
        self, pids: PidArray, commands: Array, states: JointStates, step_s: float
    ) -> None:
        is_position = self.method == "position_pid"
        measured = (states.position if is_position else states.velocity)[self._indices]
        errors = commands - measured
        idle = np.isnan(errors)
        efforts = pids.compute(np.where(idle, 0.0, errors), step_s)
        values = np.where(idle, math.nan, efforts)
        if isinstance(self._writer, EffortWriter):
            velocity = states.velocity[self._indices]
            law = pid_law(pids, efforts, velocity, self._unlimited, is_position=is_position)
            self._writer.write_law(values, law, step_s)


def _position(engine: Engine, names: Sequence[str], max_effort: Array) -> JointWriter:
    return position_writer(engine, names)


def _effort(engine: Engine, names: Sequence[str], max_effort: Array) -> JointWriter:
    return effort_writer(engine, names)


_WRITERS: dict[Method, Callable[[Engine, Sequence[str], Array], JointWriter]] = {
    "position": _position,
    "velocity": velocity_writer,
    "servo": velocity_writer,
}
