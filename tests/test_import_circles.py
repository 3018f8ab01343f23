"""Modules do not import each other in a circle; those that still do are listed, and get fewer."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterator
from functools import cache
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src" / "gazelle"
# Python of users' packages and of ROS's names has the originals' structure.
NOT_OURS = (SOURCE / "compat" / "modules", SOURCE / "workspace" / "builtin")
# What is left: the first module of each circle by name, and how many modules are in it. A circle
# that is gone or smaller is to be taken out here.
WHEN_RUN = {
    # A URDF's <gazebo> holds SDF, and an <include> of SDF may name a URDF.
    "gazelle.description.sdf_reader.models": 5,
    # The originals' packages, which users import from, gather modules that need each other.
    "gazelle.launch.ros2.actions": 27,
}
# Those that only types close: by their first module, for one class and its parts know each other.
WITH_TYPES = {
    *WHEN_RUN,
    "gazelle.compat.rclpy.event_handler",
    "gazelle.engine.engine",
    "gazelle.graph.actions.actionlib_wire",
    "gazelle.graph.callback_queue",
    "gazelle.launch.ros2.action",
    "gazelle.launch.ros2.event_handler",
    "gazelle.simulator.divergence_recovery",
    "gazelle.workspace.uri_resolver",
} - {"gazelle.launch.ros2.actions"}


def test_no_circle_of_imports_but_for_those_left() -> None:
    """Imports inside of functions count."""
    circles = _circles({name: run for name, (run, _types) in _imports().items()})
    found = {min(circle): len(circle) for circle in circles}
    assert found == WHEN_RUN, _shown(circles, WHEN_RUN)


def test_no_circle_of_types_but_for_those_left() -> None:
    circles = _circles({name: run | types for name, (run, types) in _imports().items()})
    assert {min(circle) for circle in circles} == WITH_TYPES, _shown(circles, WITH_TYPES)


def _shown(circles: list[list[str]], left: Container[str]) -> str:
    return "\n".join(" ".join(circle) for circle in circles if min(circle) not in left)


def test_a_circle_is_found_once_and_what_only_leads_to_it_is_not_in_it() -> None:
    graph = {"a": {"b"}, "b": {"c", "d"}, "c": {"b"}, "d": set(), "e": {"a"}}
    assert _circles(graph) == [["b", "c"]]


@cache
def _imports() -> dict[str, tuple[set[str], set[str]]]:
    """Return by module what it imports when it runs, and what for type checkers only."""
    paths = [path for path in SOURCE.rglob("*.py") if not set(NOT_OURS) & set(path.parents)]
    modules = {_name(path): path for path in paths}
    found: dict[str, tuple[set[str], set[str]]] = {}
    for name, path in modules.items():
        run: set[str] = set()
        types: set[str] = set()
        for node, is_for_types in _import_statements(ast.parse(path.read_text(encoding="utf-8"))):
            (types if is_for_types else run).update(set(_modules_of(node, modules)) - {name})
        found[name] = (run, types)
    return found


def _name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _import_statements(tree: ast.Module) -> Iterator[tuple[ast.Import | ast.ImportFrom, bool]]:
    waiting: list[tuple[ast.AST, bool]] = [(tree, False)]
    while waiting:
        parent, is_for_types = waiting.pop()
        checks = isinstance(parent, ast.If) and ast.unparse(parent.test) == "TYPE_CHECKING"
        for block in ("body", "orelse", "finalbody", "handlers", "cases"):
            for node in getattr(parent, block, ()):
                so = is_for_types or (checks and block == "body")
                if isinstance(node, ast.Import | ast.ImportFrom):
                    yield node, so
                elif isinstance(node, ast.AST):
                    waiting.append((node, so))


def _modules_of(node: ast.Import | ast.ImportFrom, modules: dict[str, Path]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names if alias.name in modules)
        return
    for alias in node.names:
        whole = f"{node.module}.{alias.name}"
        name = whole if whole in modules else node.module
        if name is not None and name in modules:
            yield name


def _circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Return the strongly connected components of more than one module (Tarjan 1972)."""
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    circles: list[list[str]] = []
    for start, first in graph.items():
        work = [(start, iter(sorted(first)))] if start not in number else []
        while work:
            name, others = work[-1]
            if name not in number:
                number[name] = lowest[name] = len(number)
                stack.append(name)
            for other in others:
                if other not in number:
                    work.append((other, iter(sorted(graph[other]))))
                    break
                if other in stack:
                    lowest[name] = min(lowest[name], number[other])
            else:
                work.pop()
                if work:
                    lowest[work[-1][0]] = min(lowest[work[-1][0]], lowest[name])
                if lowest[name] == number[name]:
                    place = stack.index(name)
                    circle, stack[place:] = stack[place:], []
                    circles += [sorted(circle)] if len(circle) > 1 else []
    return circles
