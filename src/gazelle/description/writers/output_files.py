"""Files that go beside a converted text, and how the text names files."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.workspace import Workspace

__all__ = ["Converted", "OutputFiles"]


@dataclass(frozen=True, slots=True)
class Converted:
    """A description in another format.

    Attributes:
        text: the file's content.
        files: content of files it names, by path relative to the text's folder.
    """

    text: str
    files: dict[str, bytes]


@dataclass(slots=True)
class OutputFiles:
    """Where a converted text will stand, and the files it gets as company.

    Attributes:
        folder: the text's folder; None when it goes to a pipe and can have no company.
        stem: the text's file name without its ending; names the folder of its files.
        workspace: the packages there are.
        package: package that files shall be named by, empty for the one they lie in.
        relative: files are named relative to the text (MJCF, SDF), not by ``file://`` (URDF).
        files: what is to be written, by path relative to `folder`.
        to_copy: addresses given to files that do not lie in their package yet.
    """

    folder: Path | None = None
    stem: str = "model"
    workspace: Workspace | None = None
    package: str = ""
    relative: bool = False
    files: dict[str, bytes] = field(default_factory=dict)
    to_copy: dict[str, Path] = field(default_factory=dict)
    _named: dict[bytes, str] = field(default_factory=dict)

    def add(self, name: str, data: bytes) -> str | None:
        """Keep a file and return its address; None when there is no folder for it.

        Args:
            name: file name wanted; it is numbered when taken.
            data: content; the same content is kept once.
        """
        if self.folder is None:
            return None
        if data not in self._named:
            self._named[data] = self._free(re.sub(r"[^\w.+-]+", "_", name))
            self.files[self._named[data]] = data
        relative = self._named[data]
        return relative if self.relative else self.address(self.folder.resolve() / relative)

    def address(self, path: Path | None, written: str = "") -> str:
        """Return how the text names a file.

        ``package://`` where the file lies in a package, or the one asked for; otherwise the
        path. A file that was not found keeps the address it was written with.

        Args:
            path: the file, None when it was not found.
            written: its address in the source.
        """
        if path is None:
            return written
        path = path.resolve()
        if self.package and not written.startswith(f"package://{self.package}/"):
            return self._in_package(path, written)
        if written.startswith("package://"):
            return written
        return self._known_package(path) or self._plain(path)

    def _in_package(self, path: Path, written: str) -> str:
        root = self._root(self.package)
        if root is not None and path.is_relative_to(root):
            return f"package://{self.package}/{path.relative_to(root).as_posix()}"
        scheme = re.match(r"(?:model|package)://[^/]+/(.+)", written)
        rest = scheme[1] if scheme else f"meshes/{path.name}"
        address = f"package://{self.package}/{rest}"
        if root is None or not (root / rest).exists():
            self.to_copy[address] = path
        return address

    def _known_package(self, path: Path) -> str:
        packages = self.workspace.packages if self.workspace is not None and path.exists() else {}
        for name in packages:
            root = self._root(name)
            if root is not None and path.is_relative_to(root):
                return f"package://{name}/{path.relative_to(root).as_posix()}"
        return ""

    def _root(self, name: str) -> Path | None:
        if self.workspace is None or name not in self.workspace.packages:
            return None
        return self.workspace.package(name).path.resolve()

    def _plain(self, path: Path) -> str:
        folder = self.folder.resolve() if self.folder is not None else None
        if self.relative and folder is not None and path.is_relative_to(folder):
            return path.relative_to(folder).as_posix()
        return path.as_posix() if self.relative else path.as_uri()

    def _free(self, name: str) -> str:
        base, dot, suffix = name.rpartition(".")
        path, count = f"{self.stem}_files/{name}", 2
        while path in self.files:
            path, count = f"{self.stem}_files/{base}_{count}{dot}{suffix}", count + 1
        return path
