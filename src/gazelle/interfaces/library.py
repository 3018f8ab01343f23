"""Where definition texts come from: the data of this package and users' own packages.

The data files hold one package of one generation each, as blocks of ``=== msg/Name`` and the
definition's lines. Nothing is read before it is asked for.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import cache, lru_cache
from pathlib import Path
from typing import NamedTuple

from gazelle.documents.names import is_file
from gazelle.errors import NotFoundError, UserFileError
from gazelle.interfaces.definition import Generation

__all__ = ["Source", "add_package", "add_search_path", "block_names", "find_source", "revision"]

_DATA = Path(__file__).parent / "definitions"
_PARTS = ("msg", "srv", "action")
_ROS1_WORDS = ("Header", "time", "duration")
_lock = threading.Lock()
_user_packages: dict[str, tuple[Path, Generation | None]] = {}
_revision = 0


class Source(NamedTuple):
    """One definition's text.

    Attributes:
        text: the whole text, all parts.
        file: path of the file, or the name in angle brackets for built-in data.
        generation: which ROS it was written for.
    """

    text: str
    file: str
    generation: Generation


def add_package(name: str, path: Path | str, generation: Generation | None = None) -> None:
    """Let a user's own package define types; its msg/, srv/ and action/ are read when needed.

    Args:
        name: the package's name.
        path: its folder.
        generation: which ROS the files are written for; read from ``package.xml`` when None.

    Raises:
        NotFoundError: there is no such folder.
    """
    global _revision
    folder = Path(path)
    if not folder.is_dir():
        raise NotFoundError("package folder", str(folder), hint=f"package '{name}' is not added")
    with _lock:
        entry = (folder, generation or _package_generation(folder))
        if _user_packages.get(name) != entry:
            _user_packages[name] = entry
            _revision += 1


def add_search_path(folder: Path | str) -> tuple[str, ...]:
    """Add every package with definitions directly under a folder; return their names."""
    found = []
    for path in sorted(Path(folder).iterdir()):
        if path.is_dir() and any((path / part).is_dir() for part in _PARTS):
            add_package(path.name, path)
            found.append(path.name)
    return tuple(found)


def revision() -> int:
    """Return a number that is raised whenever a package is added."""
    return _revision


def find_source(package: str, part: str, name: str, generation: Generation) -> Source | None:
    """Return the text of a definition of one generation, None when there is none.

    A user's own package comes before the data of Gazelle.

    Args:
        package: such as ``std_msgs``.
        part: ``msg``, ``srv`` or ``action``.
        name: such as ``Header``.
        generation: which ROS it must be written for.

    Raises:
        UserFileError: the file is there and cannot be read.
    """
    if package in _user_packages:
        folder, written_for = _user_packages[package]
        file = folder / part / f"{name}.{part}"
        if not is_file(file):
            file = _files(folder, part, _revision).get(name, file)
        if written_for in (None, generation) and is_file(file):
            text = _read(file)
            if written_for is generation or _fits(text, generation):
                return Source(text, str(file), generation)
    text_of = _blocks(package, generation).get(f"{part}/{name}")
    return None if text_of is None else Source(text_of, f"<{package}/{part}/{name}>", generation)


def block_names(generation: Generation, package: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield package, part and name of every definition of one generation.

    Args:
        generation: which ROS they are written for.
        package: whose, all packages' when empty; reading them all takes a program's start longer
            than anything else.
    """
    folder = _DATA / f"ros{generation.value}"
    owners = [package] if package else [file.stem for file in sorted(folder.glob("*.txt"))]
    for owner in owners:
        for key in _blocks(owner, generation):
            part, name = key.split("/")
            yield owner, part, name
    for owner, (path, written_for) in sorted(_user_packages.items()):
        if written_for in (None, generation) and package in ("", owner):
            for part in _PARTS:
                for name in _files(path, part, _revision):
                    yield owner, part, name


@lru_cache(maxsize=1024)
def _files(folder: Path, part: str, _revision: int) -> dict[str, Path]:
    """Definitions of a package by name; CMake's DIRECTORY lets them lie in folders of msg/ too."""
    found: dict[str, Path] = {}
    for file in sorted(
        (folder / part).rglob(f"*.{part}"), key=lambda file: (len(file.parts), file)
    ):
        found.setdefault(file.stem, file)
    return found


def _read(file: Path) -> str:
    """Text of a user's file; letters of other encodings stand in comments only."""
    try:
        return file.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        from gazelle.diagnostics import Diagnostics, SourceSpan

        diagnostics = Diagnostics()
        message = f"cannot read it: {error.strerror}"
        diagnostics.report("interfaces.unreadable", message, SourceSpan(str(file)))
        raise UserFileError(tuple(diagnostics)) from error


@cache
def _blocks(package: str, generation: Generation) -> dict[str, str]:
    if not package.isidentifier():
        return {}
    file = _DATA / f"ros{generation.value}" / f"{package}.txt"
    if not is_file(file):
        return {}
    blocks: dict[str, str] = {}
    for block in file.read_text(encoding="utf-8").split("=== ")[1:]:
        key, _, text = block.partition("\n")
        blocks[key] = text.rstrip("\n")
    return blocks


def _package_generation(folder: Path) -> Generation | None:
    """Read from the build tool that ``package.xml`` names; REP-140 and REP-149."""
    manifest = folder / "package.xml"
    if not manifest.is_file():
        return Generation.ROS1 if (folder / "manifest.xml").is_file() else None
    text = manifest.read_text(encoding="utf-8", errors="replace")
    ros1 = "catkin" in text or "message_generation" in text
    ros2 = "ament" in text or "rosidl" in text
    if ros1 == ros2:
        return None
    return Generation.ROS1 if ros1 else Generation.ROS2


def _fits(text: str, generation: Generation) -> bool:
    """Guess from what only one generation can write; a neutral text fits both."""
    lines = [line.partition("#")[0].split() for line in text.splitlines()]
    if generation is Generation.ROS2:
        return not any(words and words[0].partition("[")[0] in _ROS1_WORDS for words in lines)
    return not any(_is_ros2_line(words) for words in lines)


def _is_ros2_line(words: list[str]) -> bool:
    if not words:
        return False
    has_default = len(words) > 2 and "=" not in "".join(words[1:])
    return has_default or "<=" in words[0] or words[0].startswith(("wstring", "builtin_interf"))
