"""Names that commands take: of the running graph, of types, of packages, of launch arguments."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from gazelle.cli.ros_types import learn_workspace_types, shown_type
from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.interfaces import known_types
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.node_specs.registry import names_of_other_ros
from gazelle.workspace import Workspace

__all__ = ["launch_arguments", "named", "package_names"]

# Subcommands whose words are no names of their kind.
_OTHERS = frozenset({"list", "find", "load", "dump"})
_PARTS = {"msg": ("msg",), "srv": ("srv",), "interface": ("action", "msg", "srv")}


def named(kind: str, words: Sequence[str], *, ros2: bool) -> Iterable[str]:
    """Return the names that may follow.

    Args:
        kind: what the command is about: ``topic``, ``node``, ``msg`` ….
        words: the subcommand and those behind it; the last one is being typed.
        ros2: types are shown as ROS 2 does.
    """
    subcommand, position = words[0], len(words) - 1
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


def launch_arguments(words: Sequence[str]) -> Iterable[str]:
    """Return ``name:=`` for every argument of a launch file: a file, or a package and a name."""
    package = Workspace.discover().packages.get(words[0])
    file = Path(words[0]) if package is None else next(package.path.rglob(words[1]), None)
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


def _types(parts: Iterable[str], *, ros2: bool) -> list[str]:
    learn_workspace_types()
    names = [name for part in parts for name in known_types(part)]
    return names if ros2 else [shown_type(name) for name in names]


_WAYS: dict[str, Callable[[Graph], Iterable[str]]] = {
    "topic": lambda graph: (one.name for one in graph.topics()),
    "node": lambda graph: graph.node_names(),
    "service": lambda graph: (one.name for one in graph.services()),
    "param": lambda graph: graph.parameters.names(),
}
