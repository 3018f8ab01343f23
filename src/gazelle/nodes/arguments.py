"""What a node is told when it starts: names, remaps, private parameters, its own arguments."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from gazelle.graph.names import parse_command_line

__all__ = ["NodeArguments", "read_arguments"]


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
    """

    name: str
    namespace: str = "/"
    remappings: Mapping[str, str] = field(default_factory=dict)
    params: Mapping[str, Any] = field(default_factory=dict)
    rest: tuple[str, ...] = ()
    output: str = "screen"
    log_file: str = ""
    ready: Callable[[], None] = _nobody_waits


def read_arguments(
    argv: Sequence[str],
    default_name: str,
    *,
    namespace: str = "/",
    output: str = "screen",
    ready: Callable[[], None] = _nobody_waits,
) -> NodeArguments:
    """Split a node's words into ROS's and its own (wiki: Remapping Arguments)."""
    line = parse_command_line(argv)
    return NodeArguments(
        name=line.name or default_name,
        namespace=line.namespace or namespace or "/",
        remappings=dict(line.remappings),
        params=dict(line.params),
        rest=tuple(line.rest),
        output=output,
        log_file=line.special.get("__log", ""),
        ready=ready,
    )
