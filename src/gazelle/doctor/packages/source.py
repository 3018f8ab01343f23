"""A source package as the checks see it: its files and what its build files say."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.workspace import Package
from gazelle.workspace.building.cmake_lists import CMakeLists, read_cmake_lists
from gazelle.workspace.building.install_rules import InstallRules, cmake_rules
from gazelle.workspace.building.setup_py import SetupFile, read_setup

__all__ = ["SourcePackage"]

_PRUNED = frozenset({"build", "devel", "install", "log", "node_modules", "__pycache__", "venv"})
_MAX_FILES = 20_000
_MAX_TEXT = 2_000_000
_TEST_FOLDERS = frozenset({"test", "tests"})


@dataclass(frozen=True)
class SourcePackage:
    """Reads each file of a package once."""

    package: Package

    @property
    def folder(self) -> Path:
        """The package's folder."""
        return self.package.path

    @property
    def share(self) -> str:
        """Its share folder below the prefix."""
        return f"share/{self.package.name}"

    @property
    def is_ros2(self) -> bool:
        """Built by ament, for ROS 2."""
        return self.build_type.startswith("ament")

    @cached_property
    def build_type(self) -> str:
        """The kind of its build files; what the manifest says when they do not tell."""
        if self.lists is not None and self.lists.called("ament_package", "ament_auto_package"):
            return "ament_cmake"
        if self.lists is not None and self.lists.called("catkin_package"):
            return "catkin"
        written = self.package.build_type
        if self.lists is None and self.setup is not None and self.setup.is_for_ament:
            return "ament_python"
        return written

    @cached_property
    def files(self) -> tuple[str, ...]:
        """All files relative to the folder, sorted; hidden ones and build products left out."""
        return tuple(sorted(_files(self.folder)))

    @cached_property
    def manifest(self) -> Tag | None:
        """``package.xml``; None when it cannot be read, or is rosbuild's."""
        path = self.folder / "package.xml"
        return read_xml(path, Diagnostics()) if path.is_file() else None

    @property
    def manifest_span(self) -> SourceSpan:
        """The place of the manifest."""
        return self.manifest.span if self.manifest is not None else self.span("package.xml")

    @cached_property
    def lists(self) -> CMakeLists | None:
        """``CMakeLists.txt``; None when there is none."""
        return read_cmake_lists(self.folder, self.package.name)

    @cached_property
    def setup(self) -> SetupFile | None:
        """``setup.py``; None when there is none."""
        return read_setup(self.folder)

    @cached_property
    def rules(self) -> InstallRules | None:
        """What is installed; None when nothing says so or it cannot be read."""
        if self.build_type == "ament_python":
            setup = self.setup
            if setup is None or setup.error is not None or not setup.is_called:
                return None
            span = setup.span or SourceSpan(str(setup.file))
            unread = () if setup.has_all_rules else (span,)
            return InstallRules(tuple(setup.rules), unread)
        if self.lists is None or self.lists.problem is not None:
            return None
        return cmake_rules(self.lists, self.share)

    @cached_property
    def build_file(self) -> Path:
        """The file that install rules are written in."""
        name = "setup.py" if self.build_type == "ament_python" else "CMakeLists.txt"
        return self.folder / name

    @property
    def has_build_file(self) -> bool:
        """Tell whether ``CMakeLists.txt`` or ``setup.py`` is there and says a name."""
        return self.lists is not None or self.setup is not None

    def is_test(self, relative: str) -> bool:
        """Tell whether a file is in a folder of tests."""
        return bool(_TEST_FOLDERS & set(PurePosixPath(relative).parts))

    def text(self, relative: str) -> str:
        """Return a file's text, empty when it is too long or not there."""
        path = self.folder / relative
        try:
            if path.stat().st_size > _MAX_TEXT:
                return ""
            return path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""

    def span(self, relative: str, line: int = 0, column: int = 0, length: int = 0) -> SourceSpan:
        """Return a place in one of the package's files."""
        return SourceSpan(str(self.folder / relative), line, column, length)


def _files(folder: Path) -> Iterator[str]:
    count = 0
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in _PRUNED and name[0] != "."]
        for name in names:
            count += 1
            if count > _MAX_FILES:
                return
            if not name.startswith("."):
                yield Path(root, name).relative_to(folder).as_posix()
