"""``eval "$(gazelle env)"``: the ROS commands and modules in this shell."""

from __future__ import annotations

import os
import shlex

from gazelle.launch.environment import node_environment
from gazelle.workspace import Workspace

__all__ = ["main"]

_HELP = """usage: eval "$(gazelle env)"

Prints shell lines that put the ROS-named commands on PATH and the drop-in modules
(rospy, tf, …) on PYTHONPATH. A real ROS keeps its own commands in other shells."""


def main(argv: list[str]) -> int:
    """Print the lines; only what differs from the environment now."""
    if argv:
        print(_HELP)
        return 0 if argv[0] in {"-h", "--help"} else 2
    environment = node_environment(os.environ, Workspace.discover())
    environment.pop("PYTHONUNBUFFERED", None)
    for name, value in sorted(environment.items()):
        if os.environ.get(name) != value:
            print(f"export {name}={shlex.quote(value)}")
    return 0
