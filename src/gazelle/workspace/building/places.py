"""Looking at paths that files name, whatever stands in them."""

from __future__ import annotations

from pathlib import Path

__all__ = ["is_file", "is_folder", "is_there"]


def is_there(path: Path) -> bool:
    """Tell whether a path leads somewhere; a name too long or with a NUL leads nowhere."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def is_file(path: Path) -> bool:
    """Tell whether a path leads to a file."""
    return is_there(path) and path.is_file()


def is_folder(path: Path) -> bool:
    """Tell whether a path leads to a folder."""
    return is_there(path) and path.is_dir()
