"""What runs a node of a launch file: its command, found when the node is started."""

from __future__ import annotations

import os
import shlex
import stat
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan
from gazelle.launch.environment import command_folder
from gazelle.launch.node_commands import Executable as FoundExecutable
from gazelle.launch.node_commands import find_executable, script_command
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.error_diagnostics import with_diagnostic
from gazelle.launch.ros2.substitutions import SubstitutionFailure
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.node_specs.unavailable_packages import missing_node, replacement_of
from gazelle.workspace.ament_index import PackageNotFoundError, known_workspace

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["NodeCommand", "NodeExecutable", "node_command", "wrapper_script"]

_COMPILED = "launch.compiled-node"
_NO_PACKAGE = "launch.package-missing"
_BUILD = "add_executable() in its CMakeLists.txt, or write the node in Python with rclpy"


class NodeCommand(NamedTuple):
    """How a node is run.

    Attributes:
        argv: of its command.
        program: the name that its output begins with.
        found: what it is; None for a path.
    """

    argv: tuple[str, ...]
    program: str
    found: FoundExecutable | None = None

    @property
    def has_to_be_compiled(self) -> bool:
        """Whether it is C++ that nobody has compiled yet."""
        return self.found is not None and self.found.cpp is not None

    @property
    def executable(self) -> FoundExecutable:
        """What was found.

        Raises:
            ValueError: it is a path.
        """
        if self.found is None:
            raise ValueError(f"'{self.program}' is a path")
        return self.found

    def replaced_in(self, words: Sequence[str], other: Sequence[str]) -> list[str]:
        """Return a command's words with other ones in the place of this one's."""
        count = len(self.argv)
        for start in range(len(words) - count + 1):
            if tuple(words[start : start + count]) == self.argv:
                return [*words[:start], *other, *words[start + count :]]
        return list(words)


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
        self, context: LaunchContext, package: Any, executable: Any, span: SourceSpan | None
    ) -> bool:
        """Look for what runs the node; False when it is code that nothing here compiles.

        Raises:
            PackageNotFoundError: there is no such package.
            SubstitutionFailure: the package has no such executable.
        """
        name = _text(context, executable)
        self.command = node_command(
            context, None if package is None else _text(context, package), name, span
        )
        if self.command is None:
            return False
        first = [normalize_to_list_of_substitutions(word) for word in self.command.argv]
        self.cmd = [*first, *self.cmd[1:]]
        if self.name is None:
            self.name = normalize_to_list_of_substitutions(self.command.program)
        return True

    def add_arguments(self, argv: Iterable[Any]) -> None:
        """Put words behind the command."""
        self.cmd += [normalize_to_list_of_substitutions(word) for word in argv]

    def _prefix_argv(self, context: LaunchContext, program: str) -> list[str]:
        # A filter is about the node, not about the interpreter that runs it.
        own = program if self.command is None else self.command.program
        return super()._prefix_argv(context, own)


def node_command(
    context: LaunchContext, package: str | None, executable: str, span: SourceSpan | None = None
) -> NodeCommand | None:
    """Return what runs an executable of a package, or a path.

    Args:
        context: of the launch; findings are told to it.
        package: None when `executable` is a path or a command.
        executable: as written.
        span: of the user's file, for messages.

    Returns:
        None when it is code that nothing here compiles, or a package of ROS that Gazelle does
        not bring: the launch goes on without it.

    Raises:
        PackageNotFoundError: there is no such package.
        SubstitutionFailure: the package has no such executable.
    """
    program = Path(executable).name
    if package is None:
        path = Path(executable)
        argv = script_command(path) if path.is_file() else (executable,)
        return NodeCommand(argv, program)
    diagnostics = Diagnostics()
    found = find_executable(
        package,
        executable,
        workspace=known_workspace(),
        diagnostics=diagnostics,
        span=span,
        environ=context.environment,
        ros_version=2,
    )
    if found is not None:
        for one in diagnostics:
            context.report(one)
        return NodeCommand(found.command, program, found)
    missing = diagnostics.errors[0]
    if missing.code == _COMPILED:
        context.report(replace(missing, fix=_BUILD))
        return None
    what = replacement_of(package)
    if missing.code == _NO_PACKAGE and what:
        # A package of ROS that is not here: everybody else has it, so the others go on.
        _tell_of_absence(context, missing, "ros2_launch.package-missing", what)
        return None
    what = missing_node(package, executable)
    if what:
        _tell_of_absence(context, missing, "ros2_launch.executable-missing", what)
        return None
    if missing.code == _NO_PACKAGE:
        error: Exception = PackageNotFoundError(f"package '{package}' not found")
        code, fix = "ros2_launch.package-missing", ""
    else:
        error = SubstitutionFailure(f"executable '{executable}' not found in package '{package}'")
        code, fix = "ros2_launch.executable-missing", _near(missing)
    raise with_diagnostic(error, code, missing.message, missing.span, fix=fix)


def wrapper_script(command: NodeCommand) -> Path:
    """Return a file that runs a command, for where the path of an executable is wanted."""
    if len(command.argv) == 1:
        return Path(command.argv[0])
    text = f'#!/bin/sh\nexec {shlex.join(command.argv)} "$@"\n'
    folder = command_folder() / "nodes" / command.argv[-1].strip("/").replace("/", "-")
    folder.mkdir(parents=True, exist_ok=True)
    script = folder / command.program
    if not script.is_file() or script.read_text(encoding="utf-8") != text:
        part = script.with_suffix(f".{os.getpid()}")
        part.write_text(text, encoding="utf-8")
        part.chmod(part.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
        part.replace(script)
    return script


def _tell_of_absence(context: LaunchContext, missing: Diagnostic, code: str, what: str) -> None:
    found = Diagnostics()
    message = f"{missing.message.partition(chr(10))[0].partition(';')[0]}; the others go on"
    found.report(code, message, missing.span, fix=what)
    context.report(next(iter(found)))


def _near(missing: Diagnostic) -> str:
    """Return the names like the one that is missing, or nothing."""
    return missing.fix if missing.fix.startswith("did you mean") else ""


def _text(context: LaunchContext, value: Any) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))
