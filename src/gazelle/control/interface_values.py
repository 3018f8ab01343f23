"""The values that hardware and controllers share: one array of states, one of commands."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Indices", "InterfaceValues"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class InterfaceValues:
    """State and command interfaces by name, ``joint/interface`` as ros2_control writes them.

    Hardware registers its interfaces, `freeze` allocates the arrays; from then on hardware and
    controllers exchange numbers in place, with indices they looked up once.

    Attributes:
        states: what hardware measured (S,), in the unit of each interface; NaN before the first
            reading.
        commands: what controllers want (C,); NaN for nothing yet.
        stiffness: what a command loses per motion of its own joint (C,), 0 where it does not look.
        damping: what it loses per velocity.
        state_index: index of each state interface.
        command_index: index of each command interface.
        looked_up: indices of states that somebody reads; hardware may leave the costly others out.
    """

    def __init__(self) -> None:
        self.states: Array = np.empty(0)
        self.commands: Array = np.empty(0)
        self.stiffness: Array = np.empty(0)
        self.damping: Array = np.empty(0)
        self.state_index: dict[str, int] = {}
        self.command_index: dict[str, int] = {}
        self.looked_up: set[int] = set()
        self._initial_states: list[float] = []
        self._initial_commands: list[float] = []
        self._frozen = False

    def add_state(self, name: str, initial: float = math.nan) -> int:
        """Register a state interface and return its index.

        Raises:
            ValueError: the interfaces are frozen or it is there already.
        """
        return self._add(self.state_index, self._initial_states, name, initial)

    def add_command(self, name: str, initial: float = math.nan) -> int:
        """Register a command interface and return its index.

        Raises:
            ValueError: the interfaces are frozen or it is there already.
        """
        return self._add(self.command_index, self._initial_commands, name, initial)

    def freeze(self) -> None:
        """Allocate the arrays; nothing can be registered afterwards."""
        self.states = np.array(self._initial_states, dtype=np.float64)
        self.commands = np.array(self._initial_commands, dtype=np.float64)
        self.stiffness, self.damping = np.zeros((2, len(self.commands)))
        self._frozen = True

    def state_indices(self, names: Iterable[str]) -> Indices:
        """Return the indices of n state interfaces, (n,); hardware keeps them filled from now on.

        Raises:
            KeyError: there is no such interface.
        """
        indices = [self.state_index[name] for name in names]
        self.looked_up.update(indices)
        return np.array(indices, dtype=np.intp)

    def command_indices(self, names: Iterable[str]) -> Indices:
        """Return the indices of n command interfaces, (n,).

        Raises:
            KeyError: there is no such interface.
        """
        return np.array([self.command_index[name] for name in names], dtype=np.intp)

    def answer(
        self, indices: Indices | int, stiffness: Array | float, damping: Array | float
    ) -> None:
        """Tell how efforts answer to their joints, at every update of a feedback.

        Hardware that has the physics at hand lets light joints feel it within a step.

        Args:
            indices: of n commands, (n,).
            stiffness: (n,), what each loses per rad or m of its own joint.
            damping: (n,), what each loses per rad/s or m/s.
        """
        self.stiffness[indices], self.damping[indices] = stiffness, damping

    def _add(self, index: dict[str, int], initial: list[float], name: str, value: float) -> int:
        if self._frozen:
            raise ValueError(f"interface '{name}' comes after the bank was frozen")
        if name in index:
            raise ValueError(f"interface '{name}' is there twice")
        index[name] = len(initial)
        initial.append(value)
        return index[name]
