"""What became of processes that a test looks at from outside."""

from __future__ import annotations

import psutil

__all__ = ["is_gone"]


def is_gone(pid: int) -> bool:
    """Return whether a process has ended, also where nobody has asked for its exit code yet."""
    try:
        return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True
