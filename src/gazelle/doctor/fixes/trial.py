"""A copy of the user's files to try fixes in: what is theirs stays as it is until they say so."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from gazelle.diagnostics import Diagnostic, SourceSpan
from gazelle.doctor.fixes.edits import SourceText, difference
from gazelle.errors import GazelleError

__all__ = ["Trial"]

_LEFT_OUT = frozenset({".git", "__pycache__", "build", "log", "node_modules"})
_MAX_FILES = 50_000
# What is not edited is linked to: meshes, bags, maps.
_EDITED_BYTES = 1 << 20
_SUFFIXES = frozenset({
    ".cfg", ".config", ".dae", ".gazebo", ".launch", ".material", ".py", ".rviz", ".sdf", ".srdf",
    ".txt", ".urdf", ".world", ".xacro", ".xml", ".yaml", ".yml",
})  # fmt: skip


@dataclass
class Trial:
    """A copy of a folder, and what the doctor says of it.

    Attributes:
        folder: of the user's.
        copy: of it.
        look: returns the findings of the copy, as the copy's.
        changed: the first texts of files that are different now, by their names in `folder`.
    """

    folder: Path
    copy: Path
    look: Callable[[Path], Sequence[Diagnostic]]
    changed: dict[str, str] = field(default_factory=dict)

    @classmethod
    @contextmanager
    def of(cls, folder: Path, look: Callable[[Path], Sequence[Diagnostic]]) -> Iterator[Trial]:
        """Copy a folder; the copy is gone afterwards."""
        with TemporaryDirectory(prefix="gazelle-doctor-") as place:
            copy = Path(place).resolve() / folder.name
            _copy(folder.resolve(), copy, [_MAX_FILES])
            yield cls(folder.resolve(), copy, look)

    def read(self, file: str) -> SourceText | None:
        """Return a file's text, None for one that lies elsewhere or is no text."""
        place = self._copied(file)
        if place is None or place.is_symlink() or not place.is_file():
            return None
        try:
            return SourceText(file, place.read_bytes().decode("utf-8"))
        except UnicodeDecodeError:
            return None

    def write(self, file: str, text: str) -> None:
        """Change a file of the copy."""
        place = self._copied(file)
        assert place is not None
        self.changed.setdefault(file, place.read_bytes().decode("utf-8"))
        place.write_bytes(text.encode("utf-8"))

    def examine(self) -> list[Diagnostic]:
        """Return what is found in the copy, as if it were the user's folder."""
        return [self._as_users(item) for item in self.look(self.copy)]

    def texts(self) -> dict[str, tuple[str, str]]:
        """Return the files that are different now, each with its text before and after."""
        found = {}
        for file, before in self.changed.items():
            source = self.read(file)
            if source is not None and source.text != before:
                found[file] = before, source.text
        return found

    def diff(self) -> str:
        """Return what is different, as a unified diff with names relative to the folder."""
        return "".join(
            difference(before, after, os.path.relpath(Path(file).resolve(), self.folder))
            for file, (before, after) in sorted(self.texts().items())
        )

    def _copied(self, file: str) -> Path | None:
        try:
            return self.copy / Path(file).resolve().relative_to(self.folder)
        except ValueError:
            return None

    def _as_users(self, item: Diagnostic) -> Diagnostic:
        copy, folder = str(self.copy), str(self.folder)
        span = item.span
        return replace(
            item,
            message=item.message.replace(copy, folder),
            fix=item.fix.replace(copy, folder),
            span=None if span is None else _renamed(span, copy, folder),
        )


def _renamed(span: SourceSpan, copy: str, folder: str) -> SourceSpan:
    via = tuple(_renamed(outer, copy, folder) for outer in span.via)
    return replace(span, file=span.file.replace(copy, folder), via=via)


def _copy(folder: Path, copy: Path, room: list[int]) -> None:
    """Copy the texts of a folder; link to what else is in it.

    Raises:
        GazelleError: it holds more files than a workspace has.
    """
    copy.mkdir(parents=True)
    for entry in sorted(os.scandir(folder), key=lambda item: item.name):
        place = copy / entry.name
        room[0] -= 1
        if room[0] < 0:
            raise GazelleError(f"'{folder}' holds more than {_MAX_FILES} files; name one package")
        if entry.name in _LEFT_OUT:
            continue
        if entry.is_dir(follow_symlinks=False):
            _copy(Path(entry.path), place, room)
        elif entry.is_file() and _is_edited(entry):
            shutil.copy(entry.path, place)
        else:
            place.symlink_to(Path(entry.path).resolve())


def _is_edited(entry: os.DirEntry[str]) -> bool:
    name = Path(entry.name)
    is_text = name.suffix.lower() in _SUFFIXES or not name.suffix
    return is_text and entry.stat().st_size <= _EDITED_BYTES
