"""What ``--ros-args`` words say of one node, as ROS 2's controllers and plug-ins are given them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.ros_arguments import (
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosWord,
    read_words,
    rule_of,
    yaml_value,
)

__all__ = ["RosArguments", "read_ros_arguments"]

_END = "--"


@dataclass(frozen=True, slots=True)
class RosArguments:
    """Rules, files and values of one node.

    Attributes:
        remappings: names to use instead, in order.
        files: of ``--params-file``.
        values: of ``-p``, by the parameter's name with dots.
        strange: words that are none of these.
    """

    remappings: tuple[tuple[str, str], ...] = ()
    files: tuple[str, ...] = ()
    values: Mapping[str, Any] = field(default_factory=dict)
    strange: tuple[str, ...] = ()


def read_ros_arguments(words: Iterable[str]) -> RosArguments:
    """Read the words of a node's command line; each may hold several, parted by spaces.

    A rule without ``-r`` before it counts as one, and ``node:`` before a rule's name is left out.
    """
    rules: list[tuple[str, str]] = []
    files: list[str] = []
    values: dict[str, Any] = {}
    strange: list[str] = []
    parts = (part for text in words for part in text.split() if part != _END)
    for word in read_words(parts):
        found = word if word.option else RosWord(REMAP, word.written, "")
        if found.option == PARAMS_FILE and found.value is not None:
            files.append(found.value)
            continue
        try:
            _, name, value = rule_of(found)
        except RosArgumentError:
            name = ""
        if found.option == REMAP and name:
            rules.append((name, value))
        elif found.option == PARAM and name:
            values[name] = yaml_value(value) if value else ""
        else:
            strange += [part for part in (found.written, found.value) if part]
    return RosArguments(tuple(rules), tuple(files), values, tuple(strange))
