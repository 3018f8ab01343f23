"""``python -m gazelle.cpp.compile_and_run FOLDER PACKAGE EXECUTABLE args…``: C++ from its sources.

Launchers compile all they start before they start it. This is for everybody else who has a node's
command, and for nodes that are started again after their sources have changed.
"""

from __future__ import annotations

import os
import sys

from gazelle.cpp.lookup import host_command
from gazelle.diagnostics import Diagnostics, render
from gazelle.process_lifetime import end_at_interrupts, interrupts_held

__all__ = ["main"]

_WORDS = 3
_NOT_COMPILED = 126


def main(argv: list[str]) -> int:
    """Compile a program and become it."""
    if len(argv) < _WORDS:
        usage = "usage: python -m gazelle.cpp.compile_and_run FOLDER PACKAGE EXECUTABLE [args…]\n"
        sys.stderr.write(usage)
        return 2
    end_at_interrupts()
    from gazelle.cpp.build import ensure_built
    from gazelle.workspace import Workspace

    folder, name, executable = argv[:_WORDS]
    workspace, diagnostics = Workspace.discover(extra=[folder]), Diagnostics()
    file = ensure_built(
        workspace.package(name), executable, workspace=workspace, diagnostics=diagnostics
    )
    render(diagnostics)
    if file is None:
        return _NOT_COMPILED
    command = [*host_command(file), *argv[_WORDS:]]
    sys.stdout.flush()
    try:
        with interrupts_held():
            os.execv(command[0], command)  # noqa: S606 - running the node is the purpose
    except OSError as error:
        sys.stderr.write(f"cannot run '{command[0]}': {error.strerror}\n")
        return _NOT_COMPILED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
