"""Tables that describe a plug-in: its parameters, topics and services.

The reader of parameters takes its defaults from them, and `docs/plugins.md` is generated from
them, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

__all__ = ["Parameter", "PluginTable", "Service", "Topic", "tables_as_markdown"]

_ROS2 = 2


@dataclass(frozen=True, slots=True)
class Parameter:
    """One key of a ``<plugin>`` element.

    Attributes:
        key: element name.
        kind: ``text``, ``flag``, ``number``, ``vector`` or ``none`` for a key without effect.
        default: value when the key is absent.
        unit: SI unit, empty for none.
        meaning: what it does; for kind ``none`` why it does nothing.
        aliases: other spellings of the same key, such as the ROS 2 name.
        only: the one version of ROS whose plug-in reads the key, 0 for both.
        ros2_default: what the plug-in of ROS 2 takes for an absent key, where that differs.
    """

    key: str
    kind: str
    default: object
    meaning: str
    unit: str = ""
    aliases: tuple[str, ...] = ()
    only: int = 0
    ros2_default: object | None = None

    def spellings(self, ros_version: int) -> tuple[str, ...]:
        """Return the names that count under a version of ROS, 0 for any.

        ROS 1's plug-ins write camelCase and ROS 2's snake_case; a key that is spelled in one way
        only is spelled so in both.
        """
        names = (self.key, *self.aliases)
        if not ros_version:
            return names
        if self.only and self.only != ros_version:
            return ()
        own = tuple(name for name in names if _is_written_in(name, ros_version))
        return own or names

    def default_in(self, ros_version: int) -> object:
        """Return the value of an absent key under a version of ROS."""
        if ros_version == _ROS2 and self.ros2_default is not None:
            return self.ros2_default
        return self.default


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic a plug-in publishes or listens to.

    Attributes:
        topic: name as a pattern; words in braces are keys of the plug-in.
        ros2: the name in ROS 2, where that is another; ``-`` for none.
        type: ROS type, ROS 2 spelling.
        rate: how often, in words.
        frame: ``header.frame_id``, in words; empty for none.
        publishes: False for a subscription.
    """

    topic: str
    type: str
    rate: str
    frame: str = ""
    publishes: bool = True
    ros2: str = ""


@dataclass(frozen=True, slots=True)
class Service:
    """A service a plug-in offers."""

    name: str
    type: str


@dataclass(frozen=True, slots=True)
class PluginTable:
    """Everything the documentation says about one family of plug-ins.

    Attributes:
        family: short name.
        summary: what it does, one or two sentences.
        filenames: libraries and system names that mean this family, without ``lib`` and ``.so``.
        behaviour: facts of behaviour, one sentence each, with their source.
        in_both_ros: ROS 1 and ROS 2 have a plug-in of this name, with other keys, names and
            defaults; what started the simulator decides between them.
    """

    family: str
    summary: str
    filenames: tuple[str, ...]
    parameters: tuple[Parameter, ...] = ()
    topics: tuple[Topic, ...] = ()
    services: tuple[Service, ...] = ()
    behaviour: tuple[str, ...] = ()
    in_both_ros: bool = False
    _by_key: dict[str, Parameter] = field(default_factory=dict, repr=False, compare=False)

    def parameter(self, key: str) -> Parameter:
        """Return the row of a key or of one of its other spellings.

        Raises:
            KeyError: the table has no such key.
        """
        if not self._by_key:
            for row in self.parameters:
                for name in (row.key, *row.aliases):
                    self._by_key[name] = row
        return self._by_key[key]


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
    lines = [f"## {table.family}", "", table.summary, ""]
    lines.append("Names: " + ", ".join(f"`{name}`" for name in table.filenames))
    if table.behaviour:
        lines += ["", *(f"- {fact}" for fact in table.behaviour)]
    if table.topics:
        lines += ["", "| topic | type | rate | frame |", "| --- | --- | --- | --- |"]
        lines += [_topic_line(row) for row in table.topics]
    if table.services:
        lines += ["", "| service | type |", "| --- | --- |"]
        lines += [f"| `{row.name}` | `{row.type}` |" for row in table.services]
    if table.parameters:
        lines += ["", "| key | other names | default | unit | meaning |"]
        lines += ["| --- | --- | --- | --- | --- |"]
        lines += [_parameter_line(row) for row in table.parameters]
    return lines


def _topic_line(row: Topic) -> str:
    way = "" if row.publishes else " (listens)"
    if row.ros2:
        way += ", in ROS 2 " + ("none" if row.ros2 == "-" else f"`{row.ros2}`")
    return f"| `{row.topic}`{way} | `{row.type}` | {row.rate} | {row.frame} |"


def _parameter_line(row: Parameter) -> str:
    aliases = ", ".join(f"`{name}`" for name in row.aliases)
    default = "" if row.kind == "none" else f"`{row.default}`"
    if row.ros2_default is not None:
        default += f", in ROS 2 `{row.ros2_default}`"
    mark = f" (ROS {row.only})"
    meaning = row.meaning if not row.only or mark in row.meaning else row.meaning + mark
    return f"| `{row.key}` | {aliases} | {default} | {row.unit} | {meaning} |"


def _is_written_in(name: str, ros_version: int) -> bool:
    if ros_version == _ROS2:
        return name == name.lower()
    return "_" not in name
