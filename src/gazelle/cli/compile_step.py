"""Compiling for the commands that build workspaces."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from gazelle.workspace.building.build import needs_compiler
from gazelle.workspace.building.compile_step import Compiled, CompileRequest, CompileStep
from gazelle.workspace.building.packages import SourcePackage

__all__ = ["compile_step_for"]


def compile_step_for(
    packages: Sequence[SourcePackage],
    definitions: Mapping[str, str],
    *,
    command: str,
    said: Callable[[str], None] | None = None,
    jobs: int = 0,
) -> CompileStep | None:
    """Return what compiles the C++ of packages; None where there is none, or no compiler.

    Without a compiler, and that is said once, everything else of the packages is built.

    Args:
        packages: those that are built.
        definitions: variables for ``CMakeLists.txt``.
        command: the command's name, for what is said.
        said: gets each line of a build as it comes.
        jobs: compilers at a time, 0 for as many as there are cores.
    """
    if not any(needs_compiler(package, definitions) for package in packages):
        return None
    from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain

    try:
        find_toolchain()
    except NoToolchainError as error:
        print(f"{command}: C++ is left out: {error}", file=sys.stderr, flush=True)
        return None

    def compiled(request: CompileRequest) -> Compiled:
        from gazelle.cpp.building.build import build_package

        return build_package(replace(request, jobs=jobs), said=said)

    return compiled
