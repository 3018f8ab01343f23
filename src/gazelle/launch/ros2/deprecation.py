"""Warnings of what a launch file uses and no longer should: each once a process."""

from __future__ import annotations

import warnings

__all__ = ["WARNED", "warn_once"]

# What was said. Launch files repeat themselves, and Python counts warnings by lines.
WARNED: set[str] = set()


def warn_once(text: str, category: type[Warning] = UserWarning, *, stacklevel: int = 2) -> None:
    """Warn at the first place a text is said for; `stacklevel` counts from the caller."""
    if text in WARNED:
        return
    WARNED.add(text)
    warnings.warn(text, category, stacklevel=stacklevel + 1)
