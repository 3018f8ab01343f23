"""Ends the processes of a launch when the launcher is gone, even by kill -9.

The launcher starts this file as a small Python of its own and writes to its standard input: ``12``
for a process group that has begun, ``-12`` for one that has ended. When the stream ends, whatever
is left gets SIGTERM and, a moment later, SIGKILL. Unlike the kernel's parent-death signal this
reaches the children of nodes (``launch-prefix``, shell scripts) and nodes that ignore signals.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from typing import TextIO

__all__ = ["Watchdog", "end_groups", "watch"]

_PATIENCE_S = 2.0
_POLL_S = 0.05
_MAX_DURATION_S = 4.0


class Watchdog:
    """The launcher's side.

    Attributes:
        popen: the guarding process.
    """

    def __init__(self) -> None:
        # -I and -S: it needs only what Python itself brings, and starts in no time.
        self.popen = subprocess.Popen(
            [sys.executable, "-I", "-S", __file__, str(_PATIENCE_S)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )

    def begun(self, group: int) -> None:
        """Watch over a process group."""
        self._write(group)

    def ended(self, group: int) -> None:
        """Forget a process group."""
        self._write(-group)

    def close(self) -> None:
        """Let it end what is left, and wait for that."""
        assert self.popen.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            self.popen.stdin.close()
        try:
            self.popen.wait(_MAX_DURATION_S)
        except subprocess.TimeoutExpired:
            # Whoever holds the other end of the pipe keeps it from hearing of the end.
            self.popen.kill()
            self.popen.wait()

    def _write(self, number: int) -> None:
        assert self.popen.stdin is not None
        # A guard that somebody killed is missed only if the launcher is killed too.
        with contextlib.suppress(BrokenPipeError):
            self.popen.stdin.write(f"{number}\n".encode())
            self.popen.stdin.flush()


def watch(stream: TextIO, patience_s: float = _PATIENCE_S) -> None:
    """Follow the launcher's messages to their end, then end what is left."""
    groups: set[int] = set()
    for line in stream:
        number = int(line)
        if number > 0:
            groups.add(number)
        else:
            groups.discard(-number)
    end_groups(groups, patience_s)


def end_groups(groups: set[int], patience_s: float = _PATIENCE_S) -> None:
    """End process groups: SIGTERM, and SIGKILL for what is still there."""
    left = {group for group in groups if _signalled(group, signal.SIGTERM)}
    deadline = time.monotonic() + patience_s
    while left and time.monotonic() < deadline:
        time.sleep(_POLL_S)
        left = {group for group in left if _signalled(group, 0)}
    for group in left:
        _signalled(group, signal.SIGKILL)


def _signalled(group: int, number: int) -> bool:
    """Signal a group; False when nothing of it is left."""
    try:
        os.killpg(group, number)
    except (ProcessLookupError, PermissionError):
        return False
    return True


if __name__ == "__main__":
    for ignored in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ignored, signal.SIG_IGN)
    watch(sys.stdin, float(sys.argv[1]))
