"""Tables that describe a plug-in: its parameters, topics and services.

The reader of parameters takes its defaults from them, and `docs/plugins.md` is generated from
them, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

__all__ = ["Parameter", "PluginTable", "Service", "Topic", "tables_as_markdown"]


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
    """

    key: str
    kind: str
    default: object
    meaning: str
    unit: str = ""
    aliases: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic a plug-in publishes or listens to.

    Attributes:
        topic: name as a pattern; words in braces are keys of the plug-in.
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
    """

    family: str
    summary: str
    filenames: tuple[str, ...]
    parameters: tuple[Parameter, ...] = ()
    topics: tuple[Topic, ...] = ()
    services: tuple[Service, ...] = ()
    behaviour: tuple[str, ...] = ()
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
    return f"| `{row.topic}`{way} | `{row.type}` | {row.rate} | {row.frame} |"


def _parameter_line(row: Parameter) -> str:
    aliases = ", ".join(f"`{name}`" for name in row.aliases)
    default = "" if row.kind == "none" else f"`{row.default}`"
    return f"| `{row.key}` | {aliases} | {default} | {row.unit} | {row.meaning} |"
