"""C++ nodes of a launch of ROS 2: those that it comes to together are compiled together.

While something compiles, no process of the launch starts, so nodes come up side by side as where
all was built before.
"""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostics
from gazelle.launch.cpp_nodes import compiled_ahead
from gazelle.launch.node_commands import Executable
from gazelle.workspace.ament_index import known_workspace

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["CppBuilds", "builds_of"]


def builds_of(context: LaunchContext) -> CppBuilds:
    """Return what compiles for a launch."""
    if context.cpp_builds is None:
        context.cpp_builds = CppBuilds(context)
    return context.cpp_builds


class CppBuilds:
    """Compiles what nodes want, in a thread, batch by batch."""

    def __init__(self, context: LaunchContext) -> None:
        self._context = context
        self._wanted: list[Executable] = []
        self._made: dict[Executable, Executable | None] = {}
        self._task: asyncio.Task[None] | None = None

    def want(self, found: Executable) -> None:
        """Let C++ be compiled; what is wanted until the loop runs on is one batch."""
        if found in self._made or found in self._wanted:
            return
        self._wanted.append(found)
        if self._task is None or self._task.done():
            self._task = self._context.asyncio_loop.create_task(self._compile())

    async def finished(self) -> None:
        """Wait until nothing is left to compile."""
        while self._task is not None and not self._task.done():
            await asyncio.shield(self._task)

    def made_of(self, found: Executable) -> Executable | None:
        """Return how something is run that was compiled; None where that failed."""
        return self._made[found]

    async def _compile(self) -> None:
        while self._wanted:
            batch, self._wanted = self._wanted, []
            diagnostics = Diagnostics()
            loop = self._context.asyncio_loop
            try:
                made = await loop.run_in_executor(None, _compiled, batch, diagnostics)
            finally:
                self._made |= dict.fromkeys(batch)
            self._made |= dict(zip(batch, made, strict=True))
            if self._context.is_shutdown:
                return
            for one in diagnostics:
                self._context.report(one)


def _compiled(batch: Sequence[Executable], diagnostics: Diagnostics) -> list[Executable | None]:
    return compiled_ahead(batch, workspace=known_workspace(), diagnostics=diagnostics)
