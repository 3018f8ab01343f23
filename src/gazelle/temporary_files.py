"""Files that a process removes at its end, and others for it when it was killed."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

__all__ = ["own_prefix", "sweep"]


def own_prefix(prefix: str) -> str:
    """Return how this process begins the names of its files, for others to `sweep` them."""
    return f"{prefix}{os.getpid()}-"


def sweep(folder: Path, prefix: str) -> None:
    """Remove the files below a prefix of processes of this user that are gone."""
    with contextlib.suppress(OSError):
        for left in folder.glob(f"{prefix}*-*"):
            pid = left.name.removeprefix(prefix).partition("-")[0]
            if not _lives(pid):
                with contextlib.suppress(OSError):
                    left.unlink()


def _lives(pid: str) -> bool:
    if os.name != "posix":
        # A file that is in use cannot be removed there.
        return False
    try:
        os.kill(int(pid), 0)
    except ProcessLookupError:
        return False
    except (OSError, ValueError, OverflowError):
        pass
    return True
