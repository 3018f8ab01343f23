"""Where definition texts come from: the data of this package and users' own packages.

The data files hold one package of one generation each, as blocks of ``=== msg/Name`` and the
definition's lines. Nothing is read before it is asked for.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from gazelle.documents.files import is_file
from gazelle.errors import NotFoundError, UserFileError
from gazelle.interfaces.definition import Generation

__all__ = ["Library", "Source"]

_DATA = Path(__file__).parent / "definitions"
_PARTS = ("msg", "srv", "action")
_ROS1_WORDS = ("Header", "time", "duration")


class Source(NamedTuple):
    """One definition's text.

    Attributes:
        text: the whole text, all parts.
        file: path of the file, or the name in angle brackets for built-in data.
        generation: which ROS it was written for.
        is_own: whether a user or a bag wrote it, not Gazelle.
    """

    text: str
    file: str
    generation: Generation
    is_own: bool = False


class Library:
    """Texts by name: single ones and packages that were added, before those of Gazelle.

    One that lies over another answers with its own texts first.
    """

    def __init__(self, below: Library | None = None) -> None:
        """Begin without texts.

        Args:
            below: answers for what is not added here; Gazelle's own data when None.
        """
        self._below = below
        self._lock = threading.Lock()
        self._packages: dict[str, tuple[Path, Generation | None]] = {}
        self._texts: dict[tuple[str, str, Generation], str] = {}
        self._spoken_of: set[str] = set()  # packages that texts are of
        self._changes = 0
        self._listed: tuple[int, dict[tuple[Path, str], dict[str, Path]]] = (0, {})

    @property
    def revision(self) -> int:
        """A number that is raised whenever something is added, or all of it removed."""
        return self._changes if self._below is None else self._changes + self._below.revision

    def add_package(
        self, name: str, path: Path | str, generation: Generation | None = None
    ) -> None:
        """Let a user's own package define types; its msg/, srv/ and action/ are read when needed.

        Args:
            name: the package's name.
            path: its folder.
            generation: which ROS the files are written for; read from ``package.xml`` when None.

        Raises:
            NotFoundError: there is no such folder.
        """
        folder = Path(path)
        if not folder.is_dir():
            hint = f"package '{name}' is not added"
            raise NotFoundError("package folder", str(folder), hint=hint)
        with self._lock:
            entry = (folder, generation or _package_generation(folder))
            if self._packages.get(name) != entry:
                self._packages[name] = entry
                self._changes += 1

    def add_search_path(self, folder: Path | str) -> tuple[str, ...]:
        """Add every package with definitions directly under a folder; return their names."""
        found = []
        for path in sorted(Path(folder).iterdir()):
            if path.is_dir() and any((path / part).is_dir() for part in _PARTS):
                self.add_package(path.name, path)
                found.append(path.name)
        return tuple(found)

    def add_text(self, package: str, name: str, generation: Generation, text: str) -> None:
        """Let a text define one message, before the package that it is of.

        Args:
            package: such as ``std_msgs``.
            name: such as ``Header``.
            generation: which ROS it is written for.
            text: the definition, without those that it contains.
        """
        with self._lock:
            if self._texts.get((package, name, generation)) != text:
                self._texts[package, name, generation] = text
                self._spoken_of.add(package)
                self._changes += 1

    def clear(self) -> None:
        """Remove all that was added."""
        with self._lock:
            if self._packages or self._texts:
                self._packages.clear()
                self._texts.clear()
                self._spoken_of.clear()
                self._changes += 1

    def defines(self, package: str, name: str) -> bool:
        """Return whether what was added here, not below, says what a message is."""
        if package in self._packages:
            return True
        return any((package, name, one) in self._texts for one in Generation)

    def adds_to(self, package: str) -> bool:
        """Return whether something was added here, not below, under a package's name."""
        return package in self._packages or package in self._spoken_of

    def texts(self) -> tuple[tuple[str, str, Generation, str], ...]:
        """Return what `add_text` took."""
        with self._lock:
            return tuple((*key, text) for key, text in self._texts.items())

    def packages(self) -> tuple[tuple[str, Path, Generation | None], ...]:
        """Return what `add_package` took."""
        with self._lock:
            return tuple((name, *entry) for name, entry in self._packages.items())

    def find_source(
        self, package: str, part: str, name: str, generation: Generation
    ) -> Source | None:
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
        if part == "msg" and (text := self._texts.get((package, name, generation))) is not None:
            return Source(text, f"{package}/msg/{name}.msg", generation, is_own=True)
        if (entry := self._packages.get(package)) is not None:
            folder, written_for = entry
            file = folder / part / f"{name}.{part}"
            if not is_file(file):
                file = self._files(folder, part).get(name, file)
            if written_for in (None, generation) and is_file(file):
                text = _read(file)
                if written_for is generation or _fits(text, generation):
                    return Source(text, str(file), generation, is_own=True)
        if self._below is not None:
            return self._below.find_source(package, part, name, generation)
        found = _blocks(package, generation).get(f"{part}/{name}")
        return None if found is None else Source(found, f"<{package}/{part}/{name}>", generation)

    def block_names(
        self, generation: Generation, package: str = ""
    ) -> Iterator[tuple[str, str, str]]:
        """Yield package, part and name of every definition of one generation.

        Args:
            generation: which ROS they are written for.
            package: whose, all packages' when empty; reading them all takes a program's start
                longer than anything else.
        """
        if self._below is None:
            yield from _shipped_names(generation, package)
        else:
            yield from self._below.block_names(generation, package)
        for owner, path, written_for in sorted(self.packages()):
            if written_for in (None, generation) and package in ("", owner):
                for part in _PARTS:
                    for name in self._files(path, part):
                        yield owner, part, name
        for owner, name, written_for, _ in self.texts():
            if written_for is generation and package in ("", owner):
                yield owner, "msg", name

    def _files(self, folder: Path, part: str) -> dict[str, Path]:
        """Definitions of a package by name; CMake's DIRECTORY lets them lie in folders of msg/."""
        changes, listed = self._listed
        if changes != self._changes:
            listed = {}
            self._listed = (self._changes, listed)
        if (folder, part) not in listed:
            found: dict[str, Path] = {}
            files = (folder / part).rglob(f"*.{part}")
            for file in sorted(files, key=lambda file: (len(file.parts), file)):
                found.setdefault(file.stem, file)
            listed[folder, part] = found
        return listed[folder, part]


def _shipped_names(generation: Generation, package: str) -> Iterator[tuple[str, str, str]]:
    folder = _DATA / f"ros{generation.value}"
    owners = [package] if package else [file.stem for file in sorted(folder.glob("*.txt"))]
    for owner in owners:
        for key in _blocks(owner, generation):
            part, name = key.split("/")
            yield owner, part, name


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
