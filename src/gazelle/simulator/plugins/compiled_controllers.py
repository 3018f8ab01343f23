"""What finds controllers in C++ for a robot's manager, and gives them the world they run in."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from gazelle.simulator.plugins.context import PluginContext

if TYPE_CHECKING:
    from gazelle.control.controllers.controller import Controller

__all__ = ["compiled_controllers"]


def compiled_controllers(
    context: PluginContext, description: Callable[[], str]
) -> Callable[[str], type[Controller] | None]:
    """Return what finds a controller's class by its type; nothing is imported before that.

    Args:
        context: the plug-in of the robot's manager.
        description: gives the text of the robot's description.
    """
    host = context.host
    workspace = host.workspace

    def find(type_name: str) -> type[Controller] | None:
        if workspace is None:
            return None
        from gazelle.cpp.controllers import ControllerHost, find_compiled_controller
        from gazelle.cpp.host.embedded import EmbeddingWorld

        world = EmbeddingWorld(host.node, host.commands.call, workspace)
        surroundings = ControllerHost(
            workspace=workspace,
            diagnostics=host.diagnostics,
            world=world,
            post=host.commands.post,
            now_ns=lambda: host.engine.time_ns,
            description=description,
        )
        return find_compiled_controller(type_name, surroundings)

    return find
