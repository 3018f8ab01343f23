"""Where the logs of a launch go: ``~/.ros/log/RUN_ID``, shared by all launches on a graph."""

from __future__ import annotations

import contextlib
import os
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gazelle.folders import ros_log_folder
from gazelle.log_files import LogStream

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.launch.console import Console

__all__ = ["RunLog", "begin_log", "run_log"]


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
