"""What a build lets somebody else do: compiling, which layers above know how to.

Without such a step everything but compiled code is built, and each target is told.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, Protocol

from gazelle.workspace.building.packages import SourcePackage

__all__ = ["CompileRequest", "CompileStep", "Compiled"]


@dataclass(frozen=True, slots=True)
class CompileRequest:
    """A package whose C++ is to be compiled.

    Attributes:
        package: its sources.
        build: folder for what the compiler leaves behind.
        devel: catkin's devel space, which gets programs and libraries; None for others.
        install: prefix that gets programs, libraries and headers; None to install nothing.
        definitions: variables for ``CMakeLists.txt``.
        prefixes: spaces that packages built before have been put into.
        jobs: compilers at a time, 0 for as many as there are cores.
        others: packages of the workspace, whose messages are read from their sources.
    """

    package: SourcePackage
    build: Path
    devel: Path | None = None
    install: Path | None = None
    definitions: Mapping[str, str] = field(default_factory=dict)
    prefixes: tuple[Path, ...] = ()
    jobs: int = 0
    others: tuple[SourcePackage, ...] = ()


class Compiled(NamedTuple):
    """How compiling ended.

    Attributes:
        code: exit code, 0 for success.
        output: what was done, line by line.
        errors: the compiler's words and findings, rendered, for standard error.
    """

    code: int = 0
    output: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()


class CompileStep(Protocol):
    """Compiles a package; called in threads."""

    def __call__(self, request: CompileRequest) -> Compiled:
        """Compile and install."""
        ...
