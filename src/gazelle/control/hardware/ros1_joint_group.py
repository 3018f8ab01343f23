"""The joints of a ROS 1 robot that are commanded in the same way."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gazelle.control.angles import (
    shortest_angular_distance,
    shortest_angular_distance_with_limits,
)
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
from gazelle.control.hardware.ros1_joint_setup import Ros1Joint
from gazelle.control.interface_values import Array, InterfaceValues
from gazelle.control.joint_limits import EffortLimits, PositionLimits, VelocityLimits
from gazelle.control.pid import PidArray
from gazelle.control.resource_manager import JointLimits
from gazelle.description.model import JointType

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["Ros1Section"]


class Ros1Section:
    """Joints of one interface, all with PIDs or all without.

    Args:
        engine: the physics.
        interface_values: takes the command interfaces.
        model: name of the model in the world.
        joints: all joints of the hardware, in the order of its states.
        indices: those of this section, which have the same interface.
        pids: turn position or velocity errors into efforts; None to command directly.

    Attributes:
        names: of its joints.
        pids: as given.
    """

    def __init__(
        self,
        engine: Engine,
        interface_values: InterfaceValues,
        model: str,
        joints: Sequence[Ros1Joint],
        indices: Sequence[int],
        pids: PidArray | None,
    ) -> None:
        mine = [joints[index] for index in indices]
        self.names = tuple(joint.name for joint in mine)
        self.pids = pids
        self._interface_values = interface_values
        self._interface = mine[0].interface
        self._indices = np.array(indices, dtype=np.intp)
        taken = [
            interface_values.add_command(f"{name}/{self._interface}", 0.0) for name in self.names
        ]
        self._commands = slice(taken[0], taken[-1] + 1)
        limits = [joint.limits for joint in mine]
        self._limits = _limits(self._interface, limits)
        self._max_effort = np.array(
            [math.inf if item.max_effort is None else item.max_effort for item in limits]
        )
        self._mine = mine
        self._stand: Array | None = None
        self._stopped = False
        # A position that is allowed once is allowed again: the joints' state does not matter.
        is_soft = any(item.has_soft_limits for item in limits)
        self._can_settle = self._interface == "position" and pids is None and not is_soft
        self._settled = self._enforced = b""
        self.writer = self._writer(engine, [f"{model}::{name}" for name in self.names])

    def write(self, states: JointStates, step_s: float, steps: int, *, is_new: bool) -> None:
        """Enforce the limits on the commands and act on them.

        Args:
            states: as last read.
            step_s: length of a physics step.
            steps: until the next command.
            is_new: False when this step was written before: PIDs do not run again.
        """
        commands = self._interface_values.commands[self._commands]
        if self._stand is not None:
            commands[:] = self._stand
        before = commands.tobytes()
        if before == self._settled:
            return
        wanted = commands.copy()
        position, velocity = states.position[self._indices], states.velocity[self._indices]
        commands[:] = self._limits.enforce(commands, position, velocity, step_s)
        settles = self._can_settle and commands.tobytes() == before
        self._settled = before if settles else b""
        if self.pids is not None:
            if is_new:
                self._run_pids(self.pids, commands, position, velocity, step_s)
        elif self._stopped and self._interface != "position":
            self.writer.write(np.zeros(len(commands)), steps)
        elif isinstance(self._limits, EffortLimits) and isinstance(self.writer, EffortWriter):
            bounds = self._limits.bounds(position, velocity)
            self._write_efforts(self.writer, wanted, commands, velocity, bounds, step_s, steps)
        else:
            self.writer.write(commands, steps)

    def _write_efforts(
        self,
        writer: EffortWriter,
        wanted: Array,
        commands: Array,
        velocity: Array,
        bounds: tuple[Array, Array],
        step_s: float,
        steps: int,
    ) -> None:
        stiffness = self._interface_values.stiffness[self._commands]
        damping = self._interface_values.damping[self._commands]
        if not (stiffness.any() or damping.any()):
            writer.write(commands, steps)
        elif wanted.tobytes() != self._enforced:
            # What was enforced before is no new command of a controller.
            law = FeedbackLaw(wanted, velocity, stiffness, damping, *bounds)
            writer.write_law(commands, law, step_s * steps, steps)
        self._enforced = commands.tobytes()

    def hold(self, names: Collection[str], position: Array) -> None:
        """Keep joints where they are, of all positions (N,) of the hardware, until `free`."""
        indices = [index for index, name in enumerate(self.names) if name in names]
        self._settled = b""
        if indices:
            self.writer.hold(indices, position[self._indices[indices]])

    def free(self, names: Collection[str]) -> None:
        """Let go of those of the joints that are held."""
        held = self.writer.held
        indices = [index for index, name in enumerate(self.names) if name in names and held[index]]
        self._settled = b""
        if indices:
            self.writer.free(indices)
            self._limits.reset()

    def stop(self, active: bool, position: Array) -> None:
        """Begin or end an emergency stop; positions (N,) are those of the hardware."""
        if active and not self._stopped and self._interface == "position":
            self._stand = position[self._indices]
        if not active:
            self._stand = None
        self._stopped = active

    def reset(self) -> None:
        """Start over: the engine has forgotten every command."""
        self._stand, self._stopped = None, False
        self._settled = b""
        self._interface_values.commands[self._commands] = 0.0
        self.writer.forget()
        self._limits.reset()
        if self.pids is not None:
            self.pids.reset()

    def _writer(self, engine: Engine, names: Sequence[str]) -> JointWriter:
        if self.pids is not None or self._interface == "effort":
            return effort_writer(engine, names)
        if self._interface == "position":
            return position_writer(engine, names)
        return velocity_writer(engine, names, self._max_effort)

    def _run_pids(
        self, pids: PidArray, commands: Array, position: Array, velocity: Array, step_s: float
    ) -> None:
        if self._interface == "position":
            errors = self._position_errors(commands, position)
        else:
            errors = (0.0 if self._stopped else commands) - velocity
        idle = np.isnan(errors) | self.writer.held
        efforts = pids.compute(np.where(idle, 0.0, errors), step_s, None)
        limited = np.minimum(np.maximum(efforts, -self._max_effort), self._max_effort)
        values = np.where(idle, math.nan, limited)
        is_position = self._interface == "position"
        if isinstance(self.writer, EffortWriter):
            law = pid_law(pids, efforts, velocity, self._max_effort, is_position=is_position)
            self.writer.write_law(values, law, step_s)

    def _position_errors(self, commands: Array, position: Array) -> Array:
        errors = commands - position
        for index, joint in enumerate(self._mine):
            start, end = float(position[index]), float(commands[index])
            if math.isnan(end):
                continue
            if joint.type is JointType.CONTINUOUS:
                errors[index] = shortest_angular_distance(start, end)
            elif joint.type is JointType.REVOLUTE and joint.limits.has_position_limits:
                errors[index] = shortest_angular_distance_with_limits(
                    start, end, joint.limits.lower, joint.limits.upper
                )
        return errors


def _limits(
    interface: str, limits: Sequence[JointLimits]
) -> EffortLimits | PositionLimits | VelocityLimits:
    if interface == "effort":
        return EffortLimits(limits)
    return PositionLimits(limits) if interface == "position" else VelocityLimits(limits)
