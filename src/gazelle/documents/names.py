"""Asking for files by names that users wrote: too long, unreadable or no names at all."""

from __future__ import annotations

import os
from glob import glob

__all__ = ["exists", "is_file", "is_folder", "names_matching"]

# Python's glob goes into itself at each "/".
_DEEPEST_PATTERN = 100

# Path's own methods raise where a name is too long or a folder may not be looked into.


def exists(path: str | os.PathLike[str]) -> bool:
    """Tell whether something of this name is there; False where nobody can tell."""
    return os.path.exists(path)  # noqa: PTH110


def is_file(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file of this name is there; False where nobody can tell."""
    return os.path.isfile(path)  # noqa: PTH113


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Tell whether a folder of this name is there; False where nobody can tell."""
    return os.path.isdir(path)  # noqa: PTH112


def names_matching(pattern: str, folder: str | os.PathLike[str]) -> list[str]:
    """Return what a pattern with ``*``, ``?``, ``[…]`` and ``**`` finds in a folder, sorted.

    The names are relative to the folder. What no path can be finds nothing.
    """
    if "\0" in pattern or pattern.count("/") + pattern.count(os.sep) > _DEEPEST_PATTERN:
        return []
    return sorted(glob(pattern, root_dir=folder, recursive=True))  # noqa: PTH207
