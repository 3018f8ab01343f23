"""C++ that a launch is about to start, compiled before it starts anything: all at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cpp.lookup import CppProgram, host_command
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import GazelleError
from gazelle.launch.node_commands import Executable, compiled_executable, find_executable
from gazelle.workspace import Package, Workspace

if TYPE_CHECKING:
    from gazelle.cpp.provided_programs import ProvidedProgram

__all__ = ["all_of_package", "compiled_ahead", "find_and_compile"]


def all_of_package(package: Package, span: SourceSpan | None = None) -> Executable:
    """Return what stands for all C++ of a package: its libraries, which others load."""
    return Executable((), folder=package.path, is_of_cpp=True, cpp=CppProgram(package, "", span))


def compiled_ahead(
    found: Sequence[Executable | None],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    environ: Mapping[str, str] | None = None,
) -> list[Executable | None]:
    """Compile what is not compiled yet, on all cores; return how each is run.

    Args:
        found: what `find_executable` has found, in any order.
        workspace: where packages are.
        diagnostics: receives the compiler's words.
        environ: environment variables; the process's own when None.

    Returns:
        As many as were given; None for what was None and for what does not compile.
    """
    found = _with_provided(found, diagnostics)
    programs = [one.cpp for one in found if one is not None and one.cpp is not None]
    if not programs:
        return list(found)
    # Only here: who starts no C++ has nothing of compilers loaded.
    from gazelle.cpp.building.build import ensure_all_built

    wanted = [(one.package, one.executable, one.span) for one in dict.fromkeys(programs)]
    files = ensure_all_built(wanted, workspace=workspace, diagnostics=diagnostics, environ=environ)
    ready: list[Executable | None] = []
    for one in found:
        if one is None or one.cpp is None:
            ready.append(one)
            continue
        file = files.get((one.cpp.package.name, one.cpp.executable))
        made = None if file is None else compiled_executable(file)
        ready.append(made and replace(made, takes_ros_args=one.takes_ros_args))
    return ready


def _with_provided(
    found: Sequence[Executable | None], diagnostics: Diagnostics
) -> list[Executable | None]:
    """Return the same with Gazelle's own programs in C++ compiled; None for what is not."""
    files: dict[ProvidedProgram, Path | None] = {}
    for one in found:
        if one is not None and one.provided is not None and one.provided not in files:
            files[one.provided] = _compiled_program(one.provided, diagnostics)
    ready: list[Executable | None] = []
    for one in found:
        if one is None or one.provided is None:
            ready.append(one)
            continue
        file = files[one.provided]
        ready.append(None if file is None else replace(one, command=host_command(file)))
    return ready


def _compiled_program(program: ProvidedProgram, diagnostics: Diagnostics) -> Path | None:
    from gazelle.cpp.building.toolchain import NoToolchainError
    from gazelle.cpp.provided_programs import ensure_program

    try:
        return ensure_program(program)
    except NoToolchainError as error:
        diagnostics.report("cpp.no-compiler", str(error).partition("\n")[0])
    except GazelleError as error:
        text = f"{program.package}/{program.executable}: {error}"
        diagnostics.report("cpp.compile-error", text)
    return None


def find_and_compile(
    package: str,
    type_name: str,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    environ: Mapping[str, str] | None = None,
    ros_version: int = 1,
) -> Executable | None:
    """Return what runs a node, compiled where it has to be; None and why where there is nothing.

    Args:
        package: whose it is.
        type_name: the executable's name.
        workspace: where packages are.
        diagnostics: receives why there is nothing.
        environ: environment variables; the process's own when None.
        ros_version: whose commands the messages name.
    """
    found = find_executable(
        package,
        type_name,
        workspace=workspace,
        diagnostics=diagnostics,
        environ=environ,
        ros_version=ros_version,
    )
    (ready,) = compiled_ahead(
        [found], workspace=workspace, diagnostics=diagnostics, environ=environ
    )
    return ready
