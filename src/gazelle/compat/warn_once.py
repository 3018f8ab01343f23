"""What a drop-in says once a process, such as of an argument that it cannot honour."""

from __future__ import annotations

import sys
from collections.abc import Hashable

__all__ = ["is_first_time", "warn_once"]

_TOLD: set[Hashable] = set()


def is_first_time(what: Hashable) -> bool:
    """Return True the first time that something is to be told, False ever after."""
    if what in _TOLD:
        return False
    _TOLD.add(what)
    return True


def warn_once(text: str) -> None:
    """Write a warning to the standard error, the first time only."""
    if is_first_time(text):
        sys.stderr.write(f"[WARN] {text}\n")
