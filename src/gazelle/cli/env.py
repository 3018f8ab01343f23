"""``eval "$(gazelle env)"``: the ROS commands and modules in this shell."""

from __future__ import annotations

import argparse
import os
import shlex
from pathlib import Path

from gazelle.cli.commands import COMMANDS
from gazelle.cli.shell_functions import SHELLS, shell_lines
from gazelle.launch.environment import ROS_COMMANDS, node_environment
from gazelle.workspace import Workspace

__all__ = ["main"]

_ABOUT = """Prints shell lines that put the ROS-named commands on PATH and the drop-in modules
(rospy, tf, …) on PYTHONPATH, and define roscd, rosls, rosed, roscp and completion.
A real ROS keeps its own commands in other shells."""


def main(argv: list[str]) -> int:
    """Print the lines; of the variables, only what differs from the environment now."""
    parser = argparse.ArgumentParser(
        prog="gazelle env",
        usage='eval "$(gazelle env)"        (fish: gazelle env --shell fish | source)',
        description=_ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    own = Path(os.environ.get("SHELL", "")).name
    parser.add_argument(
        "--shell", choices=SHELLS, default=own if own in SHELLS else "sh", help="(yours: $SHELL)"
    )
    try:
        shell = parser.parse_args(argv).shell
    except SystemExit as stop:
        return int(stop.code or 0)
    environment = node_environment(os.environ, Workspace.discover())
    environment.pop("PYTHONUNBUFFERED", None)
    for name, value in sorted(environment.items()):
        if os.environ.get(name) != value:
            word = shlex.quote(value)
            print(f"set -gx {name} {word}" if shell == "fish" else f"export {name}={word}")
    print(shell_lines(shell, [name for name in ROS_COMMANDS if name in COMMANDS]), end="")
    return 0
