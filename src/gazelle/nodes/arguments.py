"""What a node is told when it starts: names, remaps, private parameters, its own arguments."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from gazelle.graph.names import join, parse_command_line
from gazelle.nodes.ros2_arguments import file_params, split_words

__all__ = ["ABSENT_NODES", "NodeArguments", "read_arguments"]

_ROS2 = 2

ABSENT_NODES = "GAZELLE_ABSENT_NODES"
"""Variable with full names of nodes that the launch could not start."""


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
    ros2 = split_words(argv)
    line = parse_command_line(ros2.words)
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
