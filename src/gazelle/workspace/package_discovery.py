"""Finding packages in folder trees: where a manifest lies is where a package is."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.documents import read_limited
from gazelle.documents.files import is_file
from gazelle.workspace.package_xml import MANIFEST_BYTES, quick_name

__all__ = ["FoundPackage", "crawl_prefix", "crawl_source", "manifest_in"]

_IGNORE_MARKERS = frozenset({"AMENT_IGNORE", "CATKIN_IGNORE", "COLCON_IGNORE", "rospack_nosubdirs"})
_MANIFESTS = ("package.xml", "manifest.xml")
_PRUNED = frozenset({"build", "devel", "install", "log", "node_modules", "__pycache__", "venv"})
_MAX_DEPTH = 10


class FoundPackage(NamedTuple):
    """A package seen on disk, its manifest not parsed yet.

    Attributes:
        name: package name.
        path: the folder that `$(find …)` means: source folder, or ``share/<name>``.
        manifest: its ``package.xml`` or ``manifest.xml``; None for a bare ament marker.
        prefix: install prefix (``lib/<name>`` is below it); None in source trees.
    """

    name: str
    path: Path
    manifest: Path | None
    prefix: Path | None = None


def manifest_in(folder: Path) -> Path | None:
    """Return the manifest lying directly in a folder, None when there is none."""
    for name in _MANIFESTS:
        path = folder / name
        if is_file(path):
            return path
    return None


def crawl_source(root: Path, *, deepest: int = _MAX_DEPTH) -> Iterator[FoundPackage]:
    """Yield the packages of a source tree in order of path.

    A package's own subfolders are not searched, as in catkin and colcon. Folders with
    ``CATKIN_IGNORE``, ``COLCON_IGNORE`` or ``AMENT_IGNORE``, hidden ones and build products are
    left out; a link back to a folder seen before is not followed twice.
    """
    yield from _crawl(str(root), deepest, set())


def crawl_prefix(prefix: Path) -> Iterator[FoundPackage]:
    """Yield the packages of an install prefix (``share/<name>/package.xml``), sorted.

    A prefix that holds one prefix per package (colcon's isolated layout) is understood too. So is
    catkin's devel space, whose ``.catkin`` file names its source folders.
    """
    yield from _devel_sources(prefix)
    found = list(_share_packages(prefix))
    yield from found
    if not found:
        for child in _sorted_folders(prefix):
            if (child / "share" / child.name).is_dir():
                yield from _share_packages(child)


def _devel_sources(prefix: Path) -> Iterator[FoundPackage]:
    try:
        text = (prefix / ".catkin").read_text(encoding="utf-8")
    except (OSError, ValueError):
        return
    for source in filter(None, text.strip().split(";")):
        yield from crawl_source(Path(source))


def _share_packages(prefix: Path) -> Iterator[FoundPackage]:
    for folder in _sorted_folders(prefix / "share"):
        manifest = folder / "package.xml"
        if manifest.is_file():
            yield FoundPackage(folder.name, folder, manifest, prefix)


def _sorted_folders(folder: Path) -> list[Path]:
    try:
        with os.scandir(folder) as entries:
            names = sorted(entry.name for entry in entries if entry.is_dir())
    except OSError:
        return []
    return [folder / name for name in names if not name.startswith(".")]


def _crawl(folder: str, deepest: int, seen: set[tuple[int, int]]) -> Iterator[FoundPackage]:
    try:
        with os.scandir(folder) as entries:
            listing = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return
    names = {entry.name for entry in listing}
    if names & _IGNORE_MARKERS:
        return
    for manifest in _MANIFESTS:
        if manifest in names:
            yield _package_at(Path(folder), Path(folder, manifest))
            return
    if deepest <= 0:
        return
    for entry in listing:
        if _worth_entering(entry, seen):
            yield from _crawl(entry.path, deepest - 1, seen)


def _worth_entering(entry: os.DirEntry[str], seen: set[tuple[int, int]]) -> bool:
    if entry.name.startswith(".") or entry.name in _PRUNED:
        return False
    try:
        if not entry.is_dir():
            return False
        if entry.is_symlink():
            info = Path(entry.path).stat()
            key = (info.st_dev, info.st_ino)
            if key in seen:
                return False
            seen.add(key)
    except OSError:
        return False
    return True


def _package_at(folder: Path, manifest: Path) -> FoundPackage:
    name = None
    if manifest.name == "package.xml":
        try:
            name = quick_name(read_limited(manifest, MANIFEST_BYTES))
        except OSError:
            name = None
    return FoundPackage(name or folder.name, folder, manifest)
