"""``--ros-args`` of a ROS 2 program (https://design.ros2.org/articles/ros_command_line_arguments.html)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.errors import GraphError

if TYPE_CHECKING:
    from gazelle.diagnostics import Diagnostic

__all__ = ["RosArguments", "parse_ros_arguments"]


_TOLD: set[Diagnostic] = set()


class _Rule(NamedTuple):
    """A remapping or parameter, for one node (by name) or all."""

    node: str
    name: str
    value: Any


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

    remaps: list[_Rule] = field(default_factory=list)
    params: list[_Rule] = field(default_factory=list)
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
        values: dict[str, Any] = {}
        if self.files:
            from gazelle.control.sources.yaml_file import read_parameter_file
            from gazelle.diagnostics import Diagnostics

            diagnostics = Diagnostics()
            for file in self.files:
                for section in read_parameter_file(file, diagnostics):
                    if section.matches(full_name):
                        values.update(_flat("", section.values))
            diagnostics.raise_if_errors()
            _tell_once(diagnostics)
        base = full_name.rpartition("/")[2]
        for rule in self.params:
            if rule.node in ("", base, full_name):
                values.update(_flat(rule.name, rule.value))
        return values

    def _special(self, word: str, node: str) -> str | None:
        found = [r.value for r in self.remaps if r.name == word and r.node in ("", node)]
        return str(found[-1]) if found else None


def _tell_once(found: Iterable[Diagnostic]) -> None:
    """Show what is odd in parameter files, once for all nodes of a process."""
    new = [one for one in found if one not in _TOLD]
    if new:
        from gazelle.diagnostics import render

        _TOLD.update(new)
        render(new)


def parse_ros_arguments(arguments: Sequence[str]) -> RosArguments:
    """Split a program's arguments; ROS's stand between ``--ros-args`` and ``--``.

    Raises:
        GraphError: one of ROS's arguments is not understood.
    """
    found = RosArguments()
    words = iter(arguments)
    for word in words:
        if word == "--ros-args":
            _parse_section(words, found)
        else:
            found.rest.append(word)
    return found


def _parse_section(words: Iterable[str], found: RosArguments) -> None:
    words = iter(words)
    for word in words:
        if word == "--":
            return
        if word == "--ros-args":
            # Launch files begin a section in the one that they were given.
            continue
        if word in ("-r", "--remap"):
            found.remaps.append(_rule(_value(words, word), word))
        elif word in ("-p", "--param"):
            rule = _rule(_value(words, word), word)
            found.params.append(rule._replace(value=_yaml(rule.value)))
        elif word == "--params-file":
            found.files.append(Path(_value(words, word)))
        elif word == "--log-level":
            logger, separator, level = _value(words, word).rpartition(":=")
            found.log_levels[logger if separator else ""] = level
        elif word in ("--log-config-file", "-e", "--enclave"):
            _value(words, word)
        elif not word.startswith(("--enable-", "--disable-", "--log-file-name")):
            raise _unknown(word)


def _value(words: Any, option: str) -> str:
    for word in words:
        return str(word)
    raise GraphError(f"{option} has no value after it\n  ROS says: Failed to parse {option} rule")


def _rule(text: str, option: str) -> _Rule:
    left, separator, value = text.partition(":=")
    if not separator or not left:
        raise GraphError(
            f"'{text}' after {option} is no rule\n  fix: write name:=value\n"
            f"  ROS says: Couldn't parse {option} rule: '{option} {text}'"
        )
    node, colon, name = left.partition(":")
    if colon and left.startswith(("rostopic://", "rosservice://")):
        node, name = "", left.partition("://")[2]
    elif not colon:
        node, name = "", left
    return _Rule(node, name, value)


def _yaml(text: str) -> Any:
    # Most nodes are given no values.
    import yaml

    from gazelle.documents.yaml import load_yaml

    try:
        return load_yaml(text)
    except yaml.YAMLError:
        return text


def _flat(name: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, Mapping):
        return {name: value}
    return {
        key: one
        for sub, item in value.items()
        for key, one in _flat(f"{name}.{sub}" if name else str(sub), item).items()
    }


def _unknown(word: str) -> GraphError:
    from gazelle.diagnostics import did_you_mean

    known = ("--remap", "--param", "--params-file", "--log-level", "--enclave")
    hint = did_you_mean(word, known)
    return GraphError(
        f"'{word}' after --ros-args is not known; {hint or 'put -- before arguments of your own'}\n"
        f"  ROS says: Found unknown ROS arguments: ['{word}']"
    )
