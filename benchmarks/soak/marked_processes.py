"""Processes by a variable of their environment: all that a launch has started, and nothing else."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path


def pids_of(variable: str, value: str) -> list[int]:
    """Return the numbers of the processes that were started with a variable of this value."""
    wanted = f"{variable}={value}".encode()
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit() and folder.name != str(os.getpid()):
            with contextlib.suppress(OSError):
                if wanted in (folder / "environ").read_bytes().split(b"\0"):
                    found.append(int(folder.name))
    return found


def commands_of(pids: list[int]) -> list[str]:
    """Return what the processes were started as, without the interpreter."""
    found = []
    for pid in pids:
        with contextlib.suppress(OSError):
            words = Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
            found.append(" ".join(one.decode(errors="replace") for one in words[1:5]))
    return found
