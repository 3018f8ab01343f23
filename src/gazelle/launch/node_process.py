"""One process of a launch: its command, its output, its end, and that a signal stopped it."""

from __future__ import annotations

import contextlib
import os
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from gazelle.launch.launch_config import NodeTag
from gazelle.launch.node_commands import Executable
from gazelle.process_lifetime import PARENT_VARIABLE, interrupts_held

__all__ = [
    "LaunchedProcess",
    "StoppedProcess",
    "code_text",
    "end_text",
    "node_argv",
    "start_process",
]

_WATCHES = hasattr(os, "waitid")
_STOPPED = (os.CLD_STOPPED, os.CLD_TRAPPED) if _WATCHES else ()


class StoppedProcess:
    """What is to be said of one process when SIGSTOP, SIGTSTP or a debugger stops it.

    Its nodes stay on the graph for a while, and nothing else says why they do nothing.
    """

    def __init__(self, pid: int, *, clock: Callable[[], float] = time.monotonic) -> None:
        """Begin with a process that runs, a child of this one."""
        self._pid = pid
        self._clock = clock
        self._since_s: float | None = None

    def news(self) -> str:
        """Return what has changed since the last call, empty for nothing."""
        if not _WATCHES:
            return ""
        try:
            # Ends are left for whoever waits for them.
            change = os.waitid(os.P_PID, self._pid, os.WSTOPPED | os.WCONTINUED | os.WNOHANG)
        except ChildProcessError:
            return ""
        if change is None:
            return ""
        if change.si_code in _STOPPED:
            self._since_s = self._clock()
            return (
                f"process is stopped [pid {self._pid}]: it does nothing until it gets SIGCONT "
                f"(kill -CONT {self._pid})"
            )
        since_s, self._since_s = self._since_s, None
        after = "" if since_s is None else f" after {self._clock() - since_s:.1f} s"
        return f"process goes on{after} [pid {self._pid}]"


@dataclass(slots=True)
class LaunchedProcess:
    """A node that runs, in a process of its own or hosted with others.

    Attributes:
        label: roslaunch's name for it, such as ``rsp-2``.
        spec: what it was started from.
        argv: its command line.
        log_stem: path of its log files without ``.log``.
        popen: the process; None for a hosted node.
        host_id: number in the host; None for a process of its own.
        stopping: it has been told to end.
    """

    label: str
    spec: NodeTag
    argv: tuple[str, ...]
    log_stem: Path
    popen: subprocess.Popen[bytes] | None = None
    host_id: int | None = None
    stopping: bool = False

    @property
    def pid(self) -> int:
        """Process number, 0 when it never started."""
        return self.popen.pid if self.popen is not None else 0


def node_argv(spec: NodeTag) -> list[str]:
    """Return a node's own arguments: those of the file, its remaps, name and log file."""
    remaps = [f"{source}:={target}" for source, target in spec.remaps]
    return [*shlex.split(spec.args), *remaps, f"__name:={spec.name}"]


def start_process(
    process: LaunchedProcess, executable: Executable, environment: Mapping[str, str], cwd: Path
) -> None:
    """Start a process in a session of its own, so that only the launcher gets Ctrl-C.

    Raises:
        OSError: the command cannot be started.
    """
    prefix = shlex.split(process.spec.launch_prefix)
    argv = [*prefix, *process.argv]
    if prefix or executable.command[0] != sys.executable:
        argv = [sys.executable, "-m", "gazelle.launch.exec_program", *argv]
    variables = {
        **environment,
        **dict(process.spec.env),
        "ROS_NAMESPACE": process.spec.namespace.rstrip("/") or "/",
        PARENT_VARIABLE: str(os.getpid()),
    }
    folder = executable.folder if process.spec.cwd == "node" and executable.folder else cwd
    with _log_stream(process) as log, interrupts_held():
        process.popen = subprocess.Popen(
            argv, env=variables, cwd=folder, stdout=log, stderr=None, start_new_session=True
        )


def end_text(process: LaunchedProcess, code: int) -> str:
    """Return roslaunch's sentence about a process that has ended."""
    log = f"log file: {process.log_stem}*.log"
    if code == 0:
        return f"process has finished cleanly\n{log}"
    command = " ".join(process.argv)
    return f"process has died [pid {process.pid}, {code_text(code)}, cmd {command}].\n{log}"


def code_text(code: int) -> str:
    """Return an exit code in words; negative ones are signals."""
    if code >= 0:
        return f"exit code {code}"
    with contextlib.suppress(ValueError):
        return f"signal {signal.Signals(-code).name}, exit code {code}"
    return f"signal {-code}, exit code {code}"


class _Inherited:
    """Stands for the launcher's own standard output."""

    def __enter__(self) -> None:
        return None

    def __exit__(self, *_exception: object) -> None:
        return None


def _log_stream(process: LaunchedProcess) -> IO[bytes] | _Inherited:
    if process.spec.output == "screen":
        return _Inherited()
    path = process.log_stem.with_name(f"{process.log_stem.name}-stdout.log")
    # `rosclean purge` may have taken the folder away since the launch began.
    path.parent.mkdir(parents=True, exist_ok=True)
    return path.open("ab")
