"""Joints of the engine: states into the interface values, commands from there back."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array, InterfaceValues
from gazelle.control.pid import PidArray

if TYPE_CHECKING:
    from gazelle.engine import Engine, JointGroup

__all__ = [
    "JOINT_STATES",
    "EffortWriter",
    "FeedbackLaw",
    "JointStates",
    "JointWriter",
    "effort_writer",
    "pid_law",
    "position_writer",
    "velocity_writer",
]


JOINT_STATES = ("position", "velocity", "effort")


class JointStates:
    """States of the joints of one piece of hardware; one gather a reading.

    Args:
        engine: the physics.
        interface_values: takes the values; interfaces are registered at once.
        model: name of the model in the world.
        joints: name and state interfaces of each joint.

    Attributes:
        names: of the joints.
        group: the joints in the engine.
        position, velocity, effort: of all joints (N,), as last read.
    """

    def __init__(
        self,
        engine: Engine,
        interface_values: InterfaceValues,
        model: str,
        joints: Sequence[tuple[str, Sequence[str]]],
    ) -> None:
        self.names = tuple(name for name, _ in joints)
        self.group = engine.joint_group([f"{model}::{name}" for name in self.names])
        self.position: Array = np.zeros(len(joints))
        self.velocity: Array = np.zeros(len(joints))
        self.effort: Array = np.zeros(len(joints))
        self._interface_values = interface_values
        self._blocks = [_Block(interface_values, kind, joints) for kind in JOINT_STATES]
        self._looked_up = -1
        self._wants_effort = False

    def read(self) -> None:
        """Measure. Efforts cost more: they are read once a controller has asked for one."""
        self.group.read(self.position, self.velocity)
        states = self._interface_values.states
        if self._looked_up != len(self._interface_values.looked_up):
            self._looked_up = len(self._interface_values.looked_up)
            self._wants_effort = self._blocks[2].is_among(self._interface_values.looked_up)
        self._blocks[0].write(states, self.position)
        self._blocks[1].write(states, self.velocity)
        if self._wants_effort:
            self.group.effort(self.effort)
            self._blocks[2].write(states, self.effort)


class _Block:
    """The states of one kind, side by side in the interface values."""

    def __init__(
        self,
        interface_values: InterfaceValues,
        kind: str,
        joints: Sequence[tuple[str, Sequence[str]]],
    ) -> None:
        chosen = [index for index, (_, kinds) in enumerate(joints) if kind in kinds]
        indices = [interface_values.add_state(f"{joints[index][0]}/{kind}") for index in chosen]
        first = indices[0] if indices else 0
        self._target = slice(first, first + len(indices))
        self._source = None if len(chosen) == len(joints) else np.array(chosen, dtype=np.intp)

    def write(self, states: Array, values: Array) -> None:
        states[self._target] = values if self._source is None else values[self._source]

    def is_among(self, indices: set[int]) -> bool:
        return not indices.isdisjoint(range(self._target.start, self._target.stop))


class JointWriter:
    """Sends values to a group of joints; what did not change is not sent again.

    A joint that is held keeps its lock whatever is commanded.

    Args:
        group: the joints.
        send: gives values to the engine, to be reached within a number of steps.

    Attributes:
        held: joints that stay where they are (N,).
    """

    def __init__(self, group: JointGroup, send: Callable[[Array, int], None]) -> None:
        self.group = group
        self.held = np.zeros(len(group.names), dtype=bool)
        self._send = send
        self._leaving: list[int] = []
        self._last = b""

    def write(self, values: Array, steps: int = 1) -> None:
        """Command joints (N,); NaN leaves a joint as it is.

        Args:
            values: in the unit of the interface.
            steps: until the next command; positions are reached evenly over them.
        """
        if self._leaving:
            self.release(self._leaving)
            self._leaving = []
        if self.held.any():
            values = np.where(self.held, math.nan, values)
        raw = values.tobytes()
        if raw != self._last:
            self._last = raw
            self._send(values, steps)

    def hold(self, indices: Sequence[int], positions: Array) -> None:
        """Lock joints until `free` where they are: positions (n,), rad or m, one for each place."""
        self.held[list(indices)] = True
        values = np.full(len(self.held), math.nan)
        values[list(indices)] = positions
        self.group.lock_position(values)
        self._last = b""

    def free(self, indices: Sequence[int]) -> None:
        """Let go of held joints when the next command comes."""
        self._leaving = [*self._leaving, *indices]

    def release(self, indices: Sequence[int]) -> None:
        """Let joints go at once: no lock, no motor, no effort."""
        self.held[list(indices)] = False
        self.group.release(indices)
        self._last = b""

    def forget(self) -> None:
        """Start over: the engine was reset, and nothing acts on the joints."""
        self.group.release()
        self.held[:] = False
        self._leaving = []
        self._last = b""


class FeedbackLaw(NamedTuple):
    """How efforts answer to the motion of their joints; (N,) each.

    Attributes:
        efforts: wanted, N·m or N, before they are limited.
        velocity: of the joints, rad/s or m/s, as it was when they were computed.
        stiffness: what an effort loses per motion since.
        damping: what it loses per change of velocity since.
        low: smallest effort that is allowed.
        high: largest one.
    """

    efforts: Array
    velocity: Array
    stiffness: Array
    damping: Array
    low: Array
    high: Array


class EffortWriter(JointWriter):
    """Sends efforts; those of a feedback that would shake light joints as a law.

    A joint of 10⁻⁶ kg·m² under a PID with d = 10 N·m·s/rad turns by radians within a millisecond,
    and no effort that stays for a step stops it. The engine solves the feedback of such joints
    together with their motion, so that it holds at the end of the step.
    """

    def __init__(self, group: JointGroup) -> None:
        super().__init__(group, lambda values, steps: group.set_effort(values))
        self._fed_back = np.zeros(len(group.names), dtype=bool)

    def write(self, values: Array, steps: int = 1) -> None:
        """Command efforts (N,) as they are; see `JointWriter.write`."""
        self._end_feedback(self._fed_back)
        super().write(values, steps)

    def write_law(self, values: Array, law: FeedbackLaw, period_s: float, steps: int = 1) -> None:
        """Command efforts, light joints by the law that they come from.

        Args:
            values: limited efforts (N,), N·m or N; NaN leaves a joint as it is.
            law: where they come from.
            period_s: until the next command.
            steps: the same in steps.
        """
        light = self.group.is_light(law.stiffness, law.damping, period_s)
        light &= ~self.held & np.isfinite(law.efforts)
        if self._leaving:
            light[self._leaving] = False
        self._end_feedback(self._fed_back & ~light)
        if not light.any():
            super().write(values, steps)
            return
        super().write(np.where(light, math.nan, values), steps)
        self._fed_back |= light
        self.group.set_feedback(
            np.flatnonzero(light).tolist(),
            (law.efforts + law.damping * law.velocity)[light],
            (period_s * law.stiffness + law.damping)[light],
            law.low[light],
            law.high[light],
        )

    def hold(self, indices: Sequence[int], positions: Array) -> None:
        """Lock joints until `free` where they are: positions (n,), rad or m, one for each place."""
        self._fed_back[list(indices)] = False
        super().hold(indices, positions)

    def release(self, indices: Sequence[int]) -> None:
        """Let joints go at once."""
        self._fed_back[list(indices)] = False
        super().release(indices)

    def forget(self) -> None:
        """Start over: the engine was reset."""
        self._fed_back[:] = False
        super().forget()

    def _end_feedback(self, leaving: NDArray[np.bool_]) -> None:
        if leaving.any():
            self.group.end_feedback(np.flatnonzero(leaving).tolist())
            self._fed_back &= ~leaving
            self._last = b""


def pid_law(
    pids: PidArray, efforts: Array, velocity: Array, max_effort: Array, *, is_position: bool
) -> FeedbackLaw:
    """Return the law of efforts that PIDs of positions, or else of velocities, want.

    Args:
        pids: of the joints.
        efforts: what they want (N,), N·m or N.
        velocity: of the joints (N,), rad/s or m/s.
        max_effort: of the joints (N,), N·m or N.
        is_position: the PIDs are of positions.
    """
    p, d = pids.stiffness_and_damping
    stiffness, damping = (p, d) if is_position else (np.zeros(len(p)), p)
    return FeedbackLaw(efforts, velocity, stiffness, damping, -max_effort, max_effort)


def effort_writer(engine: Engine, names: Sequence[str]) -> EffortWriter:
    """Return the writer of efforts, N·m or N; the engine clamps them at each joint's limit."""
    return EffortWriter(engine.joint_group(names))


def position_writer(engine: Engine, names: Sequence[str]) -> JointWriter:
    """Return the writer of positions, rad or m, reached whatever it takes (``SetPosition``)."""
    group = engine.joint_group(names)
    return JointWriter(group, lambda values, steps: group.lock_position(values, steps=steps))


def velocity_writer(engine: Engine, names: Sequence[str], max_effort: Array) -> JointWriter:
    """Return the writer of velocities, rad/s or m/s.

    Args:
        engine: the physics.
        names: ``model::joint`` of each.
        max_effort: largest effort of each motor (N,); infinite for Gazebo's ``SetVelocity``.
    """
    group = engine.joint_group(names)
    return JointWriter(group, lambda values, steps: group.set_velocity(values, max_effort))
