"""What a node is told when it starts: names, remaps, private parameters, its own arguments.

``--ros-args`` of a ROS 2 command line becomes what ROS 1's remapping arguments are.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from gazelle.errors import LaunchError
from gazelle.graph.names import join, parse_command_line
from gazelle.ros_arguments import (
    LOG_LEVEL,
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosToken,
    rule_of,
    split_arguments,
    unknown_word,
    value_of,
)

__all__ = [
    "ABSENT_NODES",
    "NodeArguments",
    "RosArgs",
    "file_params",
    "read_arguments",
    "split_ros_args",
]


_LEVELS = ("debug", "info", "warn", "error", "fatal")
_ROS2 = 2

ABSENT_NODES = "GAZELLE_ABSENT_NODES"
"""Variable with full names of nodes that the launch could not start."""


class RosArgs:
    """What a command line came to.

    Attributes:
        rest: rules as ROS 1 has them (``a:=b``, ``__node:=n`` as ``__name:=n``, ``_p:=1``), and
            the program's own words.
        parameter_files: of ``--params-file``.
        log_level: of ``--log-level``, empty when not given.
        found: whether there was a ``--ros-args``.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        self.rest: list[str] = []
        self.parameter_files: list[Path] = []
        self.log_level = ""
        self.found = False


def split_ros_args(argv: Sequence[str]) -> RosArgs:
    """Translate the part from ``--ros-args`` to ``--``; everything else stays as it is.

    Raises:
        LaunchError: one of ROS's arguments is not understood.
    """
    split = split_arguments(argv)
    result = RosArgs()
    result.rest, result.found = split.own, split.is_ros2
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


def _take(word: RosToken, result: RosArgs) -> None:
    """Add what a word comes to; a node's name before a rule is for nodes of other names too."""
    if word.option == REMAP:
        _, name, value = rule_of(word)
        result.rest.append(f"{'__name' if name == '__node' else name}:={value}")
    elif word.option == PARAM:
        _, name, value = rule_of(word)
        result.rest.append(f"_{_slashed(name)}:={value}")
    elif word.option == PARAMS_FILE:
        result.parameter_files.append(Path(value_of(word)))
    elif word.option == LOG_LEVEL:
        result.log_level = _level(value_of(word))
    elif not word.option:
        # Launch files add their rules after the section, as ROS 1's words.
        if ":=" not in word.written:
            raise unknown_word(word)
        result.rest.append(word.written)


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


def _nobody_waits() -> None:
    """Nobody waits for this node."""


@dataclass(frozen=True, slots=True)
class NodeArguments:
    """Arguments of one node.

    Attributes:
        name: node name without namespace.
        namespace: absolute namespace.
        remappings: as written, from → to.
        params: private parameters of the command line (``_rate:=5``).
        rest: the node's own arguments.
        output: ``screen``, or ``log`` for warnings and errors only on the terminal.
        log_file: where the node's log goes (``__log:=``), empty for nowhere.
        ready: called by a node that stays, once it has done what others may wait for.
        log_level: least level that is logged (``--log-level``), empty for the default.
        has_ros_args: the command line was ROS 2's, with ``--ros-args``.
        parameter_files: of ``--params-file``; they may have parameters of other nodes too.
        executable: the name that the node was started by, empty where nobody says.
    """

    name: str
    namespace: str = "/"
    remappings: Mapping[str, str] = field(default_factory=dict)
    params: Mapping[str, Any] = field(default_factory=dict)
    rest: tuple[str, ...] = ()
    output: str = "screen"
    log_file: str = ""
    ready: Callable[[], None] = _nobody_waits
    log_level: str = ""
    has_ros_args: bool = False
    parameter_files: tuple[Path, ...] = ()
    executable: str = ""

    @property
    def ros_version(self) -> Literal[1, 2]:
        """The generation of ROS that whoever started the node speaks."""
        return 2 if self.started_by == _ROS2 else 1

    @property
    def started_by(self) -> int:
        """The version of ROS of the launch file or command behind the node, 0 for none."""
        if self.has_ros_args:
            return _ROS2
        word = os.environ.get("ROS_VERSION", "").strip()
        return int(word) if word in ("1", "2") else 0


def read_arguments(
    argv: Sequence[str],
    default_name: str,
    *,
    namespace: str = "/",
    output: str = "screen",
    ready: Callable[[], None] = _nobody_waits,
) -> NodeArguments:
    """Split a node's words into ROS's and its own (wiki: Remapping Arguments).

    Raises:
        LaunchError: an argument after ``--ros-args`` is not understood.
        UserFileError: a parameter file has errors.
    """
    ros2 = split_ros_args(argv)
    line = parse_command_line(ros2.rest)
    name, space = line.name or default_name, line.namespace or namespace or "/"
    return NodeArguments(
        name=name,
        namespace=space,
        remappings=dict(line.remappings),
        params={**file_params(ros2.parameter_files, join(space, name)), **line.params},
        rest=tuple(line.rest),
        output=output,
        log_file=line.special.get("__log", ""),
        ready=ready,
        log_level=ros2.log_level,
        has_ros_args=ros2.found,
        parameter_files=tuple(ros2.parameter_files),
    )
