"""Tables that describe a plug-in: its parameters, topics and services.

The reader of parameters takes its defaults from them, and `docs/plugins.md` is generated from
them, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gazelle.parameters import ParameterTable, Topic
from gazelle.parameters.markdown import facts, headed, in_code, parameter_lines

__all__ = ["PluginTable", "tables_as_markdown"]

_ROS1 = (1,)


@dataclass(frozen=True, slots=True)
class PluginTable:
    """Everything the documentation says about one family of plug-ins.

    Attributes:
        parameters: family, summary and a row for each key of ``<plugin>``; types are libraries and
            system names that mean this family, without ``lib`` and ``.so``.
        topics: what it publishes and listens to; ROS types in ROS 2's spelling.
        services: what it offers.
        behaviour: facts of behaviour, one sentence each, with their source.
        in_both_ros: ROS 1 and ROS 2 have a plug-in of this name, with other keys, names and
            defaults; what started the simulator decides between them.
    """

    parameters: ParameterTable
    topics: tuple[Topic, ...] = ()
    services: tuple[Topic, ...] = ()
    behaviour: tuple[str, ...] = ()
    in_both_ros: bool = False


def tables_as_markdown(tables: Sequence[PluginTable]) -> str:
    """Return the page ``docs/plugins.md``."""
    parts = [
        "# Plug-ins",
        "",
        "Generated from the tables of `gazelle.simulator.plugins`; do not edit. A plug-in is known"
        " by its library's or system's name with or without `lib`, `.so` and gz-sim's release, such"
        " as the 7 of `gz-sim7-…`. Rates are of simulated time. Keys that are not listed are"
        " reported, never ignored in silence.",
        "",
        "Where a plug-in exists in ROS 1 and in ROS 2, what started the simulator decides between"
        " their names, keys, defaults and frames: `roslaunch` and `rosrun` mean ROS 1, `ros2"
        " launch`, `ros2 run`, `-s libgazebo_ros_init.so` and `-s libgazebo_ros_factory.so` mean"
        " ROS 2. Keys of the other one change nothing then, as in Gazebo. Where nothing says it"
        " (`gzserver` in a bare shell, the Python API), a plug-in with `<ros>` is ROS 2's.",
    ]
    for table in tables:
        parts += ["", *_section(table)]
    return "\n".join(parts) + "\n"


def _section(table: PluginTable) -> list[str]:
    parameters = table.parameters
    lines = [f"## {parameters.family}", "", parameters.summary, ""]
    lines += [f"Names: {in_code(parameters.types)}", *facts(table.behaviour)]
    if table.topics:
        lines += ["", *headed("topic", "type", "rate", "frame"), *map(_topic_line, table.topics)]
    if table.services:
        lines += ["", *headed("service", "type")]
        lines += [f"| `{row.name}` | `{row.type}` |" for row in table.services]
    return lines + parameter_lines(parameters.rows, "key")


def _topic_line(row: Topic) -> str:
    way = "" if row.kind == "publishes" else " (listens)"
    if row.ros2 or row.ros_versions == _ROS1:
        way += ", in ROS 2 " + (f"`{row.ros2}`" if row.ros2 else "none")
    return f"| `{row.name}`{way} | `{row.type}` | {row.rate} | {row.frame} |"
