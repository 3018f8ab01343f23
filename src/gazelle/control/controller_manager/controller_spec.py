"""What the controller manager knows of each controller."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Protocol

from gazelle.control.controller_node_interface import Ports
from gazelle.control.controllers.controller import Controller

__all__ = ["ControllerRecord", "ControllerState", "OwnedPorts"]


class OwnedPorts(Ports, Protocol):
    """The ports of one controller, opened and closed by the manager."""

    def offer_parameters(
        self, values: Mapping[str, Any], on_set: Callable[[dict[str, Any]], str]
    ) -> None:
        """Show a controller's parameters as those of its node, where the generation has such.

        Args:
            values: by names with dots; only those that may change while it runs can be set.
            on_set: takes new values, returns why they are refused, empty when they are taken.
        """
        ...

    def close(self) -> None:
        """Take everything of the controller off the graph."""
        ...


class ControllerState(StrEnum):
    """Lifecycle states of ros2_control; `ros1_word` gives ros_control's."""

    UNCONFIGURED = "unconfigured"
    INACTIVE = "inactive"
    ACTIVE = "active"
    FINALIZED = "finalized"


@dataclass(slots=True, eq=False)
class ControllerRecord:
    """One loaded controller.

    Attributes:
        name: relative to the manager's namespace.
        type: as the user wrote it.
        state: where it is in its life.
        update_rate_hz: how often it is updated.
        has_run: it was active at least once.
        controller: None while unconfigured.
        ports: None while unconfigured.
        last_update_ns: time of the last update or start.
    """

    name: str
    type: str
    state: ControllerState
    update_rate_hz: float
    has_run: bool = False
    controller: Controller | None = None
    ports: OwnedPorts | None = None
    last_update_ns: int = 0

    @property
    def is_active(self) -> bool:
        """True while it is updated."""
        return self.state is ControllerState.ACTIVE

    @property
    def commands(self) -> tuple[str, ...]:
        """Command interfaces it claims while active."""
        return () if self.controller is None else self.controller.commands

    @property
    def states(self) -> tuple[str, ...]:
        """State interfaces it reads."""
        return () if self.controller is None else self.controller.states

    @property
    def ros1_word(self) -> str:
        """``initialized``, ``running`` or ``stopped``."""
        if self.is_active:
            return "running"
        return "stopped" if self.has_run else "initialized"
