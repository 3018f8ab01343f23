"""``ros2 service``: services of the graph, and calls of them."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["main"]

_HERE = "gazelle.cli.ros2.service"
_VERBS = {
    "call": Verb("Call a service", f"{_HERE}.call"),
    "echo": Verb("Echo a service", f"{_HERE}.echo"),
    "find": Verb("Output a list of available services of a given type", f"{_HERE}.listing"),
    "info": Verb("Print information about a service", f"{_HERE}.listing"),
    "list": Verb("Output a list of available services", f"{_HERE}.listing"),
    "type": Verb("Output a service's type", f"{_HERE}.listing"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 service``."""
    about = "Various service related sub-commands"
    return run_command(Command("service", about, _VERBS, _add_arguments), argv)


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--include-hidden-services", action="store_true", help="Consider hidden services as well"
    )
