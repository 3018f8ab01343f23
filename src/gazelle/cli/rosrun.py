"""``rosrun [--prefix P] PACKAGE TYPE args…``: one node in the foreground."""

from __future__ import annotations

import os
import shlex
import sys
from contextlib import nullcontext

from gazelle.cpp.lookup import CPP_VARIABLE
from gazelle.diagnostics import Diagnostics, render
from gazelle.launch.cpp_nodes import find_and_compile
from gazelle.launch.environment import is_own_command, node_environment
from gazelle.launch.spawner_sequence import is_simulator
from gazelle.process_lifetime import interrupts_held
from gazelle.workspace import Workspace

__all__ = ["main"]

_USAGE = """Usage: rosrun [--prefix cmd] [--cpp] PACKAGE EXECUTABLE [ARGS]
  rosrun will locate PACKAGE and try to find
  an executable named EXECUTABLE in the PACKAGE tree.
  If it finds it, it will run it with ARGS.
  --cpp takes the package's C++ where Gazelle has a node of that name."""


def main(argv: list[str]) -> int:
    """Become the node: this process turns into it, so signals and the terminal are its own."""
    prefix: list[str] = []
    while argv and argv[0].startswith("-"):
        if argv[0] in {"--prefix", "-p"} and len(argv) > 1:
            prefix, argv = shlex.split(argv[1]), argv[2:]
        elif argv[0] in {"--debug", "-d"}:
            argv = argv[1:]
        elif argv[0] == "--cpp":
            os.environ[CPP_VARIABLE] = "1"
            argv = argv[1:]
        else:
            print(_USAGE)
            return 0 if argv[0] in {"-h", "--help"} else 1
    if len(argv) < 2:
        print(_USAGE)
        return 1
    package, type_name, *rest = argv
    workspace, diagnostics = Workspace.discover(), Diagnostics()
    found = find_and_compile(package, type_name, workspace=workspace, diagnostics=diagnostics)
    if found is None or found.is_of_cpp or diagnostics.by_code("launch.builtin-instead"):
        render(diagnostics)
    if found is None:
        return 3
    command = [*prefix, *found.command, *rest]
    # What it starts is ROS 1's, whichever ROS the shell was set up for.
    environment = node_environment({**os.environ, "ROS_VERSION": "1"}, workspace)
    sys.stdout.flush()
    if is_simulator(found):
        # Nothing else that is run here needs the graph.
        from gazelle.launch.real_ros import start_bridges

        start_bridges(environment)
    held = interrupts_held() if is_own_command(command, environment["PATH"]) else nullcontext()
    try:
        with held:
            os.execvpe(command[0], command, environment)  # noqa: S606 - running the node is the purpose
    except OSError as error:
        print(f"rosrun: cannot run '{command[0]}': {error.strerror}", file=sys.stderr)
        return 126
