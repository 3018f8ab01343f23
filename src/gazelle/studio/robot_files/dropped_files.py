"""Files that a person has dropped on the page: kept in a folder of Studio's own, within bounds.

They are data. Names are checked before anything is written, archives are unpacked by the same
rules, and nothing of them is ever run; what xacro evaluates is bounded by its own reader.
"""

from __future__ import annotations

import base64
import binascii
import secrets
import shutil
import tempfile
import threading
import zipfile
from collections import OrderedDict
from pathlib import Path, PurePosixPath

from gazelle.studio.errors import StudioError

__all__ = ["DroppedFiles"]

_MOST_SETS = 4
_MOST_FILES = 4000
_MOST_BYTES = 512 << 20
_MOST_NAME = 400
_CHUNK = 1 << 20
_ARCHIVE = ".zip"


class _Set:
    """What was dropped at once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.files = 0
        self.size = 0

    def take(self, name: str, data: bytes, *, is_more: bool) -> Path:
        """Write a file, or add to it."""
        path = self.folder.joinpath(*_parts(name))
        is_new = not is_more
        self.files += is_new
        self.size += len(data)
        self.check()
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("wb" if is_new else "ab") as file:
                file.write(data)
        except OSError as error:
            raise StudioError(f"'{name}' cannot be kept: {error.strerror}") from error
        return path

    def check(self) -> None:
        """Refuse what is too much."""
        if self.files > _MOST_FILES:
            raise StudioError(f"these are more than {_MOST_FILES} files", hint="drop the package")
        if self.size > _MOST_BYTES:
            most = _MOST_BYTES >> 20
            raise StudioError(f"the files have more than {most} MiB", hint="drop fewer of them")


class DroppedFiles:
    """The last few sets of files; they go with it."""

    def __init__(self) -> None:
        """Hold nothing."""
        self._lock = threading.Lock()
        self._root: Path | None = None
        self._sets: OrderedDict[str, _Set] = OrderedDict()

    def begin(self) -> str:
        """Return the name of a new set."""
        with self._lock:
            if self._root is None:
                self._root = Path(tempfile.mkdtemp(prefix="gazelle-dropped-"))
            name = secrets.token_hex(8)
            folder = self._root / name
            folder.mkdir()
            self._sets[name] = _Set(folder)
            while len(self._sets) > _MOST_SETS:
                _, old = self._sets.popitem(last=False)
                shutil.rmtree(old.folder, ignore_errors=True)
        return name

    def put(self, name: str, file: str, content: str, *, is_more: bool) -> None:
        """Add a file, or a piece of one that is long.

        Args:
            name: of the set.
            file: its name, with the folders below the one that was dropped.
            content: in base64.
            is_more: it goes on behind what is there.

        Raises:
            StudioError: the set is gone, the name leads elsewhere, or it is too much.
        """
        try:
            data = base64.b64decode(content, validate=True)
        except (binascii.Error, ValueError) as error:
            raise StudioError(f"'{file}' cannot be read: {error}") from None
        with self._lock:
            self._set(name).take(file, data, is_more=is_more)

    def folder(self, name: str) -> Path:
        """Return the folder of a set with its archives unpacked.

        Raises:
            StudioError: the set is gone, or an archive cannot be unpacked.
        """
        with self._lock:
            found = self._set(name)
            for path in sorted(found.folder.rglob(f"*{_ARCHIVE}")):
                _unpack(path, found)
            return found.folder

    def close(self) -> None:
        """Remove all of them."""
        with self._lock:
            root, self._root = self._root, None
            self._sets.clear()
        if root is not None:
            shutil.rmtree(root, ignore_errors=True)

    def _set(self, name: str) -> _Set:
        if name not in self._sets:
            raise StudioError("these files are not here any more", hint="drop them again")
        return self._sets[name]


def _parts(name: str) -> tuple[str, ...]:
    """Return a name's parts, all of them below the set's folder."""
    parts = PurePosixPath(name).parts
    is_odd = any(part in ("..", "/") or "\\" in part or ":" in part for part in parts)
    if not parts or is_odd or "\0" in name or len(name) > _MOST_NAME:
        raise StudioError(f"'{name[:_MOST_NAME]}' is no name of a file in a folder")
    return parts


def _unpack(path: Path, into: _Set) -> None:
    """Unpack an archive beside itself, and remove it."""
    base = path.parent.relative_to(into.folder)
    try:
        with zipfile.ZipFile(path) as packed:
            for item in packed.infolist():
                # A link is a file with a path in it, as long as nobody makes one of it.
                if not item.is_dir():
                    _unpack_file(packed, item, base, into)
    except (zipfile.BadZipFile, zipfile.LargeZipFile, NotImplementedError, RuntimeError,
            EOFError, OSError) as error:  # fmt: skip
        raise StudioError(f"'{path.name}' cannot be unpacked: {error}") from error
    path.unlink()


def _unpack_file(packed: zipfile.ZipFile, item: zipfile.ZipInfo, base: Path, into: _Set) -> None:
    name = (PurePosixPath(base.as_posix()) / item.filename).as_posix()
    if item.filename.startswith(("/", "\\")):
        _parts(item.filename)
    is_more = False
    with packed.open(item) as stream:
        # Sizes in an archive's list may be lies.
        while (data := stream.read(_CHUNK)) or not is_more:
            into.take(name, data, is_more=is_more)
            is_more = True
