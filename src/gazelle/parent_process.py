"""Processes that end when the one that launched them ends, even by kill -9."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

from gazelle.process_exit import start_deaf_thread

__all__ = ["PARENT_VARIABLE", "end_with_parent"]

PARENT_VARIABLE = "GAZELLE_PARENT_PID"
_PR_SET_PDEATHSIG = 1
_CHECK_PERIOD_S = 0.5


def end_with_parent() -> None:
    """Send this process SIGTERM when its launcher dies.

    Does nothing unless the launcher named itself in the environment, so a node that a person
    starts by hand outlives the shell as usual. The kernel does it on Linux (prctl(2)), but may
    give the signal to a thread other than Python's main one, which then does not hear of it
    before it wakes; so a thread looks at the parent's number too, everywhere.
    """
    parent = os.environ.pop(PARENT_VARIABLE, "")
    if not parent.isdigit():
        return
    if sys.platform == "linux":
        # Only who was launched needs it.
        import ctypes

        ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0)
    if os.getppid() != int(parent):
        os.kill(os.getpid(), signal.SIGTERM)
    start_deaf_thread(_watch, int(parent))


def _watch(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_CHECK_PERIOD_S)
    signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
