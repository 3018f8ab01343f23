"""A launch as a tree of processes: its output and its end."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from gazelle.process_lifetime import PARENT_VARIABLE

__all__ = ["ProcessTree", "launch_environment"]

# After SIGINT: roslaunch waits 15 s for its nodes, and 2 s more after SIGTERM.
_STOP_S = 20.0
# These would take the launch off its own graph.
_FOREIGN = frozenset(
    {"ROS_MASTER_URI", "ROS_DOMAIN_ID", "ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", "ROS_LOG_DIR"}
)


class ProcessTree:
    """A command of Gazelle's in a session of its own; all of it ends with this process.

    Attributes:
        lines: what it has written so far.
        title: the command, for people.
    """

    def __init__(
        self,
        words: Sequence[str],
        *,
        cwd: Path,
        environment: Mapping[str, str],
        on_change: Callable[[], None],
    ) -> None:
        """Start it.

        Args:
            words: the command as ``gazelle`` takes it: ``roslaunch``, a package, a file …
            cwd: where it runs.
            environment: of all its processes.
            on_change: is called for every line and at the end.
        """
        self.lines: list[str] = []
        self.title = " ".join(words)
        self._on_change = on_change
        self._popen = subprocess.Popen(
            [sys.executable, "-m", "gazelle.cli", *words],
            cwd=cwd,
            env=environment,
            text=True,
            errors="replace",
            start_new_session=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def pid(self) -> int:
        """The process number of the command, which leads a process group of its own."""
        return self._popen.pid

    @property
    def exit_code(self) -> int | None:
        """Its exit code, None while it runs."""
        return self._popen.poll()

    def ended(self) -> str:
        """Say how it has ended, nothing while it runs or has something left to read."""
        if self._reader.is_alive() or self._popen.poll() is None:
            return ""
        return f"the launch has ended with exit code {self._popen.returncode}"

    def wait(self, timeout_s: float) -> int | None:
        """Wait for the end; return the exit code, None when time is up."""
        try:
            code = self._popen.wait(timeout_s)
        except subprocess.TimeoutExpired:
            return None
        self._reader.join(timeout_s)
        return code

    def stop(self, number: int = signal.SIGINT) -> int:
        """End it with a signal, by force when that is of no use; return the exit code."""
        for one in (number, signal.SIGTERM, signal.SIGKILL):
            with contextlib.suppress(ProcessLookupError):
                self._popen.send_signal(one)
            code = self.wait(_STOP_S)
            if code is not None:
                return code
        raise AssertionError(f"{self.title} (pid {self._popen.pid}) cannot be ended")

    def _read(self) -> None:
        assert self._popen.stdout is not None
        with self._popen.stdout:
            for line in self._popen.stdout:
                self.lines.append(line.rstrip("\n"))
                self._on_change()
        self._popen.wait()
        self._on_change()


def launch_environment(port: int, home: Path, variables: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of a launch that is alone with its test.

    Args:
        port: of its graph.
        home: its ``ROS_HOME``, for logs.
        variables: the test's own; they come last.
    """
    kept = {key: value for key, value in os.environ.items() if key not in _FOREIGN}
    own = {
        "GAZELLE_PORT": str(port),
        "GAZELLE_BRIDGE": "no",
        "GAZELLE_STUDIO": "0",
        "ROS_HOME": str(home),
        PARENT_VARIABLE: str(os.getpid()),
    }
    return {**kept, **own, **variables}
