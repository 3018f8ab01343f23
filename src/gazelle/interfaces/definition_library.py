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
from gazelle.interfaces.definition import RosVersion

__all__ = ["Library", "Source"]

_DATA = Path(__file__).parent / "definitions"
_PARTS = ("msg", "srv", "action")
_ROS1_WORDS = ("Header", "time", "duration")


class Source(NamedTuple):
    """One definition's text.

    Attributes:
        text: the whole text, all parts.
        file: path of the file, or the name in angle brackets for built-in data.
        ros_version: which ROS it was written for.
        is_own: whether a user or a bag wrote it, not Gazelle.
    """

    text: str
    file: str
    ros_version: RosVersion
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
        self._packages: dict[str, tuple[Path, RosVersion | None]] = {}
        self._texts: dict[tuple[str, str, RosVersion], str] = {}
        self._spoken_of: set[str] = set()  # packages that texts are of
        self._changes = 0
        self._listed: tuple[int, dict[tuple[Path, str], dict[str, Path]]] = (0, {})

    @property
    def revision(self) -> int:
        """A number that is raised whenever something is added, or all of it removed."""
        return self._changes if self._below is None else self._changes + self._below.revision

    def add_package(
        self, name: str, path: Path | str, ros_version: RosVersion | None = None
    ) -> None:
        """Let a user's own package define types; its msg/, srv/ and action/ are read when needed.

        Args:
            name: the package's name.
            path: its folder.
            ros_version: which ROS the files are written for; read from ``package.xml`` when None.

        Raises:
            NotFoundError: there is no such folder.
        """
        folder = Path(path)
        if not folder.is_dir():
            hint = f"package '{name}' is not added"
            raise NotFoundError("package folder", str(folder), hint=hint)
        with self._lock:
            entry = (folder, ros_version or _package_ros_version(folder))
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

    def add_text(self, package: str, name: str, ros_version: RosVersion, text: str) -> None:
        """Let a text define one message, before the package that it is of.

        Args:
            package: such as ``std_msgs``.
            name: such as ``Header``.
            ros_version: which ROS it is written for.
            text: the definition, without those that it contains.
        """
        with self._lock:
            if self._texts.get((package, name, ros_version)) != text:
                self._texts[package, name, ros_version] = text
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
        return any((package, name, one) in self._texts for one in RosVersion)

    def adds_to(self, package: str) -> bool:
        """Return whether something was added here, not below, under a package's name."""
        return package in self._packages or package in self._spoken_of

    def texts(self) -> tuple[tuple[str, str, RosVersion, str], ...]:
        """Return what `add_text` took."""
        with self._lock:
            return tuple((*key, text) for key, text in self._texts.items())

    def packages(self) -> tuple[tuple[str, Path, RosVersion | None], ...]:
        """Return what `add_package` took."""
        with self._lock:
            return tuple((name, *entry) for name, entry in self._packages.items())

    def find_source(
        self, package: str, part: str, name: str, ros_version: RosVersion
    ) -> Source | None:
        """Return the text of a definition of one generation, None when there is none.

        A user's own package comes before the data of Gazelle.

        Args:
            package: such as ``std_msgs``.
            part: ``msg``, ``srv`` or ``action``.
            name: such as ``Header``.
            ros_version: which ROS it must be written for.

        Raises:
            UserFileError: the file is there and cannot be read.
        """
        if part == "msg" and (text := self._texts.get((package, name, ros_version))) is not None:
            return Source(text, f"{package}/msg/{name}.msg", ros_version, is_own=True)
        if (entry := self._packages.get(package)) is not None:
            folder, written_for = entry
            file = folder / part / f"{name}.{part}"
            if not is_file(file):
                file = self._files(folder, part).get(name, file)
            if written_for in (None, ros_version) and is_file(file):
                text = _read(file)
                if written_for is ros_version or _fits(text, ros_version):
                    return Source(text, str(file), ros_version, is_own=True)
        if self._below is not None:
            return self._below.find_source(package, part, name, ros_version)
        found = _blocks(package, ros_version).get(f"{part}/{name}")
        return None if found is None else Source(found, f"<{package}/{part}/{name}>", ros_version)

    def block_names(
        self, ros_version: RosVersion, package: str = ""
    ) -> Iterator[tuple[str, str, str]]:
        """Yield package, part and name of every definition of one generation.

        Args:
            ros_version: which ROS they are written for.
            package: whose, all packages' when empty; reading them all takes a program's start
                longer than anything else.
        """
        if self._below is None:
            yield from _shipped_names(ros_version, package)
        else:
            yield from self._below.block_names(ros_version, package)
        for owner, path, written_for in sorted(self.packages()):
            if written_for in (None, ros_version) and package in ("", owner):
                for part in _PARTS:
                    for name in self._files(path, part):
                        yield owner, part, name
        for owner, name, written_for, _ in self.texts():
            if written_for is ros_version and package in ("", owner):
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


def _shipped_names(ros_version: RosVersion, package: str) -> Iterator[tuple[str, str, str]]:
    folder = _DATA / f"ros{ros_version.value}"
    owners = [package] if package else [file.stem for file in sorted(folder.glob("*.txt"))]
    for owner in owners:
        for key in _blocks(owner, ros_version):
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
def _blocks(package: str, ros_version: RosVersion) -> dict[str, str]:
    if not package.isidentifier():
        return {}
    file = _DATA / f"ros{ros_version.value}" / f"{package}.txt"
    if not is_file(file):
        return {}
    blocks: dict[str, str] = {}
    for block in file.read_text(encoding="utf-8").split("=== ")[1:]:
        key, _, text = block.partition("\n")
        blocks[key] = text.rstrip("\n")
    return blocks


def _package_ros_version(folder: Path) -> RosVersion | None:
    """Read from the build tool that ``package.xml`` names; REP-140 and REP-149."""
    manifest = folder / "package.xml"
    if not manifest.is_file():
        return RosVersion.ROS1 if (folder / "manifest.xml").is_file() else None
    text = manifest.read_text(encoding="utf-8", errors="replace")
    ros1 = "catkin" in text or "message_generation" in text
    ros2 = "ament" in text or "rosidl" in text
    if ros1 == ros2:
        return None
    return RosVersion.ROS1 if ros1 else RosVersion.ROS2


def _fits(text: str, ros_version: RosVersion) -> bool:
    """Guess from what only one generation can write; a neutral text fits both."""
    lines = [line.partition("#")[0].split() for line in text.splitlines()]
    if ros_version is RosVersion.ROS2:
        return not any(tokens and tokens[0].partition("[")[0] in _ROS1_WORDS for tokens in lines)
    return not any(_is_ros2_line(tokens) for tokens in lines)


def _is_ros2_line(tokens: list[str]) -> bool:
    if not tokens:
        return False
    has_default = len(tokens) > 2 and "=" not in "".join(tokens[1:])
    return has_default or "<=" in tokens[0] or tokens[0].startswith(("wstring", "builtin_interf"))
