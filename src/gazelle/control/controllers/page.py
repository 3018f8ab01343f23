"""The page ``docs/controllers.md``, made from the controllers' tables."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.control.table import ControllerTable, Parameter, Topic

__all__ = ["tables_as_markdown"]

_INTRODUCTION = (
    "Generated from the tables of `gazelle.control.controllers`; do not edit. A controller is known"
    " by its ROS 1 and its ROS 2 type; both take both generations' parameters unless a row says"
    " otherwise. `~/` is the controller's own namespace, names without a slash lie in the"
    " controller manager's. Parameters marked *live* can be set while it runs (`ros2 param set`,"
    " dynamic_reconfigure where ROS 1 has it). Keys that are not listed are reported."
)


def tables_as_markdown(tables: Sequence[ControllerTable]) -> str:
    """Return the page."""
    parts = ["# Controllers", "", _INTRODUCTION]
    for table in tables:
        parts += ["", *_section(table)]
    return "\n".join(parts) + "\n"


def _section(table: ControllerTable) -> list[str]:
    lines = [f"## {table.family}", "", table.summary, ""]
    lines += ["Types: " + ", ".join(f"`{name}`" for name in table.types), ""]
    lines += [f"Interfaces: {table.interfaces}"]
    if table.behaviour:
        lines += ["", *(f"- {fact}" for fact in table.behaviour)]
    if table.topics:
        lines += ["", "| name | type | | rate | frame |", "| --- | --- | --- | --- | --- |"]
        lines += [_topic_line(row) for row in table.topics]
    if table.parameters:
        lines += ["", "| parameter | other names | default | unit | meaning |"]
        lines += ["| --- | --- | --- | --- | --- |"]
        lines += [_parameter_line(row) for row in table.parameters]
    return lines


def _topic_line(row: Topic) -> str:
    kind = row.kind + _only(row.generations)
    return f"| `{row.name}` | `{row.type}` | {kind} | {row.rate} | {row.frame} |"


def _parameter_line(row: Parameter) -> str:
    aliases = ", ".join(f"`{name}`" for name in row.aliases)
    default = "" if row.kind == "none" or row.default is None else f"`{row.default}`"
    meaning = row.meaning + (" *(live)*" if row.live else "") + _only(row.generations)
    return f"| `{row.key}` | {aliases} | {default} | {row.unit} | {meaning} |"


def _only(generations: tuple[int, ...]) -> str:
    return "" if len(generations) > 1 else f" (ROS {generations[0]})"
