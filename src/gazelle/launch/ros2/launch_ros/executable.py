"""The command of a node: found when the node is started."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import SourceSpan
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.launch_ros.node_executable import NodeCommand, node_command
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["NodeExecutable"]


class NodeExecutable(Executable):
    """A node's command; its first word stands for several, such as an interpreter and a file.

    Attributes:
        command: what was found; None before.
    """

    command: NodeCommand | None = None

    @classmethod
    def of(cls, plain: Executable) -> NodeExecutable:
        """Return the same command as that of a node."""
        made = cls.__new__(cls)
        made.__dict__.update(plain.__dict__)
        return made

    def find(
        self, context: LaunchContext, package: Any, executable: Any, place: SourceSpan | None
    ) -> bool:
        """Look for what runs the node; False when it is compiled code that is not here.

        Raises:
            PackageNotFoundError: there is no such package.
            SubstitutionFailure: the package has no such executable.
        """
        name = _text(context, executable)
        self.command = node_command(
            context, None if package is None else _text(context, package), name, place
        )
        if self.command is None:
            return False
        first = [normalize_to_list_of_substitutions(word) for word in self.command.words]
        self.cmd = [*first, *self.cmd[1:]]
        if self.name is None:
            self.name = normalize_to_list_of_substitutions(self.command.program)
        return True

    def add_words(self, words: Iterable[Any]) -> None:
        """Put words behind the command."""
        self.cmd += [normalize_to_list_of_substitutions(word) for word in words]

    def _prefix_words(self, context: LaunchContext, program: str) -> list[str]:
        # A filter is about the node, not about the interpreter that runs it.
        own = program if self.command is None else self.command.program
        return super()._prefix_words(context, own)


def _text(context: LaunchContext, value: Any) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))
