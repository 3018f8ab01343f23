"""``ros2 component``: components of C++ in containers."""

from __future__ import annotations

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["main"]

_HERE = "gazelle.cli.ros2.component"
_VERBS = {
    "list": Verb("Output a list of running containers and components", f"{_HERE}.running"),
    "load": Verb("Load a component into a container node", f"{_HERE}.running"),
    "standalone": Verb("Run a component into its own standalone container node", f"{_HERE}.types"),
    "types": Verb("Output a list of components registered in the ament index", f"{_HERE}.types"),
    "unload": Verb("Unload a component from a container node", f"{_HERE}.running"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 component``."""
    about = "Various component related sub-commands"
    return run_command(Command("component", about, _VERBS), argv)
