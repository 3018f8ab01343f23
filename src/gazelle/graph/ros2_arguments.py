"""What ``--ros-args`` says to the nodes of a program: see `gazelle.ros_arguments`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.ros_arguments import (
    LOG_LEVEL,
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosToken,
    Rule,
    rule_of,
    split_arguments,
    unknown_word,
    value_of,
    yaml_value,
)

if TYPE_CHECKING:
    from gazelle.diagnostics import Diagnostic

__all__ = ["RosArguments", "parse_ros_arguments"]


@dataclass(slots=True)
class RosArguments:
    """What ROS takes from a program's arguments.

    Attributes:
        remaps: topics and services, and ``__node`` and ``__ns``.
        params: single parameters.
        files: parameter files.
        log_levels: by logger, "" for all.
        rest: the arguments that are not ROS's.
    """

    remaps: list[Rule] = field(default_factory=list)
    params: list[Rule] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)
    log_levels: dict[str, str] = field(default_factory=dict)
    rest: list[str] = field(default_factory=list)

    def node_name(self, name: str) -> str:
        """Return the node's name after ``__node:=``."""
        return self._special("__node", name) or self._special("__name", name) or name

    def namespace(self, node: str) -> str | None:
        """Return what ``__ns:=`` says for a node, None when nothing."""
        return self._special("__ns", node)

    def remappings(self, node: str) -> dict[str, str]:
        """Return the rules for topics and services of a node."""
        return {
            rule.name: rule.value
            for rule in self.remaps
            if rule.node in ("", node) and not rule.name.startswith("__")
        }

    def parameters(self, full_name: str) -> dict[str, Any]:
        """Return the values given for a node, names with dots; later ones count.

        Args:
            full_name: the node's global name.

        Raises:
            UserFileError: a parameter file has errors.
        """
        if not self.files and not self.params:
            return {}
        from gazelle.control.parameter_sources.ros2_parameter_file import read_parameters_of
        from gazelle.diagnostics import Diagnostics
        from gazelle.parameters.trees import flattened, values_only

        diagnostics = Diagnostics()
        values = read_parameters_of(full_name, self.files, diagnostics)
        diagnostics.raise_if_errors()
        _tell_once(diagnostics)
        base = full_name.rpartition("/")[2]
        for rule in self.params:
            if rule.node in ("", base, full_name):
                values.update(values_only(flattened({rule.name: yaml_value(rule.value)})))
        return values

    def _special(self, word: str, node: str) -> str | None:
        found = [r.value for r in self.remaps if r.name == word and r.node in ("", node)]
        return found[-1] if found else None


_told: set[Diagnostic] = set()


def _tell_once(found: Iterable[Diagnostic]) -> None:
    """Show what is odd in parameter files, once for all nodes of a process."""
    new = [one for one in found if one not in _told]
    _told.update(new)
    if new:
        from gazelle.diagnostics import render

        render(new)


def parse_ros_arguments(arguments: Sequence[str]) -> RosArguments:
    """Split a program's arguments; ROS's stand between ``--ros-args`` and ``--``.

    Raises:
        GraphError: one of ROS's arguments is not understood.
    """
    split = split_arguments(arguments)
    found = RosArguments(rest=split.own)
    try:
        for word in split.ros:
            _take(word, found)
    except RosArgumentError as error:
        raise GraphError(str(error)) from error
    return found


def _take(word: RosToken, found: RosArguments) -> None:
    if word.option == REMAP:
        found.remaps.append(rule_of(word))
    elif word.option == PARAM:
        found.params.append(rule_of(word))
    elif word.option == PARAMS_FILE:
        found.files.append(Path(value_of(word)))
    elif word.option == LOG_LEVEL:
        logger, separator, level = value_of(word).rpartition(":=")
        found.log_levels[logger if separator else ""] = level
    elif not word.option:
        raise unknown_word(word)
