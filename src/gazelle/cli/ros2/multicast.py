"""``ros2 multicast``: answers; the graph does not use multicast."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.ros2.verbs import Command, Verb, positive_int, run_command

__all__ = ["add_arguments_receive", "add_arguments_send", "main", "run_receive", "run_send"]

_GROUP = "225.0.0.1"
_PORT = 49150
_VERBS = {
    "receive": Verb("Receive a single UDP multicast packet", __name__),
    "send": Verb("Send a single UDP multicast packet", __name__),
}
_WHY = (
    "multicast is not used and not tested here: all nodes of the graph are on this machine and "
    "find each other by its own sockets"
)


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 multicast``."""
    about = "Various multicast related sub-commands"
    return run_command(Command("multicast", about, _VERBS), argv)


def add_arguments_receive(parser: argparse.ArgumentParser) -> None:
    """Add what ``receive`` takes."""
    add = parser.add_argument
    add("--group", default=_GROUP, help=f"The multicast group (default: {_GROUP}); not used")
    add("--port", type=int, default=_PORT, help=f"The port (default: {_PORT}); not used")


def add_arguments_send(parser: argparse.ArgumentParser) -> None:
    """Add what ``send`` takes."""
    add_arguments_receive(parser)
    parser.add_argument("--ttl", type=positive_int, help="The multicast TTL; not used")


def run_receive(_options: argparse.Namespace) -> int:
    """Say why nothing will come."""
    return _answer()


def run_send(_options: argparse.Namespace) -> int:
    """Say why nothing is sent."""
    return _answer()


def _answer() -> int:
    print(_WHY, file=sys.stderr)
    return 0
