"""C++ nodes of a launch of ROS 2: those that it comes to together are compiled together.

While something compiles, no process of the launch starts, so nodes come up side by side as where
all was built before.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostic, Diagnostics

if TYPE_CHECKING:
    from gazelle.launch.node_commands import Executable

__all__ = ["CppBuilds"]


class CppBuilds:
    """Compiles what nodes want, in a thread, batch by batch.

    Args:
        loop: gives the event loop of the running launch.
        report: told each finding.
        is_over: tells whether the launch ends.
    """

    def __init__(
        self,
        loop: Callable[[], Any],
        report: Callable[[Diagnostic], None],
        is_over: Callable[[], bool],
    ) -> None:
        self._loop = loop
        self._report = report
        self._is_over = is_over
        self._wanted: list[Executable] = []
        self._made: dict[Executable, Executable | None] = {}
        self._task: asyncio.Task[None] | None = None

    def want(self, found: Executable) -> None:
        """Let C++ be compiled; what is wanted until the loop runs on is one batch."""
        if found in self._made or found in self._wanted:
            return
        self._wanted.append(found)
        if self._task is None or self._task.done():
            self._task = self._loop().create_task(self._compile())

    async def finished(self) -> bool:
        """Wait until nothing is left to compile; False when the launch has come to its end then."""
        if self._task is None:
            return True
        while not self._task.done():
            await asyncio.shield(self._task)
        return not self._is_over()

    def made_of(self, found: Executable) -> Executable | None:
        """Return how something is run that was compiled; None where that failed."""
        return self._made[found]

    async def _compile(self) -> None:
        while self._wanted:
            batch, self._wanted = self._wanted, []
            diagnostics = Diagnostics()
            try:
                made = await self._loop().run_in_executor(None, _compiled, batch, diagnostics)
            finally:
                self._made |= dict.fromkeys(batch)
            self._made |= dict(zip(batch, made, strict=True))
            if self._is_over():
                return
            for one in diagnostics:
                self._report(one)


def _compiled(batch: Sequence[Executable], diagnostics: Diagnostics) -> list[Executable | None]:
    # Only here: a launch without C++ looks for none.
    from gazelle.launch.cpp_nodes import compiled_ahead
    from gazelle.workspace.ament_index import known_workspace

    return compiled_ahead(batch, workspace=known_workspace(), diagnostics=diagnostics)
