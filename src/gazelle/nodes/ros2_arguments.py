"""``--ros-args`` of a ROS 2 command line, in the words of ROS 1 that built-in nodes read."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError
from gazelle.ros_arguments import (
    LOG_LEVEL,
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosWord,
    rule_of,
    split_arguments,
    unknown_word,
    value_of,
)

__all__ = ["Ros2Words", "file_params", "split_words"]

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
    split = split_arguments(argv)
    result = Ros2Words()
    result.words, result.found = split.own, split.is_ros2
    try:
        for word in split.ros:
            _take(word, result)
    except RosArgumentError as error:
        raise LaunchError(str(error)) from error
    return result


def file_params(files: Sequence[Path], full_name: str) -> dict[str, Any]:
    """Return what parameter files say for a node; parts of a name are joined with ``/``.

    Raises:
        UserFileError: a file has errors.
    """
    if not files:
        return {}
    from gazelle.control.parameter_sources.ros2_parameter_file import read_parameters_of
    from gazelle.diagnostics import Diagnostics

    diagnostics = Diagnostics()
    found = read_parameters_of(full_name, files, diagnostics)
    diagnostics.raise_if_errors()
    return {_slashed(name): value for name, value in found.items()}


def _take(word: RosWord, result: Ros2Words) -> None:
    """Add what a word comes to; a node's name before a rule is for nodes of other names too."""
    if word.option == REMAP:
        _, name, value = rule_of(word)
        result.words.append(f"{'__name' if name == '__node' else name}:={value}")
    elif word.option == PARAM:
        _, name, value = rule_of(word)
        result.words.append(f"_{_slashed(name)}:={value}")
    elif word.option == PARAMS_FILE:
        result.parameter_files.append(Path(value_of(word)))
    elif word.option == LOG_LEVEL:
        result.log_level = _level(value_of(word))
    elif not word.option:
        # Launch files add their rules after the section, as ROS 1's words.
        if ":=" not in word.written:
            raise unknown_word(word)
        result.words.append(word.written)


def _level(text: str) -> str:
    """Return the level of ``level`` or ``logger:=level``; all loggers here are the node's."""
    word = text.rpartition(":=")[2].lower()
    if word not in _LEVELS:
        raise LaunchError(
            f"'{text}' after --log-level is no level; there are {', '.join(_LEVELS)}\n"
            f"  ROS says: Couldn't parse log level rule: '--log-level {text}'"
        )
    return word


def _slashed(name: str) -> str:
    """Return a name in the form of ROS 1; topics in it, such as those of qos_overrides, have /."""
    return re.sub("/{2,}", "/", name.replace(".", "/"))
