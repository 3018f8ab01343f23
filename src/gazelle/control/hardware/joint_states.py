"""Positions, velocities and efforts of joints, from the engine into the bank."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gazelle.control.interface_values import Array, InterfaceBank

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["JOINT_STATES", "JointStates"]

JOINT_STATES = ("position", "velocity", "effort")


class JointStates:
    """States of the joints of one piece of hardware; one gather a reading.

    Args:
        engine: the physics.
        bank: takes the values; interfaces are registered at once.
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
        bank: InterfaceBank,
        model: str,
        joints: Sequence[tuple[str, Sequence[str]]],
    ) -> None:
        self.names = tuple(name for name, _ in joints)
        self.group = engine.joint_group([f"{model}::{name}" for name in self.names])
        self.position: Array = np.zeros(len(joints))
        self.velocity: Array = np.zeros(len(joints))
        self.effort: Array = np.zeros(len(joints))
        self._bank = bank
        self._blocks = [_Block(bank, kind, joints) for kind in JOINT_STATES]
        self._looked_up = -1
        self._wants_effort = False

    def read(self) -> None:
        """Measure. Efforts cost more: they are read once a controller has asked for one."""
        self.group.read(self.position, self.velocity)
        states = self._bank.states
        if self._looked_up != len(self._bank.looked_up):
            self._looked_up = len(self._bank.looked_up)
            self._wants_effort = self._blocks[2].is_among(self._bank.looked_up)
        self._blocks[0].write(states, self.position)
        self._blocks[1].write(states, self.velocity)
        if self._wants_effort:
            self.group.effort(self.effort)
            self._blocks[2].write(states, self.effort)


class _Block:
    """The states of one kind, side by side in the bank."""

    def __init__(
        self, bank: InterfaceBank, kind: str, joints: Sequence[tuple[str, Sequence[str]]]
    ) -> None:
        chosen = [place for place, (_, kinds) in enumerate(joints) if kind in kinds]
        places = [bank.add_state(f"{joints[place][0]}/{kind}") for place in chosen]
        first = places[0] if places else 0
        self._target = slice(first, first + len(places))
        self._source = None if len(chosen) == len(joints) else np.array(chosen, dtype=np.intp)

    def write(self, states: Array, values: Array) -> None:
        states[self._target] = values if self._source is None else values[self._source]

    def is_among(self, places: set[int]) -> bool:
        return not places.isdisjoint(range(self._target.start, self._target.stop))
