"""The page of the built-in nodes, ``docs/builtin_nodes.md``: run as a program it prints it."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable

from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import ROS_BOTH, Direction, FrameRow, Interface, NodeName, NodeSpec

__all__ = ["nodes_markdown"]

_HEAD = """# Nodes that are built in

Generated from the rows that the nodes are found by; do not edit (`python -m
gazelle.node_specs.docs > docs/builtin_nodes.md`). `rosrun PACKAGE EXECUTABLE`,
`ros2 run` and launch files start them under any of their names. Names of topics are those of the
code, before remapping: `/global`, `relative`, `~private`; `{~scan_topic|scan}` is the value of a
parameter, or `scan`. Topics that only words or parameters name are not listed; parameters are on
[a page of their own](nodes.md).
"""
_PARAMETER = re.compile(r"(!?)(~?[\w.]+)\|(.*)")


def nodes_markdown() -> str:
    """Return the page: a section for each node, by package."""
    specs = sorted(node_specs(), key=lambda spec: (spec.package, spec.executable))
    return "\n".join([_HEAD, *(_section(spec) for spec in specs)])


def _section(spec: NodeSpec) -> str:
    lines = [
        f"## {spec.package} {spec.executable}{_ros(spec.names[0])}",
        "",
        f"{spec.does[0].upper()}{spec.does[1:]}.",
    ]
    if spec.aliases:
        names = ", ".join(f"`{one.package} {one.executable}`{_ros(one)}" for one in spec.aliases)
        lines += ["", f"Also {names}."]
    rows = [
        *_rows(("publishes", "listens to"), spec.topics),
        *_rows(("answers the service", "calls the service"), spec.services),
        *_rows(("answers the action", "calls the action"), spec.actions),
        *(_frame(row) for row in spec.frames or ()),
    ]
    if rows:
        lines += ["", "| It | name | type | |", "| --- | --- | --- | --- |", *rows]
    return "\n".join([*lines, ""])


def _ros(name: NodeName) -> str:
    return "" if name.ros == ROS_BOTH else f" (ROS {name.ros[0]})"


def _rows(words: tuple[str, str], items: Iterable[Interface]) -> list[str]:
    return [
        _row(words[item.direction is Direction.TAKES], item.name, item.type, item.when, item.remark)
        for item in items
    ]


def _frame(row: FrameRow) -> str:
    return _row("sends tf", f"{row.parent} → {row.child}", "", row.when, row.remark)


def _row(does: str, name: str, kind: str, when: str, remark: str) -> str:
    notes = "; ".join(filter(None, (_condition(when), remark)))
    shown = f"`{name}`".replace("|", "\\|")
    return f"| {does} | {shown} | {f'`{kind}`' if kind else ''} | {notes} |"


def _condition(when: str) -> str:
    found = _PARAMETER.fullmatch(when)
    if found is None:
        return ""
    return f"while `{found[2]}` is {'false' if found[1] else 'true'}, default {found[3]}"


if __name__ == "__main__":
    sys.stdout.write(nodes_markdown())
