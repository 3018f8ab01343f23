"""Processes of a launch that a signal stops, and their going on."""

from __future__ import annotations

import os
import time
from collections.abc import Callable

__all__ = ["StoppedProcess"]

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
