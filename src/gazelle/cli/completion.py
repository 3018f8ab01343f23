"""``gazelle complete WORD…``: what a shell offers behind the words typed so far.

Candidates come from the tables of commands, the workspace and the running graph.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path

from gazelle.cli.commands import COMMANDS
from gazelle.cli.ros_tool import Tool
from gazelle.cli.ros_types import learn_workspace_types, shown_type
from gazelle.demo import DEMOS
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.interfaces import known_types
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.node_specs.registry import names_of_other_ros
from gazelle.workspace import Workspace

__all__ = ["candidates", "launch_arguments", "main", "named", "package_names", "subcommands"]

# Subcommands whose words are no names of their kind.
_OTHERS = frozenset({"list", "find", "load", "dump"})
_PARTS = {"msg": ("msg",), "srv": ("srv",), "interface": ("action", "msg", "srv")}
_WAYS: dict[str, Callable[[Graph], Iterable[str]]] = {
    "topic": lambda graph: (one.name for one in graph.topics()),
    "node": lambda graph: graph.node_names(),
    "service": lambda graph: (one.name for one in graph.services()),
    "param": lambda graph: graph.parameters.names(),
}
_SHELL_FUNCTIONS = ("roscd", "rosls", "rosed", "roscp")
# Help lines such as "find, list, depends" are tables of subcommands too.
_LISTED = re.compile(r"(?:[\w ]+: )?([\w-]+(?:, [\w-]+)+)(?:[: ].*)?")
_TABLES = ("_VERBS", "_COMMANDS")


def main(argv: list[str]) -> int:
    """Print the candidates for the last word, one per line; nothing means files."""
    if not argv:
        print("usage: gazelle complete COMMAND [WORD ...]")
        return 2
    command, *tokens = argv
    for one in candidates(Path(command).name, tokens or [""]):
        print(one)
    return 0


def named(kind: str, argv: Sequence[str], *, ros2: bool) -> Iterable[str]:
    """Return the names that may follow.

    Args:
        kind: what the command is about: ``topic``, ``node``, ``msg`` ….
        argv: the subcommand and those behind it; the last one is being typed.
        ros2: types are shown as ROS 2 does.
    """
    subcommand, position = argv[0], len(argv) - 1
    if kind == "pack":
        return package_names() if subcommand != "list" else ()
    if kind in _PARTS and subcommand == "package":
        return {name.partition("/")[0] for name in _types(_PARTS[kind], ros2=ros2)}
    if kind in _PARTS:
        return (
            _types(_PARTS[kind], ros2=ros2)
            if subcommand in {"show", "info", "md5", "proto"}
            else ()
        )
    if kind == "topic" and subcommand == "pub" and position == 2:
        return _types(("msg",), ros2=ros2)
    if kind == "param" and ros2 and position > 1:
        return ()
    way = _WAYS.get("node" if kind == "param" and ros2 else kind)
    if way is None or subcommand in _OTHERS or position > 1:
        return ()
    with Graph.open(role="client") as graph:
        return sorted(way(graph))


def launch_arguments(argv: Sequence[str]) -> Iterable[str]:
    """Return ``name:=`` for every argument of a launch file: a file, or a package and a name."""
    package = Workspace.discover().packages.get(argv[0])
    file = Path(argv[0]) if package is None else next(package.path.rglob(argv[1]), None)
    if file is None or not file.is_file():
        return ()
    workspace, ignored = Workspace.discover(), Diagnostics()
    config = load_launch_files([file], {}, workspace=workspace, diagnostics=ignored)
    # One with a value="…" cannot be given.
    return [f"{one.name}:=" for one in config.args if one.value is None]


def package_names(ros_version: int | None = None) -> Iterable[str]:
    """Return the names of all packages; of Gazelle's own only those of a version of ROS, if given.

    Args:
        ros_version: whose command is typed; None where it is that of both.
    """
    packages = Workspace.discover().packages
    if ros_version is None:
        return packages
    others = names_of_other_ros(ros_version)
    return [name for name, one in packages.items() if not (one.is_builtin and (name, "") in others)]


def candidates(command: str, argv: list[str]) -> list[str]:
    """Return what the last word may become, sorted.

    Args:
        command: such as ``rostopic``.
        argv: those behind it; the last one is being typed and may be empty.
    """
    if command == "gazelle":
        if len(argv) > 1:
            return candidates(argv[0], argv[1:])
        return _starting(COMMANDS, argv[-1])
    try:
        found = _found(command, argv)
    except GazelleError:
        # A shell shows no errors while somebody types.
        return []
    return _starting(found, argv[-1])


def subcommands(command: str, argv: Iterable[str] = ()) -> list[str]:
    """Return the subcommands of a command, or of ``ros2 COMMAND`` when `argv` names one."""
    module = COMMANDS[command].module
    for word in argv:
        module = f"{module}.{word}"
    with suppress(ModuleNotFoundError):
        if found := _table(vars(import_module(module))):
            return found
    match = None if tuple(argv) else _LISTED.fullmatch(COMMANDS[command].help)
    return match[1].split(", ") if match else []


def _types(parts: Iterable[str], *, ros2: bool) -> list[str]:
    learn_workspace_types()
    names = [name for part in parts for name in known_types(part)]
    return names if ros2 else [shown_type(name) for name in names]


def _table(names: Mapping[str, object]) -> list[str]:
    for one in names.values():
        if isinstance(one, Tool):
            return list(one.commands)
    tables = [table for name in _TABLES if isinstance(table := names.get(name), Mapping)]
    return [str(name) for name in tables[0]] if tables else []


def _found(command: str, argv: list[str]) -> Iterable[str]:
    position = len(argv)
    if command in _SHELL_FUNCTIONS:
        return package_names() if position == 1 else ()
    if command in {"rosrun", "roslaunch", "rosversion"}:
        return _in_package(command, argv, 1)
    if command == "demo":
        return [demo.name for demo in DEMOS] if position == 1 else ()
    if command not in COMMANDS:
        return ()
    if command == "record":
        return _recorded(argv)
    if command == "ros2":
        return _ros2(argv)
    if position == 1:
        return subcommands(command)
    return named(command.removeprefix("ros"), argv, ros2=False)


def _ros2(argv: list[str]) -> Iterable[str]:
    if len(argv) == 1:
        return subcommands("ros2")
    if argv[0] in {"run", "launch"}:
        return _in_package({"run": "rosrun", "launch": "roslaunch"}[argv[0]], argv[1:], 2)
    if len(argv) == 2:
        return subcommands("ros2", argv[:1])
    return named(argv[0], argv[1:], ros2=True)


def _recorded(argv: list[str]) -> Iterable[str]:
    """Return values of options that have few, else packages and their launch files."""
    from gazelle.cli.record import FLAGS, VALUES

    before = argv[-2] if len(argv) > 1 else ""
    if before.startswith("-") and before not in FLAGS:
        return VALUES.get(before, ())
    targets = [
        word
        for last, word in zip(["", *argv], argv, strict=False)
        if not word.startswith("-") and (not last.startswith("-") or last in FLAGS)
    ]
    if len(targets) < 2:
        return package_names() if targets else ()
    return _in_package("roslaunch", targets, 1)


def _in_package(command: str, argv: list[str], ros_version: int) -> Iterable[str]:
    if len(argv) == 1:
        return package_names(ros_version)
    if command == "rosversion":
        return ()
    if len(argv) > 2:
        return launch_arguments(argv[:2]) if command == "roslaunch" else ()
    package = Workspace.discover().packages.get(argv[0])
    if command == "roslaunch":
        return {path.name for path in package.path.rglob("*.launch*")} if package else ()
    from gazelle.node_specs.registry import builtin_executables, names_of_other_ros

    files = package.executable_names if package else ()
    others = names_of_other_ros(ros_version)
    builtin = [one for one in builtin_executables(argv[0]) if (argv[0], one) not in others]
    return {*files, *builtin}


def _starting(names: Iterable[str], start: str) -> list[str]:
    return sorted({name for name in names if name.startswith(start)})
