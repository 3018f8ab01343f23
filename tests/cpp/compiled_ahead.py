"""Compiles what a test will run: on a cold cache that takes longer than commands have patience."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.cpp.building.build import ensure_built, ensure_library_built
from gazelle.cpp.building.runtime import ensure_runtime, libraries_for
from gazelle.diagnostics import Diagnostics, render_text
from gazelle.workspace import Workspace

__all__ = ["compile_ahead"]


def compile_ahead(
    folder: Path,
    package: str,
    *programs: str,
    libraries: Sequence[str] = (),
    runtime: Sequence[str] = (),
) -> None:
    """Compile programs and libraries of a package, and runtime libraries.

    Args:
        folder: of the workspace.
        package: its name.
        programs: names of executables.
        libraries: names of library targets.
        runtime: runtime libraries of ROS 1 that are loaded by name.
    """
    workspace = Workspace.discover(extra=[folder / "src"], environ={}, cwd=folder)
    diagnostics = Diagnostics()
    wanted = workspace.package(package)
    files = [
        ensure_built(wanted, name, workspace=workspace, diagnostics=diagnostics)
        for name in programs
    ]
    files += [
        ensure_library_built(wanted, name, workspace=workspace, diagnostics=diagnostics)
        for name in libraries
    ]
    assert all(files), "\n".join(map(render_text, diagnostics))
    for file in files:
        if file is not None:
            libraries_for(file)
    if runtime:
        ensure_runtime(runtime, 1)
