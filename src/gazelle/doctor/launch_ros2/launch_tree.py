"""A launch file and all it includes, and where their paths lie in the source tree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.launch_file import Include, LaunchFile
from gazelle.doctor.launch_ros2.python_file import read_python_file
from gazelle.doctor.launch_ros2.xml_yaml_file import read_xml_file, read_yaml_file
from gazelle.documents.files import exists, is_file
from gazelle.workspace import Package, Workspace
from gazelle.workspace.installed_files import installed_source

__all__ = ["Followed", "follow", "located", "package_of"]

_MAX_DEPTH = 8
_MAX_FILES = 60


@dataclass(slots=True)
class Followed:
    """One file of a launch, in the place where it is included.

    Attributes:
        file: as read with these arguments.
        given: launch arguments it gets, those of the files around it too.
        include: what includes it, None for the outermost file.
        children: files it includes, those that could be read.
        has_all: every file it includes is here.
    """

    file: LaunchFile
    given: Mapping[str, str | None]
    include: Include | None = None
    children: list[Followed] = field(default_factory=list)
    has_all: bool = True

    def walk(self) -> list[Followed]:
        """Return this file and all below it."""
        return [self, *(item for child in self.children for item in child.walk())]


def located(name: str) -> Path | None:
    """Return the file that a path of a share folder means, None when there is none.

    In a source folder that is the file that its build files install to there.
    """
    path = Path(name)
    if not path.is_absolute():
        return None
    if exists(path):
        return path
    try:
        return installed_source(path)
    except (OSError, ValueError):
        # Names that are too long, or hold a NUL.
        return None


def package_of(path: Path, workspace: Workspace) -> Package | None:
    """Return the package a path lies in, None when in none."""
    for package in workspace.packages.values():
        if path.is_absolute() and path.is_relative_to(package.path):
            return package
    return None


def follow(
    path: Path,
    arguments: Mapping[str, str],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> Followed | None:
    """Read a launch file and the files it includes; None when it cannot be read.

    Args:
        path: the file.
        arguments: launch arguments by name.
        workspace: finds packages.
        diagnostics: receives errors of syntax.
    """
    reader = _Follower(workspace, diagnostics)
    return reader.read(path, dict(arguments), None, ())


class _Follower:
    def __init__(self, workspace: Workspace, diagnostics: Diagnostics) -> None:
        self._workspace = workspace
        self._diagnostics = diagnostics
        self._count = 0

    def read(
        self,
        path: Path,
        given: Mapping[str, str | None],
        include: Include | None,
        above: tuple[Path, ...],
    ) -> Followed | None:
        """Read one file and those below it."""
        self._count += 1
        if path in above or len(above) >= _MAX_DEPTH or self._count > _MAX_FILES:
            return None
        file = self._file(path, given)
        if file is None:
            return None
        found = Followed(file, given, include)
        own = {item.name: item.default for item in file.arguments}
        for inner in file.includes:
            child = self._included(inner, {**own, **given}, (*above, path))
            if child is None:
                found.has_all = False
            else:
                found.children.append(child)
        return found

    def _included(
        self, include: Include, given: Mapping[str, str | None], above: tuple[Path, ...]
    ) -> Followed | None:
        path = located(include.path) if include.path is not None else None
        if path is None or not is_file(path):
            return None
        return self.read(path, {**given, **include.arguments}, include, above)

    def _file(self, path: Path, given: Mapping[str, str | None]) -> LaunchFile | None:
        readers = {".py": read_python_file, ".yaml": read_yaml_file, ".yml": read_yaml_file}
        read = readers.get(path.suffix, read_xml_file)
        return read(path, given, workspace=self._workspace, diagnostics=self._diagnostics)
