"""Controllers whose work another object does, chosen when they are made."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, Protocol

from gazelle.control.controllers.controller import Controller, ControllerContext

__all__ = ["Drive", "DriveController"]


class Drive(Protocol):
    """What drives the joints of a base."""

    commands: tuple[str, ...]
    states: tuple[str, ...]

    def start(self, time_ns: int) -> None:
        """Begin."""

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""

    def stop(self, time_ns: int) -> None:
        """End."""

    def changed(self, values: dict[str, Any]) -> str:
        """Take over live parameters; return why not."""
        ...


class DriveController(Controller):
    """Passes on everything to its drive."""

    def __init__(self, context: ControllerContext) -> None:
        """Make the drive."""
        super().__init__(context)
        self._drive = self._make(context)
        self.commands, self.states = self._drive.commands, self._drive.states

    @abstractmethod
    def _make(self, context: ControllerContext) -> Drive: ...

    def start(self, time_ns: int) -> None:
        """Begin."""
        self._drive.start(time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        self._drive.update(time_ns, period_ns)

    def stop(self, time_ns: int) -> None:
        """End."""
        self._drive.stop(time_ns)

    def changed(self, values: dict[str, Any]) -> str:
        """Take over live parameters."""
        return self._drive.changed(values)
