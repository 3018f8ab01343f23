"""What roslaunch says: its lines on the terminal, and the folder that a run's logs go to."""

from __future__ import annotations

import contextlib
import os
import sys
import uuid
from collections.abc import Callable, Iterator, Mapping
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from gazelle.documents.yaml import dump_yaml
from gazelle.launch.launch_config import LaunchConfig
from gazelle.log_files import LogStream
from gazelle.parameters.trees import leaves_at
from gazelle.process_lifetime import drop_output, when_nobody_reads
from gazelle.user_folders import ros_log_folder

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["Console", "RunLog", "begin_log", "dump_text", "run_log", "summary"]

_BOLD, _RED, _YELLOW, _RESET = "\x1b[1m", "\x1b[31m", "\x1b[33m", "\x1b[0m"
_MAX_VALUE = 20


class RunLog(NamedTuple):
    """The run that a launch belongs to.

    Attributes:
        run_id: the value of ``/run_id``.
        folder: of all log files.
        is_new: no launch before this one had it.
    """

    run_id: str
    folder: Path
    is_new: bool


class Console:
    """Writes lines as roslaunch does, to the terminal and to a log file."""

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stdout
        self._coloured = self._stream.isatty()
        self._log: LogStream | None = None
        self._is_read = True

    def when_nobody_reads(self, act: Callable[[], object]) -> None:
        """Call something, in any thread, when the terminal's lines have lost their reader."""
        if self._is_read:
            when_nobody_reads(self._stream, act)
        else:
            act()

    def keep(self, log: LogStream | None) -> None:
        """Write every line to an open file too, from now on; None ends that."""
        self._log = log

    def plain(self, text: str) -> None:
        """Write a line."""
        self._write(text, "")

    def bold(self, text: str) -> None:
        """Write a line that stands out."""
        self._write(text, _BOLD)

    def error(self, text: str) -> None:
        """Write a line about a failure."""
        self._write(text, _RED, "ERROR")

    def warning(self, text: str) -> None:
        """Write a line about something to look at."""
        self._write(text, _YELLOW, "WARNING")

    def _write(self, text: str, colour: str, level: str = "INFO") -> None:
        if self._log is not None:
            # The format of the original's log files.
            time_text = datetime.now().strftime("%Y-%m-%d %H:%M:%S,%f")[:-3]
            self._log.write(f"[roslaunch][{level}] {time_text}: {text}\n")
        shown = f"{colour}{text}{_RESET}" if colour and self._coloured else text
        try:
            self._stream.write(shown + "\n")
            self._stream.flush()
        except BrokenPipeError:
            self._is_read = False
            drop_output(self._stream)


def run_log(graph: Graph, wanted: str = "", other: str = "") -> RunLog:
    """Return the run of the graph, or begin one, with its folder.

    Args:
        graph: another launch or roscore may have set its ``/run_id``.
        wanted: the identifier asked for on the command line.
        other: that of a real ROS which is being joined.
    """
    known = other or (
        str(graph.parameters.get("/run_id")) if graph.parameters.has("/run_id") else ""
    )
    run_id = wanted or known or str(uuid.uuid1())
    return RunLog(run_id, _folder(run_id), run_id != known)


@contextlib.contextmanager
def begin_log(console: Console, folder: Path) -> Iterator[None]:
    """Keep what a console shows in ``roslaunch-HOST-PID.log`` and say so."""
    name = f"roslaunch-{os.uname().nodename}-{os.getpid()}.log"
    with contextlib.closing(LogStream(folder / name)) as log:
        console.plain(f"... logging to {log.path}")
        console.plain("Press Ctrl-C to interrupt\n")
        console.keep(log)
        try:
            yield
        finally:
            console.keep(None)


def summary(config: LaunchConfig, params: Mapping[str, Any]) -> str:
    """Return the SUMMARY block: parameters with shortened values, nodes by namespace."""
    lines = ["", "SUMMARY", "========", "", "PARAMETERS"]
    lines += [f" * {name}: {_short(value)}" for name, value in sorted(params.items())]
    lines += ["", "NODES"]
    by_namespace: dict[str, list[str]] = {}
    for node in config.nodes:
        text = f"    {node.name} ({node.package}/{node.type})"
        by_namespace.setdefault(node.namespace, []).append(text)
    for namespace in sorted(by_namespace):
        lines += [f"  {namespace}", *sorted(by_namespace[namespace])]
    return "\n".join([*lines, ""])


def dump_text(config: LaunchConfig) -> str:
    """Return what ``roslaunch --dump-params`` prints."""
    leaves: dict[str, Any] = {}
    for name, value in config.params.items():
        leaves.update(leaves_at(name, value))
    return dump_yaml(leaves)


def _folder(run_id: str) -> Path:
    """Make ``~/.ros/log/RUN_ID`` and let ``latest`` point at it."""
    root = ros_log_folder(os.environ)
    folder = root / run_id
    folder.mkdir(parents=True, exist_ok=True)
    link = root / "latest"
    if link.is_symlink() or not link.exists():
        part = root / f".latest-{os.getpid()}"
        part.symlink_to(folder)
        part.replace(link)
    return folder


def _short(value: Any) -> str:
    text = str(value)
    if len(text) > _MAX_VALUE:
        text = text[: _MAX_VALUE - 3] + "..."
    return text.replace("\n", " ")
