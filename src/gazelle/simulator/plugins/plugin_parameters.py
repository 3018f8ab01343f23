"""Parameters of a ``<plugin>`` element: a plug-in's table, and the reader that goes by it.

The reader takes its defaults from the table and reports keys that nobody asked for, and
`docs/plugins.md` is generated from it, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.control.parameter_sources.ros2_controller_parameters import read_ros_arguments
from gazelle.description.model import PluginTag
from gazelle.description.xml import Tag
from gazelle.description.xml.numbers import bool_from, floats_from
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.parameters.markdown import facts, headed, in_code, parameter_lines
from gazelle.parameters.reader import MISSING, ParameterOwner, ParameterReader

__all__ = ["PluginReader", "PluginTable", "RosBlock", "TagSource", "tables_as_markdown"]


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


_ROS_WORDS = ("namespace", "remapping", "argument", "parameter")
_ROS2 = 2


@dataclass(frozen=True, slots=True)
class RosBlock:
    """The ``<ros>`` element of a ROS 2 plug-in.

    Attributes:
        namespace: absolute namespace, empty when the element is absent.
        remappings: names to use instead, by name as the plug-in knows it.
        parameter_files: of ``--params-file`` among the ``<argument>`` elements.
        present: False when there is no ``<ros>`` element.
    """

    namespace: str = ""
    remappings: tuple[tuple[str, str], ...] = ()
    present: bool = False
    parameter_files: tuple[str, ...] = ()

    def remapped(self, name: str) -> str:
        """Return the name to use for a topic of the plug-in."""
        wanted = name.removeprefix("~/")
        for source, target in self.remappings:
            if source.removeprefix("~/") == wanted:
                return target
        return name


class TagSource:
    """The elements of a ``<plugin>`` as a source: of a name the text of its first one."""

    def __init__(self, tag: Tag) -> None:
        self.tag = tag

    def find(self, name: str) -> Any:
        """Return the text of the first element of a name, `MISSING` when there is none."""
        found = self.tag.find(name)
        return MISSING if found is None else found.text

    def leaves(self) -> Iterable[tuple[str, Any]]:
        """Return the texts of all elements, in their order."""
        return ((child.name, child.text) for child in self.tag.children)

    def full_name(self, name: str) -> str:
        """Return an element as it is written."""
        return f"<{name}>"

    def span(self, name: str) -> SourceSpan | None:
        """Return where the first element of a name stands."""
        found = self.tag.find(name)
        return None if found is None else found.span


class PluginReader(ParameterReader):
    """Typed access to a plug-in's keys, defaults from its table.

    Args:
        plugin: the ``<plugin>`` element.
        table: known keys with defaults and other spellings.
        diagnostics: receives bad numbers and, from `report_unread`, unknown keys.
        ros_version: of what started the simulator, 0 when it is not known.

    Attributes:
        ros: the ``<ros>`` element; an empty one where the plug-in is ROS 1's.
    """

    def __init__(
        self,
        plugin: PluginTag,
        table: PluginTable,
        diagnostics: Diagnostics,
        ros_version: int = 0,
    ) -> None:
        owner = ParameterOwner(plugin.name, f"plug-in '{plugin.name}'")
        source = TagSource(plugin.parameters)
        version = ros_version if table.in_both_ros else 0
        super().__init__(table.parameters, source, owner, diagnostics, ros_version=version)
        self.plugin = plugin
        self._read: set[str] = set()
        self.ros = RosBlock()
        if version != 1:
            self._read.add("ros")
            self.ros = _read_ros_block(plugin.parameters.find("ros"), diagnostics)

    def is_ros2(self, *marks: str) -> bool:
        """Tell whether this is ROS 2's plug-in.

        Args:
            marks: keys that only ROS 2 has; they count, as ``<ros>`` does, where nothing else
                tells.
        """
        if self.ros_version:
            return self.ros_version == _ROS2
        return self.ros.present or any(self.has(mark) for mark in marks)

    def knows(self, key: str) -> bool:
        """Tell whether the plug-in has such a key at all."""
        return self._known_row(key) is not None

    def tag(self, key: str) -> Tag | None:
        """Return the first element of a key, None when it is absent."""
        found = map(self.plugin.parameters.find, self.spellings(key))
        return next((tag for tag in found if tag is not None), None)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return the texts of all elements of a key."""
        names = self.spellings(key)
        return tuple(tag.text for tag in self.plugin.parameters.children if tag.name in names)

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text, that of the table for an empty one; `default` in place of the table's."""
        return self.raw(key) or str(self.default(key, default, ""))

    def flag(self, key: str, default: bool | None = None) -> bool:
        """Return a truth value."""
        return bool_from(self.tag(key), bool(self.default(key, default, False)), self.diagnostics)

    def number(self, key: str, default: float | None = None) -> float:
        """Return a number; `default` instead of the table's when given."""
        return self._floats(self.tag(key), (float(self.default(key, default, 0.0)),))[0]

    def numbers(self, key: str) -> tuple[float, ...]:
        """Return the numbers of all elements of a key, in their order."""
        default = self.default_number(key)
        names = self.spellings(key)
        tags = (tag for tag in self.plugin.parameters.children if tag.name in names)
        return tuple(self._floats(tag, (default,))[0] for tag in tags)

    def default_number(self, key: str) -> float:
        """Return what the table has for a key."""
        return float(self.default(key, None, 0.0))

    def vector(self, key: str) -> tuple[float, float, float]:
        """Return three numbers."""
        x, y, z = self._floats(self.tag(key), self.default(key, None, (0.0, 0.0, 0.0)))
        return (x, y, z)

    def spellings(self, key: str) -> tuple[str, ...]:
        """Return the names that count for a key of the table, which has been read by that.

        Raises:
            KeyError: the table has no such key.
        """
        self.table.row(key)
        names = super().spellings(key)
        self._read.update(names)
        return names

    def default(self, key: str, default: Any, otherwise: Any) -> Any:
        """Return the value of an absent key, which has been read by that."""
        self.spellings(key)
        return super().default(key, default, otherwise)

    def report_unread(self) -> None:
        """Report the keys that have no effect and, one by one, those that are not known."""
        known = [name for row in self.table.rows for name in row.names]
        idle = []
        if self.ros.parameter_files and self._known_row("parameters") is None:
            idle += [f"--params-file {name}" for name in self.ros.parameter_files]
        for tag in self.plugin.parameters.children:
            row = self._known_row(tag.name)
            if row is None:
                self._report_unknown_tag(tag, known)
            elif row.is_refused:
                idle.append(f"<{tag.name}> ({row.meaning})")
            elif tag.name not in self._read:
                idle.append(f"<{tag.name}>{self._instead_of(row, tag.name)}")
        if idle:
            text = f"plug-in '{self.plugin.name}': these keys change nothing: {', '.join(idle)}"
            self.diagnostics.report("parameter.idle", text, self.plugin.span)

    def _report_unknown_tag(self, tag: Tag, known: list[str]) -> None:
        hint = did_you_mean(tag.name, known)
        text = f"plug-in '{self.plugin.name}' ({self.plugin.filename}) has no key <{tag.name}>"
        text += "; it has no effect"
        self.diagnostics.report("parameter.unknown", text, tag.span, fix=hint)

    def _known_row(self, name: str) -> Parameter | None:
        if name == "ros":
            return Parameter("ros", "group", None, "", ros_versions=(_ROS2,))
        return self.table.exact_row(name)

    def _instead_of(self, row: Parameter, name: str) -> str:
        """Say whose key one is that the plug-in of this version does not read."""
        names = row.spellings(self.ros_version)
        if not self.ros_version or name in names:
            return ""
        other = 1 if self.ros_version == _ROS2 else _ROS2
        read = f", ROS {self.ros_version} reads <{names[0]}>" if names else ""
        return f" (of ROS {other}{read})"

    def _floats(self, tag: Tag | None, default: tuple[float, ...]) -> tuple[float, ...]:
        if tag is None or not tag.text:
            return default
        return floats_from(
            tag.text,
            len(default),
            default,
            what=f"<{tag.name}>",
            span=tag.span,
            diagnostics=self.diagnostics,
        )


def _read_ros_block(tag: Tag | None, diagnostics: Diagnostics) -> RosBlock:
    if tag is None:
        return RosBlock()
    found = read_ros_arguments(child.text for child in tag.find_all("argument"))
    for child in tag.children:
        if child.name not in _ROS_WORDS:
            text = f"<ros> has no element <{child.name}>; it has no effect"
            hint = did_you_mean(child.name, _ROS_WORDS)
            diagnostics.report("parameter.unknown", text, child.span, fix=hint)
    for word in (*(f"-p {name}" for name in found.values), *found.strange):
        text = f"argument '{word}' of <ros> has no effect"
        diagnostics.report("parameter.unknown", text, tag.span)
    pairs = [child.text.partition(":=")[::2] for child in tag.find_all("remapping")]
    rules = tuple((source.strip(), target.strip()) for source, target in pairs)
    namespace = tag.text_of("namespace")
    return RosBlock(namespace, (*rules, *found.remappings), True, found.files)
