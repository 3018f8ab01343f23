"""What a drop-in says of an argument that it cannot honour: one line, once a process."""

from __future__ import annotations

import sys

__all__ = ["warn_once"]

_TOLD: set[str] = set()


def warn_once(text: str) -> None:
    """Write a warning to the standard error, the first time only."""
    if text not in _TOLD:
        _TOLD.add(text)
        sys.stderr.write(f"[WARN] {text}\n")
