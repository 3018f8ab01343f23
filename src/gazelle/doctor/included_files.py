"""Files that are parts of others: which names are included, and by whom."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

__all__ = ["included_names", "including_robot"]

_INCLUDE = re.compile(r"""<(?:xacro:)?include\b[^>]*\bfile(?:name)?\s*=\s*["']([^"']+)""")
_MAX_DEPTH = 8


def included_names(paths: Iterable[Path]) -> frozenset[str]:
    """Return the names of files that xacro or launch files include."""
    texts = (path.read_text(encoding="utf-8", errors="replace") for path in paths)
    return frozenset(name.rpartition("/")[2] for text in texts for name in _INCLUDE.findall(text))


def including_robot(path: Path, folder: Path) -> Path | None:
    """Return the outermost file that includes one, by way of others too; None when none does.

    Args:
        path: a xacro file.
        folder: its package's; files of the same folder come first.
    """
    found, wanted = None, path
    for _ in range(_MAX_DEPTH):
        files = (item for item in folder.rglob("*.xacro") if item not in {wanted, path})
        near = sorted(files, key=lambda item: (item.parent != wanted.parent, item))
        above = next((item for item in near if wanted.name in included_names((item,))), None)
        if above is None:
            break
        found = wanted = above
    return found
