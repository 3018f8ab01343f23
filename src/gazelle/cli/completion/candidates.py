"""Candidates for a word, from the tables of commands, the workspace and the running graph."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from importlib import import_module

from gazelle.cli.commands import COMMANDS
from gazelle.cli.completion.names import launch_arguments, named, package_names
from gazelle.cli.tool import Tool
from gazelle.errors import GazelleError
from gazelle.workspace import Workspace

__all__ = ["candidates", "subcommands"]

_SHELL_FUNCTIONS = ("roscd", "rosls", "rosed", "roscp")
# Help lines such as "find, list, depends" are tables of subcommands too.
_LISTED = re.compile(r"(?:[\w ]+: )?([\w-]+(?:, [\w-]+)+)(?:[: ].*)?")
_TABLES = ("_VERBS", "_COMMANDS")


def candidates(command: str, words: list[str]) -> list[str]:
    """Return what the last word may become, sorted.

    Args:
        command: such as ``rostopic``.
        words: those behind it; the last one is being typed and may be empty.
    """
    if command == "gazelle":
        if len(words) > 1:
            return candidates(words[0], words[1:])
        return _starting(COMMANDS, words[-1])
    try:
        found = _found(command, words)
    except GazelleError:
        # A shell shows no errors while somebody types.
        return []
    return _starting(found, words[-1])


def subcommands(command: str, words: Iterable[str] = ()) -> list[str]:
    """Return the subcommands of a command, or of ``ros2 COMMAND`` when `words` names one."""
    module = COMMANDS[command].module
    for word in words:
        module = f"{module}.{word}"
    for name in (module, f"{module}.command"):
        try:
            names = vars(import_module(name))
        except ModuleNotFoundError:
            continue
        if found := _table(names):
            return found
    match = None if tuple(words) else _LISTED.fullmatch(COMMANDS[command].help)
    return match[1].split(", ") if match else []


def _table(names: Mapping[str, object]) -> list[str]:
    for one in names.values():
        if isinstance(one, Tool):
            return list(one.commands)
    tables = [table for name in _TABLES if isinstance(table := names.get(name), Mapping)]
    return [str(name) for name in tables[0]] if tables else []


def _found(command: str, words: list[str]) -> Iterable[str]:
    position = len(words)
    if command in _SHELL_FUNCTIONS:
        return package_names() if position == 1 else ()
    if command in {"rosrun", "roslaunch", "rosversion"}:
        return _in_package(command, words, 1)
    if command not in COMMANDS:
        return ()
    if command == "ros2":
        return _ros2(words)
    if position == 1:
        return subcommands(command)
    return named(command.removeprefix("ros"), words, ros2=False)


def _ros2(words: list[str]) -> Iterable[str]:
    if len(words) == 1:
        return subcommands("ros2")
    if words[0] in {"run", "launch"}:
        return _in_package({"run": "rosrun", "launch": "roslaunch"}[words[0]], words[1:], 2)
    if len(words) == 2:
        return subcommands("ros2", words[:1])
    return named(words[0], words[1:], ros2=True)


def _in_package(command: str, words: list[str], ros_version: int) -> Iterable[str]:
    if len(words) == 1:
        return package_names(ros_version)
    if command == "rosversion":
        return ()
    if len(words) > 2:
        return launch_arguments(words[:2]) if command == "roslaunch" else ()
    package = Workspace.discover().packages.get(words[0])
    if command == "roslaunch":
        return {path.name for path in package.path.rglob("*.launch*")} if package else ()
    from gazelle.node_specs.registry import builtin_executables, names_of_other_ros

    files = package.executable_names if package else ()
    others = names_of_other_ros(ros_version)
    builtin = [one for one in builtin_executables(words[0]) if (words[0], one) not in others]
    return {*files, *builtin}


def _starting(names: Iterable[str], start: str) -> list[str]:
    return sorted({name for name in names if name.startswith(start)})
