"""The page ``docs/controllers.md``, made from the controllers' tables."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.control.controller_parameters import ControllerTable
from gazelle.parameters import Topic
from gazelle.parameters.markdown import facts, headed, in_code, only_in, parameter_lines

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
    parameters = table.parameters
    lines = [f"## {parameters.family}", "", parameters.summary, ""]
    lines += [f"Types: {in_code(parameters.types)}", "", f"Interfaces: {table.interfaces}"]
    lines += facts(table.behaviour)
    if table.topics:
        lines += ["", *headed("name", "type", "", "rate", "frame")]
        lines += [_topic_line(row) for row in table.topics]
    return lines + parameter_lines(parameters.rows, "parameter")


def _topic_line(row: Topic) -> str:
    kind = row.kind + only_in(row.ros_versions)
    return f"| `{row.name}` | `{row.type}` | {kind} | {row.rate} | {row.frame} |"
