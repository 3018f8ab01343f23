"""Which programs C++ makes of a package, where they are once compiled, and how they are run."""

from __future__ import annotations

import mmap
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.diagnostics import SourceSpan
from gazelle.documents.files import is_file
from gazelle.workspace import Package
from gazelle.workspace.building.catkin_space import COMPILED_DEVEL_RECORD
from gazelle.workspace.executables import compiled_names

__all__ = [
    "CPP_VARIABLE",
    "CppProgram",
    "built_file",
    "cpp_program",
    "cpp_programs",
    "host_command",
    "is_node_file",
    "prefers_cpp",
]

CPP_VARIABLE = "GAZELLE_CPP"
"""Set to 1, nodes of C++ are run in place of Gazelle's own of the same names."""

_MARKER = b"gazelle-node-abi-1"
_ELF = b"\x7fELF"
_HOST = "gazelle.cpp.host"
_FALSE = frozenset({"", "0", "false", "no", "off"})
_WORKSPACE_MARKS = (".catkin_workspace", ".catkin_tools")
_PRUNED = frozenset({"__pycache__", "build", "devel", "install", "log"})


@dataclass(frozen=True, slots=True)
class CppProgram:
    """A program that C++ of a source package makes, compiled or not.

    Attributes:
        package: whose sources they are.
        executable: its name.
        span: where a user's file asks for it, for messages.
    """

    package: Package
    executable: str
    span: SourceSpan | None = None

    @property
    def name(self) -> str:
        """Package and executable, as in messages."""
        return f"{self.package.name}/{self.executable}"

    @property
    def words(self) -> tuple[str, str, str]:
        """The package's folder and name, and the executable's, as words of a command line."""
        return str(self.package.path), self.package.name, self.executable


def cpp_programs(package: Package) -> tuple[str, ...]:
    """Return the names of the programs that the C++ of a source package makes, sorted."""
    if package.prefix is not None or package.is_builtin:
        return ()
    return tuple(sorted(compiled_names(package.path, package.name)))


def cpp_program(
    package: Package, executable: str, span: SourceSpan | None = None
) -> CppProgram | None:
    """Return the C++ of a package behind a name, None when no C++ makes a program of that name."""
    if executable not in cpp_programs(package):
        return None
    return CppProgram(package, executable, span)


def prefers_cpp(environ: Mapping[str, str]) -> bool:
    """Tell whether C++ is wanted where Gazelle has a node of its own, too."""
    return environ.get(CPP_VARIABLE, "").strip().lower() not in _FALSE


def is_node_file(path: Path) -> bool:
    """Tell whether a file is a node that Gazelle's toolchain made."""
    try:
        with path.open("rb") as stream:
            if stream.read(len(_ELF)) != _ELF:
                return False
            with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as content:
                return content.find(_MARKER) >= 0
    except (OSError, ValueError):
        return False


def host_command(path: Path) -> tuple[str, ...]:
    """Return the words that run a node file; its arguments follow."""
    return (sys.executable, "-m", _HOST, str(path))


def built_file(program: CppProgram) -> Path | None:
    """Return what ``catkin_make`` or ``catkin build`` made of a program; None when that is old.

    It counts as old when a file of the workspace's sources was changed since the package was built.
    """
    package = program.package
    for folder in package.path.parents:
        if not any((folder / name).exists() for name in _WORKSPACE_MARKS):
            continue
        made = folder / "devel" / "lib" / package.name / program.executable
        record = folder / "build" / package.name / COMPILED_DEVEL_RECORD
        if is_file(made) and is_file(record) and is_node_file(made):
            made_ns = _changed_ns(record)
            is_new = all(_changed_ns(file) <= made_ns for file in _sources(folder / "src"))
            return made if is_new else None
        return None
    return None


def _sources(folder: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        folders[:] = [one for one in folders if one not in _PRUNED and not one.startswith(".")]
        yield from (Path(place, name) for name in names)


def _changed_ns(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:  # a link to nowhere
        return 0
