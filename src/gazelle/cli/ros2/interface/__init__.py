"""``ros2 interface``: messages, services and actions, and what they consist of."""

from __future__ import annotations

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["main"]

_HERE = "gazelle.cli.ros2.interface"
_VERBS = {
    "list": Verb("List all interface types available", f"{_HERE}.listing"),
    "package": Verb(
        "Output a list of available interface types within one package", f"{_HERE}.listing"
    ),
    "packages": Verb("Output a list of packages that provide interfaces", f"{_HERE}.listing"),
    "proto": Verb("Output an interface prototype", f"{_HERE}.proto"),
    "show": Verb("Output the interface definition", f"{_HERE}.show"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 interface``."""
    about = "Show information about ROS interfaces"
    return run_command(Command("interface", about, _VERBS), argv)
