"""The example robot, launched in its workshop in real time, for what is done to it from outside."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from marked_processes import pids_of

from gazelle.graph import Graph

_WORKSPACE = Path(__file__).resolve().parents[2] / "examples" / "scout_ws"
_STARTING_S, _ENDING_S = 180.0, 20.0


class LaunchedScout:
    """A launch and what was started beside it.

    Attributes:
        graph: joined.
        environ: of all its processes.
        log: what the launch and everything beside it write.
        launch: the process of ``roslaunch``.
    """

    graph: Graph
    launch: subprocess.Popen[bytes]

    def __init__(self, folder: Path, environ: Mapping[str, str]) -> None:
        self.environ = environ
        self.log = folder / "launch.log"
        self._started: list[subprocess.Popen[bytes]] = []

    def start(self, *words: str) -> subprocess.Popen[bytes]:
        """Start ``python -m WORDS…`` in the robot's workspace."""
        with self.log.open("ab") as log:
            popen = subprocess.Popen(
                [sys.executable, "-m", *words], cwd=_WORKSPACE, env=dict(self.environ),
                stdout=log, stderr=subprocess.STDOUT,
            )  # fmt: skip
        self._started.append(popen)
        return popen

    def end(self) -> None:
        """Interrupt everything, the launch last."""
        for one in reversed(self._started):
            with contextlib.suppress(ProcessLookupError):
                one.send_signal(signal.SIGINT)
        for one in self._started:
            with contextlib.suppress(subprocess.TimeoutExpired):
                one.wait(_ENDING_S)


@contextlib.contextmanager
def launched_scout(folder: Path, mark: str, **environ: str) -> Iterator[LaunchedScout]:
    """Bring the robot up; nothing is left of it afterwards.

    Args:
        folder: for logs.
        mark: a variable that all its processes have in their environment, with the folder's name.
        environ: more variables.
    """
    port = str(20_000 + os.getpid() % 10_000)
    own = {"GAZELLE_PORT": port, mark: folder.name, "ROS_HOME": str(folder / "ros_home")}
    full = {**os.environ, **own, "GAZELLE_STUDIO": "0", **environ}
    (folder / "launch.log").touch()
    scout = LaunchedScout(folder, full)
    try:
        scout.launch = scout.start("gazelle.cli", "roslaunch", "scout_robot", "scout.launch")
        with Graph.open(environ=full) as graph:
            scout.graph = graph
            if not graph.wait_for_service("/gazebo/set_model_state", _STARTING_S):
                raise SystemExit(f"the robot did not come up:\n{scout.log.read_text()}")
            yield scout
    finally:
        scout.end()
        for pid in pids_of(mark, folder.name):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
