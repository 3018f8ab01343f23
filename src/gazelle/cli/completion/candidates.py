"""Candidates for a word, from the tables of commands, the workspace and the running graph."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from importlib import import_module

from gazelle.cli.commands import COMMANDS
from gazelle.cli.tool import Tool
from gazelle.errors import GazelleError
from gazelle.graph import Graph
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
    try:
        names = vars(import_module(module))
    except ModuleNotFoundError:
        return []
    for one in names.values():
        if isinstance(one, Tool):
            return list(one.commands)
    table = next((names[name] for name in _TABLES if isinstance(names.get(name), Mapping)), None)
    if table is not None:
        return [str(name) for name in table]
    match = None if tuple(words) else _LISTED.fullmatch(COMMANDS[command].help)
    return match[1].split(", ") if match else []


def _found(command: str, words: list[str]) -> Iterable[str]:
    position = len(words)
    if command in _SHELL_FUNCTIONS:
        return _packages() if position == 1 else ()
    if command in {"rosrun", "roslaunch", "rosversion"}:
        return _in_package(command, words)
    if command not in COMMANDS:
        return ()
    if command == "ros2":
        return _ros2(words)
    if position == 1:
        return subcommands(command)
    return _named(command.removeprefix("ros"), words[0])


def _ros2(words: list[str]) -> Iterable[str]:
    if len(words) == 1:
        return subcommands("ros2")
    if words[0] in {"run", "launch"}:
        return _in_package({"run": "rosrun", "launch": "roslaunch"}[words[0]], words[1:])
    if len(words) == 2:
        return subcommands("ros2", words[:1])
    return _named(words[0], words[1])


def _in_package(command: str, words: list[str]) -> Iterable[str]:
    if len(words) == 1:
        return _packages()
    if len(words) != 2 or command == "rosversion":
        return ()
    package = Workspace.discover().packages.get(words[0])
    if command == "roslaunch":
        return {path.name for path in package.path.rglob("*.launch*")} if package else ()
    from gazelle.nodes.registry import builtin_types

    files = package.executable_names if package else ()
    return {*files, *builtin_types(words[0])}


def _packages() -> Iterable[str]:
    return Workspace.discover().packages


def _named(kind: str, subcommand: str) -> Iterable[str]:
    """Return the names in the running graph that a command takes."""
    ways: dict[str, Callable[[Graph], Iterable[str]]] = {
        "topic": lambda graph: (one.name for one in graph.topics()),
        "node": lambda graph: graph.node_names(),
        "service": lambda graph: (one.name for one in graph.services()),
    }
    if kind == "pack" and subcommand != "list":
        return _packages()
    if kind not in ways or subcommand in {"list", "find"}:
        return ()
    with Graph.open(role="client") as graph:
        return sorted(ways[kind](graph))


def _starting(names: Iterable[str], start: str) -> list[str]:
    return sorted({name for name in names if name.startswith(start)})
