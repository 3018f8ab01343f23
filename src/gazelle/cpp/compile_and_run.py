"""C++ from its sources: ``python -m gazelle.cpp.compile_and_run FOLDER PACKAGE EXECUTABLE args…``.

``PACKAGE/EXECUTABLE`` in place of the three words is a program of Gazelle's own.

Launchers compile all they start before they start it. This is for everybody else who has a node's
command, and for nodes that are started again after their sources have changed.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from gazelle.cpp.lookup import host_command
from gazelle.diagnostics import Diagnostics, render
from gazelle.errors import GazelleError
from gazelle.process_lifetime import end_at_interrupts, interrupts_held

__all__ = ["main"]

_WORDS = 3
_NOT_COMPILED = 126


def main(argv: list[str]) -> int:
    """Compile a program and become it."""
    is_own = bool(argv) and not argv[0].startswith("/") and "/" in argv[0]
    if not is_own and len(argv) < _WORDS:
        usage = "usage: python -m gazelle.cpp.compile_and_run FOLDER PACKAGE EXECUTABLE [args…]\n"
        sys.stderr.write(usage)
        return 2
    end_at_interrupts()
    file, rest = (_own_program(argv[0]), argv[1:]) if is_own else (_program(argv), argv[_WORDS:])
    if file is None:
        return _NOT_COMPILED
    command = [*host_command(file), *rest]
    sys.stdout.flush()
    try:
        with interrupts_held():
            os.execv(command[0], command)  # noqa: S606 - running the node is the purpose
    except OSError as error:
        sys.stderr.write(f"cannot run '{command[0]}': {error.strerror}\n")
        return _NOT_COMPILED


def _program(argv: list[str]) -> Path | None:
    from gazelle.cpp.building.build import ensure_built
    from gazelle.workspace import Workspace

    folder, name, executable = argv[:_WORDS]
    workspace, diagnostics = Workspace.discover(extra=[folder]), Diagnostics()
    file = ensure_built(
        workspace.package(name), executable, workspace=workspace, diagnostics=diagnostics
    )
    render(diagnostics)
    return file


def _own_program(name: str) -> Path | None:
    from gazelle.cpp.provided_programs import ensure_program, provided_program

    package, _, executable = name.partition("/")
    program = provided_program(package, executable)
    if program is None:
        sys.stderr.write(f"there is no program '{name}' in C++ of Gazelle's\n")
        return None
    try:
        return ensure_program(program)
    except GazelleError as error:
        sys.stderr.write(f"{name}: {error}\n")
        return None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
