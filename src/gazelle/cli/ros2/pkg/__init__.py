"""``ros2 pkg``: what packages there are, what is in them, and new ones."""

from __future__ import annotations

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["main"]

_HERE = "gazelle.cli.ros2.pkg"
_VERBS = {
    "create": Verb("Create a new ROS 2 package", "gazelle.cli.ros2.pkg_create"),
    "executables": Verb("Output a list of package specific executables", f"{_HERE}.executables"),
    "list": Verb("Output a list of available packages", f"{_HERE}.listing"),
    "prefix": Verb("Output the prefix path of a package", f"{_HERE}.listing"),
    "xml": Verb("Output the XML of the package manifest or a specific tag", f"{_HERE}.manifest"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 pkg``."""
    return run_command(Command("pkg", "Various package related sub-commands", _VERBS), argv)
