"""The controller managers and actions of a world, for programs in the same process."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError

if TYPE_CHECKING:
    from gazelle.control.controller_manager import ControllerManager
    from gazelle.graph.actions import ActionServer

__all__ = ["ControlRegistry"]


class ControlRegistry:
    """Who controls what.

    Attributes:
        managers: by namespace, absolute.
        actions: action servers by global name.
        files: ROS 2 parameter files that a program gave, beside those of the plug-ins.
        overrides: ROS 2 parameters that a program gave, by the node's own name.
    """

    def __init__(self) -> None:
        self.managers: dict[str, ControllerManager] = {}
        self.actions: dict[str, ActionServer] = {}
        self.files: list[Path] = []
        self.overrides: dict[str, dict[str, Any]] = {}

    def manager(self, namespace: str = "") -> ControllerManager:
        """Return a manager; without a namespace the only one there is.

        Raises:
            NotFoundError: there is none, or more than one and no namespace was given.
        """
        wanted = "/" + namespace.strip("/")
        if wanted in self.managers:
            return self.managers[wanted]
        if not namespace and len(self.managers) == 1:
            return next(iter(self.managers.values()))
        known = ", ".join(self.managers) or "none; a robot has one when its description names a "
        known += "" if self.managers else "plug-in such as libgazebo_ros_control.so"
        nearest = nearest_names(wanted, self.managers)
        hint = f"namespaces with a controller manager: {known}"
        raise NotFoundError("controller manager", wanted, nearest=nearest, hint=hint)

    def action(self, name: str) -> ActionServer:
        """Return an action server.

        Raises:
            NotFoundError: there is none of this name.
        """
        wanted = name if name.startswith("/") else f"/{name}"
        found = self.actions.get(wanted)
        if found is not None:
            return found
        nearest = nearest_names(wanted, self.actions)
        hint = f"actions: {', '.join(self.actions) or 'none'}"
        raise NotFoundError("action", wanted, nearest=nearest, hint=hint)
