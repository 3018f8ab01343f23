"""Commands of joints with one interface, from the bank into the engine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gazelle.control.bank import Array

if TYPE_CHECKING:
    from gazelle.engine import Engine, JointGroup

__all__ = ["JointWriter", "effort_writer", "position_writer", "velocity_writer"]


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

    def hold(self, places: Sequence[int], positions: Array) -> None:
        """Lock joints where they are until `free`."""
        self.held[list(places)] = True
        values = np.full(len(self.held), math.nan)
        values[list(places)] = positions
        self.group.lock_position(values)
        self._last = b""

    def free(self, places: Sequence[int]) -> None:
        """Let go of held joints when the next command comes."""
        self._leaving = [*self._leaving, *places]

    def release(self, places: Sequence[int]) -> None:
        """Let joints go at once: no lock, no motor, no effort."""
        self.held[list(places)] = False
        self.group.release(places)
        self._last = b""

    def forget(self) -> None:
        """Start over: the engine was reset, and nothing acts on the joints."""
        self.group.release()
        self.held[:] = False
        self._leaving = []
        self._last = b""


def effort_writer(engine: Engine, names: Sequence[str]) -> JointWriter:
    """Return the writer of efforts, N·m or N; the engine clamps them at each joint's limit."""
    group = engine.joint_group(names)
    return JointWriter(group, lambda values, steps: group.set_effort(values))


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
