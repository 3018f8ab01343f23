"""A robot's controllers, for programs that step a simulation themselves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_manager import ControllerManager, ControllerRecord
from gazelle.parameters.trees import flattened

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["ControllersOfSimulation"]


class ControllersOfSimulation:
    """Loads, starts and stops controllers; no time passes for it.

    Attributes:
        namespace: of the controller manager, such as ``/mira``.
    """

    def __init__(self, server: WorldServer, manager: ControllerManager) -> None:
        self._server = server
        self._manager = manager
        self.namespace = manager.namespace

    @property
    def controllers(self) -> Mapping[str, ControllerRecord]:
        """The loaded controllers by name, with type, state and interfaces."""
        return self._manager.controllers

    def load(
        self,
        name: str,
        type_name: str | None = None,
        *,
        parameters: Mapping[str, Any] | None = None,
    ) -> ControllerRecord:
        """Load a controller, and configure it.

        Args:
            name: its name below the namespace.
            type_name: its type; that of its parameters when None.
            parameters: values to set before, nested or with dots.

        Raises:
            ControllerError: it is loaded already, or cannot be made.
        """

        def act() -> ControllerRecord:
            for key, value in flattened(parameters or {}):
                self._manager.source.set(name, key, value)
            record = self._manager.load(name, type_name)
            self._manager.configure(name)
            return record

        return self._server.commands.call(act)

    def start(self, *names: str) -> None:
        """Start controllers, all or none.

        Raises:
            ControllerError: one of them cannot be started.
        """
        self._server.commands.call(lambda: self._manager.switch(start=names))

    def stop(self, *names: str) -> None:
        """Stop controllers.

        Raises:
            ControllerError: one of them does not run.
        """
        self._server.commands.call(lambda: self._manager.switch(stop=names))

    def switch(self, *, start: tuple[str, ...] = (), stop: tuple[str, ...] = ()) -> None:
        """Stop and start controllers in one go.

        Raises:
            ControllerError: it cannot be done; nothing has changed.
        """
        self._server.commands.call(lambda: self._manager.switch(start, stop))

    def spawn(
        self,
        name: str,
        type_name: str | None = None,
        *,
        parameters: Mapping[str, Any] | None = None,
    ) -> ControllerRecord:
        """Load and start a controller; see `load`.

        Raises:
            ControllerError: it cannot be loaded or started.
        """
        record = self.load(name, type_name, parameters=parameters)
        self.start(name)
        return record

    def unload(self, name: str) -> None:
        """Forget a controller; one that runs is stopped before.

        Raises:
            ControllerError: it is not loaded.
        """

        def act() -> None:
            record = self._manager.controllers.get(name)
            if record is not None and record.is_active:
                self._manager.switch(stop=(name,))
            self._manager.unload(name)

        self._server.commands.call(act)
