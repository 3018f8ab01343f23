"""One test of a launch file: its graph, the launch's other nodes, the test's process."""

from __future__ import annotations

import os
import shlex
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Self

from gazelle.cli.rostest.results import Case, missing_result, read_cases
from gazelle.diagnostics import Diagnostics
from gazelle.folders import ros_home
from gazelle.graph import Graph
from gazelle.launch.config import LaunchConfig, TestTag
from gazelle.launch.environment import node_environment
from gazelle.launch.executables import find_executable
from gazelle.launch.node_process import node_words
from gazelle.parent_process import PARENT_VARIABLE
from gazelle.workspace import Workspace

__all__ = ["TestRun"]

_SET = "setting /run_id"
_PATIENCE_S = 20.0


class TestRun:
    """A graph of its own on a free port, with the launch's nodes; ends with the ``with`` block."""

    __test__ = False

    def __init__(
        self, file: Path, args: Mapping[str, str], *, has_nodes: bool, workspace: Workspace
    ) -> None:
        """Take over what to start; `has_nodes` says that there is more than tests."""
        self._words = [str(file), *(f"{name}:={value}" for name, value in args.items())]
        self._has_nodes = has_nodes
        self._workspace = workspace
        self._port = _free_port()
        self._launch: subprocess.Popen[str] | None = None
        environ = {**os.environ, "GAZELLE_PORT": str(self._port)}
        self._environment = node_environment(environ, workspace)

    def __enter__(self) -> Self:
        self._graph = Graph.open(port=self._port, role="hub")
        return self

    def __exit__(self, *exc_info: object) -> None:
        if self._launch is not None:
            self._launch.send_signal(signal.SIGINT)
            _end(self._launch)
        self._graph.close()

    def set_parameters(self, config: LaunchConfig) -> None:
        """Set the launch's parameters and start its nodes."""
        for name, value in config.params.items():
            self._graph.parameters.set(name, value)
        if self._has_nodes:
            self._start_nodes()

    def tried(self, test: TestTag, result: Path, *, show: bool) -> list[Case]:
        """Run a test, again as often as its ``retry`` says; return its cases.

        Args:
            test: which.
            result: the file that it shall write.
            show: its output goes to the terminal.
        """
        diagnostics = Diagnostics()
        node = test.node
        found = find_executable(
            node.package,
            node.type,
            workspace=self._workspace,
            diagnostics=diagnostics,
            span=node.span,
        )
        if found is None:
            why = "; ".join(item.message for item in diagnostics)
            return [missing_result(test.test_name, f"Test node cannot be found: {why}")]
        own = [*node_words(node), f"--gtest_output=xml:{result}"]
        words = [*shlex.split(node.launch_prefix), *found.command, *own]
        cases: list[Case] = []
        for _ in range(test.retry + 1):
            cases = self._run(words, test, result, show=show)
            if all(one.passed for one in cases):
                break
        return cases

    def _run(self, words: list[str], test: TestTag, result: Path, *, show: bool) -> list[Case]:
        result.parent.mkdir(parents=True, exist_ok=True)
        result.unlink(missing_ok=True)
        namespace = test.node.namespace.rstrip("/") or "/"
        environment = {
            **self._environment,
            **dict(test.node.env),
            "ROS_NAMESPACE": namespace,
            PARENT_VARIABLE: str(os.getpid()),
        }
        output = None if show else subprocess.PIPE
        process = subprocess.Popen(
            words,
            env=environment,
            cwd=_home(),
            stdout=output,
            stderr=None if show else subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        try:
            said, _ = process.communicate(timeout=test.time_limit_s)
        except subprocess.TimeoutExpired:
            _end(process)
            text = f"Test time limit of {test.time_limit_s:g} s exceeded: [{test.test_name}]"
            return [missing_result(test.test_name, text)]
        if not result.is_file():
            text = f"Test node [{test.node.package}/{test.node.type}] did not generate test results"
            text += f" (exit code {process.returncode})\n{said or ''}"
            return [missing_result(test.test_name, text)]
        return read_cases(result)

    def _start_nodes(self) -> None:
        """Start ``roslaunch`` beside, and wait until it has set its parameters."""
        words = [sys.executable, "-m", "gazelle.cli", "roslaunch", "--no-summary", *self._words]
        self._launch = subprocess.Popen(
            words, env=self._environment, stdout=subprocess.PIPE, text=True, errors="replace"
        )
        ready = threading.Event()
        threading.Thread(target=_pump, args=(self._launch, ready), daemon=True).start()
        ready.wait(_PATIENCE_S)


def _pump(process: subprocess.Popen[str], ready: threading.Event) -> None:
    """Read what roslaunch prints; it goes on to the terminal's standard error."""
    assert process.stdout is not None
    for line in process.stdout:
        if _SET in line:
            ready.set()
        print(line, end="", file=sys.stderr, flush=True)
    ready.set()


def _end(process: subprocess.Popen[str]) -> None:
    """Wait for a process, and kill it when it does not end."""
    try:
        if process.poll() is None and os.getpgid(process.pid) == process.pid:
            os.killpg(process.pid, signal.SIGTERM)
        process.wait(_PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _home() -> Path:
    home = ros_home(os.environ)
    home.mkdir(parents=True, exist_ok=True)
    return home


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
