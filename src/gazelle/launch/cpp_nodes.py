"""C++ that a launch is about to start, compiled before it starts anything: all at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from gazelle.diagnostics import Diagnostics
from gazelle.launch.node_commands import Executable, compiled_executable, find_executable
from gazelle.workspace import Workspace

__all__ = ["compiled_ahead", "find_and_compile"]


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
    programs = [one.cpp for one in found if one is not None and one.cpp is not None]
    if not programs:
        return list(found)
    # Only here: who starts no C++ has nothing of compilers loaded.
    from gazelle.cpp.build import ensure_all_built

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
