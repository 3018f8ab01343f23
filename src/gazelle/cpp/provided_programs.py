"""Programs of ROS packages that are C++ of ours: runtime libraries with a program in them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

__all__ = ["PROVIDED_PROGRAMS", "ProvidedProgram", "ensure_program", "provided_program"]


@dataclass(frozen=True, slots=True)
class ProvidedProgram:
    """A program under the name of a package and an executable.

    Attributes:
        package: as in ``rosrun``.
        executable: its name.
        library: the runtime library that has it as ``gazelle_node_main``.
        generation: the ROS that it belongs to.
    """

    package: str
    executable: str
    library: str
    generation: int


PROVIDED_PROGRAMS: dict[tuple[str, str], ProvidedProgram] = {
    (row.package, row.executable): row
    for row in (ProvidedProgram("nodelet", "nodelet", "nodelet_program", 1),)
}


def provided_program(package: str, executable: str) -> ProvidedProgram | None:
    """Return the program of a name, None where there is none of ours."""
    return PROVIDED_PROGRAMS.get((package, executable))


def ensure_program(program: ProvidedProgram) -> Path:
    """Return the file that `gazelle.cpp.host` runs, compiled where it has to be.

    Raises:
        GazelleError: it cannot be compiled, there is no compiler, or no place for it.
    """
    # Only here: whoever looks for a name builds nothing.
    from gazelle.cpp.building.runtime import ensure_runtime
    from gazelle.cpp.building.toolchain import find_toolchain

    runtime = ensure_runtime([program.library], program.generation, find_toolchain())
    return runtime.libraries[program.library]
