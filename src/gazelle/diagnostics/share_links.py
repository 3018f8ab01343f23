"""Paths in the trees of links that stand for share folders, told as the user's own files.

`gazelle.workspace.share_folder` lays such trees out. Messages must name what the user wrote and can
correct, so every text that may hold such a path goes through `as_written`.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

__all__ = ["LINKS_FOLDER", "SOURCE_LINK", "as_written", "written_file"]

LINKS_FOLDER = "installed"
SOURCE_LINK = "source"
_MARK = f"/gazelle/{LINKS_FOLDER}/"
_PATH = re.compile(
    rf"(?P<tree>/[^\s'\"<>|:,;()\[\]]*{_MARK}[0-9a-f]{{16}})/share/[^/\s'\"<>|:,;()\[\]]+"
    r"(?P<inside>(?:/[^/\s'\"<>|:,;()\[\]]+)*)"
)


def as_written(text: str) -> str:
    """Return a text with the paths of links replaced by those of the user's files."""
    if _MARK not in text:
        return text
    return _PATH.sub(lambda found: _source(found[0], found["tree"], found["inside"]), text)


def written_file(path: str | os.PathLike[str]) -> Path:
    """Return the user's file that a path leads to; other paths come back as they are."""
    text = os.fspath(path)
    if _MARK not in text:
        return Path(text)
    found = _PATH.search(text)
    if found is None or found.start():
        return Path(text)
    return Path(_source(text, found["tree"], text[found.start("inside") :]))


def _source(path: str, tree: str, inside: str) -> str:
    if os.path.islink(path):  # noqa: PTH114
        return os.readlink(path)  # noqa: PTH115
    stop = f"{path[: len(path) - len(inside)]}"
    rest: list[str] = []
    folder = path
    while folder != stop and not os.path.isdir(folder):  # noqa: PTH112
        folder, _, name = folder.rpartition("/")
        if os.path.islink(folder):  # noqa: PTH114
            return "/".join([os.readlink(folder), name, *rest])  # noqa: PTH115
        rest.insert(0, name)
    return "/".join([_folder(folder, tree, folder[len(stop) :]), *rest])


def _folder(folder: str, tree: str, inside: str) -> str:
    """Return the source of a folder: the package's own one of this name, or its files'."""
    try:
        package = os.readlink(f"{tree}/{SOURCE_LINK}")  # noqa: PTH115
    except OSError:
        return folder
    if os.path.isdir(package + inside):  # noqa: PTH112
        return package + inside
    for root, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            link = os.path.join(root, name)  # noqa: PTH118
            below = link[len(folder) :]
            target = os.readlink(link) if os.path.islink(link) else ""  # noqa: PTH114, PTH115
            if target.endswith(below):
                return target.removesuffix(below)
    return package
