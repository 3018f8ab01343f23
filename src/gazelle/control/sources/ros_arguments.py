"""What ``--ros-args`` words say of one node, as ROS 2's controllers and plug-ins are given them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml

from gazelle.documents.yaml import load_yaml

__all__ = ["RosArguments", "read_ros_arguments"]

_REMAP_FLAGS = frozenset({"-r", "--remap"})
_FILE_FLAGS = frozenset({"--params-file"})
_VALUE_FLAGS = frozenset({"-p", "--param"})
_MARKS = frozenset({"--ros-args", "--"})


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
    flag = ""
    for word in (part for text in words for part in text.split()):
        if flag in _FILE_FLAGS:
            files.append(word)
        elif ":=" in word and flag in _VALUE_FLAGS:
            name, value = _rule(word)
            values[name] = _value(value)
        elif ":=" in word:
            rules.append(_rule(word))
        elif word in _REMAP_FLAGS | _FILE_FLAGS | _VALUE_FLAGS:
            flag = word
            continue
        elif word not in _MARKS:
            strange.append(word)
        flag = ""
    return RosArguments(tuple(rules), tuple(files), values, tuple(strange))


def _value(text: str) -> Any:
    try:
        return load_yaml(text) if text else ""
    except yaml.YAMLError:
        return text


def _rule(word: str) -> tuple[str, str]:
    name, _, value = word.partition(":=")
    return name.rpartition(":")[2], value
