"""Nodes and processes (roslaunch.core, roslaunch.pmon)."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any
from xml.sax.saxutils import quoteattr

from gazelle.errors import GraphError
from gazelle.graph import Entity, Graph, Kind

__all__ = [
    "DEFAULT_MASTER_PORT",
    "Node",
    "Process",
    "ProcessListener",
    "RLException",
    "start_launch",
]

DEFAULT_MASTER_PORT = 11311
_ROSOUT = "/rosout"
_START_S = 10.0
_PAUSE_S = 0.2
_AFTER_LAUNCH_S = 5.0  # the launch itself gives its nodes their time first


class RLException(Exception):  # noqa: N818 - roslaunch's name
    """A launch cannot be read or started."""


@dataclass(slots=True)
class Node:
    """What to launch, as the attributes of a ``<node>``.

    Attributes:
        package: where the executable is.
        node_type: the executable.
        name: the type without its ending when None.
        namespace: where the node lives.
        machine_name: accepted; nodes run on this machine.
        args: command-line arguments.
        respawn: start it again whenever it ends.
        respawn_delay: seconds before that.
        remap_args: pairs of names.
        env_args: pairs of a variable and its value.
        output: ``screen`` or ``log``.
        cwd: ``ROS_HOME`` or ``node``.
        launch_prefix: what stands before the command.
        required: end everything with it.
        filename: where it was asked for, for messages.
    """

    package: str
    node_type: str
    name: str | None = None
    namespace: str = "/"
    machine_name: str | None = None
    args: str = ""
    respawn: bool = False
    respawn_delay: float = 0.0
    remap_args: list[tuple[str, str]] = field(default_factory=list)
    env_args: list[tuple[str, str]] = field(default_factory=list)
    output: str | None = None
    cwd: str | None = None
    launch_prefix: str | None = None
    required: bool = False
    filename: str = "<unknown>"

    @property
    def own_name(self) -> str:
        """The name, made from the type when none was given."""
        return self.name or self.node_type.partition(".")[0]

    def to_xml(self) -> str:
        """Return a launch file of this node alone."""
        values = {
            "pkg": self.package,
            "type": self.node_type,
            "name": self.own_name,
            "ns": self.namespace,
            "args": self.args or "",
            "respawn": "true" if self.respawn else "false",
            "respawn_delay": str(self.respawn_delay),
            "required": "true" if self.required else "false",
            "output": self.output,
            "cwd": self.cwd,
            "launch-prefix": self.launch_prefix,
        }
        given = ((name, value) for name, value in values.items() if value is not None)
        attributes = " ".join(f"{name}={quoteattr(value)}" for name, value in given)
        inside = "".join(
            f"<remap from={quoteattr(old)} to={quoteattr(new)}/>"
            for old, new in self.remap_args or ()
        )
        inside += "".join(
            f"<env name={quoteattr(name)} value={quoteattr(str(value))}/>"
            for name, value in self.env_args or ()
        )
        return f"<launch><node {attributes}>{inside}</node></launch>"


class ProcessListener:
    """Hears of processes that end; made for subclasses."""

    def process_died(self, process_name: str, exit_code: int) -> None:
        """Hear of one."""


class Process:
    """A launch that runs.

    Attributes:
        name: of the node, or the launch file's path.
        package: the node's package, empty for a file.
    """

    def __init__(
        self, name: str, package: str, popen: subprocess.Popen[str], patience_s: float
    ) -> None:
        self.name = name
        self.package = package
        self._popen = popen
        self._patience_s = patience_s

    @property
    def pid(self) -> int:
        """Number of the process that carries the launch."""
        return self._popen.pid

    @property
    def exit_code(self) -> int | None:
        """How it ended, None while it runs."""
        return self._popen.poll()

    def is_alive(self) -> bool:
        """Tell whether it runs."""
        return self._popen.poll() is None

    def get_info(self) -> dict[str, Any]:
        """Return name, number and state."""
        return {
            "name": self.name,
            "package": self.package,
            "pid": self.pid,
            "alive": self.is_alive(),
            "exit_code": self.exit_code,
        }

    def get_exit_description(self) -> str:
        """Say how it ended."""
        return f"process has died [pid {self.pid}, exit code {self.exit_code}]."

    def stop(self, errors: list[str] | None = None) -> None:
        """End it and its nodes; what would not end in time is told in `errors` and killed."""
        if not self.is_alive():
            return
        self._popen.send_signal(signal.SIGINT)
        try:
            self._popen.wait(self._patience_s)
        except subprocess.TimeoutExpired:
            if errors is not None:
                errors.append(f"process [{self.name}, pid {self.pid}] required SIGKILL")
            self._popen.kill()
            self._popen.wait()


def start_launch(
    name: str,
    argv: Sequence[str],
    *,
    package: str = "",
    text: str | None = None,
    patience_s: float = 17.0,
    port: int | None = None,
) -> Process:
    """Start ``gazelle roslaunch`` with these arguments.

    Args:
        name: of the process, for messages.
        argv: options, a file and its arguments; ``-`` for a launch file given as `text`.
        package: of the node.
        text: what the launch reads from its standard input.
        patience_s: the time that its nodes have to end.
        port: of the graph.
    """
    popen = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli", "roslaunch", *argv],
        stdin=subprocess.DEVNULL if text is None else subprocess.PIPE,
        start_new_session=True,
        text=True,
    )
    if text is not None and popen.stdin is not None:
        popen.stdin.write(text)
        popen.stdin.close()
    _wait_for_rosout(popen, port)
    return Process(name, package, popen, patience_s + _AFTER_LAUNCH_S)


def _wait_for_rosout(popen: subprocess.Popen[str], port: int | None) -> None:
    """Let a launch get as far as its first node: two at once would both start ``/rosout``."""
    deadline = time.monotonic() + _START_S
    while popen.poll() is None and time.monotonic() < deadline:
        try:
            with Graph.open(port=port, role="client") as graph:
                if graph.discovery.wait_for(_has_rosout, _PAUSE_S):
                    return
        except GraphError:
            time.sleep(_PAUSE_S)


def _has_rosout(entities: Iterable[Entity]) -> bool:
    return any(one.kind is Kind.NODE and one.node == _ROSOUT for one in entities)
