"""``--ros-args`` of a ROS 2 command line, in the words of ROS 1 that built-in nodes read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError

__all__ = ["Ros2Words", "file_params", "split_words"]

_IGNORED_WITH_VALUE = frozenset({"--log-config-file", "--log-file-name", "-e", "--enclave"})

_LEVELS = ("debug", "info", "warn", "error", "fatal")


class Ros2Words:
    """What a command line came to.

    Attributes:
        words: rules as ROS 1 has them (``a:=b``, ``__node:=n`` as ``__name:=n``, ``_p:=1``), and
            the program's own words.
        parameter_files: of ``--params-file``.
        log_level: of ``--log-level``, empty when not given.
        found: whether there was a ``--ros-args``.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        self.words: list[str] = []
        self.parameter_files: list[Path] = []
        self.log_level = ""
        self.found = False


def split_words(argv: Sequence[str]) -> Ros2Words:
    """Translate the part from ``--ros-args`` to ``--``; everything else stays as it is.

    Raises:
        LaunchError: one of ROS's arguments is not understood.
    """
    result, words = Ros2Words(), iter(argv)
    for word in words:
        if word == "--ros-args":
            result.found = True
            _section(words, result)
        else:
            result.words.append(word)
    return result


def file_params(files: Sequence[Path], full_name: str) -> dict[str, Any]:
    """Return what parameter files say for a node; parts of a name are joined with ``/``.

    Raises:
        UserFileError: a file has errors.
    """
    if not files:
        return {}
    from gazelle.control.sources.yaml_file import read_parameter_file
    from gazelle.diagnostics import Diagnostics

    diagnostics, found = Diagnostics(), {}
    for file in files:
        for section in read_parameter_file(file, diagnostics):
            if section.matches(full_name):
                found.update(_flat("", section.values))
    diagnostics.raise_if_errors()
    return found


def _section(words: Iterator[str], result: Ros2Words) -> None:
    for word in words:
        if word == "--":
            return
        if word == "--ros-args":
            # Launch files begin a section in the one that they were given.
            continue
        if word in {"-r", "--remap"}:
            result.words.append(_remap(_value(words, word)))
        elif word in {"-p", "--param"}:
            name, value = _rule(_value(words, word), word)
            result.words.append(f"_{_slashed(name)}:={value}")
        elif word == "--params-file":
            result.parameter_files.append(Path(_value(words, word)))
        elif word == "--log-level":
            result.log_level = _level(_value(words, word))
        elif word in _IGNORED_WITH_VALUE:
            _value(words, word)
        elif not word.startswith(("--enable-", "--disable-")):
            # launch files add their rules after the section, as ROS 1's words.
            result.words.append(_unknown_unless_rule(word))


def _level(text: str) -> str:
    """Return the level of ``level`` or ``logger:=level``; all loggers here are the node's."""
    word = text.rpartition(":=")[2].lower()
    if word not in _LEVELS:
        raise LaunchError(
            f"'{text}' after --log-level is no level; there are {', '.join(_LEVELS)}\n"
            f"  ROS says: Couldn't parse log level rule: '--log-level {text}'"
        )
    return word


def _remap(text: str) -> str:
    name, value = _rule(text, "-r")
    return f"{'__name' if name == '__node' else name}:={value}"


def _rule(text: str, option: str) -> tuple[str, str]:
    """Return both sides of a rule; a node's name before them is for nodes of other names too."""
    left, separator, value = text.partition(":=")
    name = left.rpartition(":")[2]
    if not separator or not name:
        raise LaunchError(
            f"'{text}' after {option} is no rule\n  fix: write name:=value\n"
            f"  ROS says: Couldn't parse {option} rule: '{option} {text}'"
        )
    return name, value


def _value(words: Iterator[str], option: str) -> str:
    for word in words:
        return word
    raise LaunchError(f"{option} has no value after it\n  ROS says: Failed to parse {option} rule")


def _unknown_unless_rule(word: str) -> str:
    if ":=" in word:
        return word
    raise LaunchError(
        f"'{word}' after --ros-args is not known; put -- before arguments of your own\n"
        f"  ROS says: Found unknown ROS arguments: ['{word}']"
    )


def _flat(name: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, Mapping):
        return {name: value}
    return {
        key: one
        for sub, item in value.items()
        for key, one in _flat(_below(name, str(sub)), item).items()
    }


def _below(name: str, sub: str) -> str:
    """Files may write ``a.b: 1`` for ``a: {b: 1}``, as launch files do."""
    return _slashed(f"{name}/{sub}" if name else sub)


def _slashed(name: str) -> str:
    """Return a name in the form of ROS 1; topics in it, such as those of qos_overrides, have /."""
    return re.sub("/{2,}", "/", name.replace(".", "/"))
