"""``gazelle shell``: a shell, or one command, with the ROS commands and modules."""

from __future__ import annotations

import os

from gazelle.launch.environment import node_environment
from gazelle.workspace import Workspace

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Become the user's shell, or the command given."""
    environment = node_environment(os.environ, Workspace.discover())
    command = argv or [os.environ.get("SHELL", "/bin/sh")]
    try:
        os.execvpe(command[0], command, environment)  # noqa: S606 - running it is the purpose
    except OSError as error:
        print(f"gazelle shell: cannot run '{command[0]}': {error.strerror}")
        return 127
