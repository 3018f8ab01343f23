"""``ros2 daemon``: answers; the graph's hub knows everything at once, so none is needed."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["add_arguments", "add_arguments_start", "main", "run_start", "run_status", "run_stop"]

_VERBS = {
    "start": Verb("Start the daemon if it isn't running", __name__),
    "status": Verb("Output the status of the daemon", __name__),
    "stop": Verb("Stop the daemon if it is running", __name__),
}
_WHY = (
    "Gazelle needs no daemon: the hub of the graph knows all nodes at once, so no command waits "
    "for discovery or shows stale nodes"
)


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 daemon``."""
    return run_command(Command("daemon", "Various daemon related sub-commands", _VERBS), argv)


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """``status`` and ``stop`` take nothing."""


def add_arguments_start(parser: argparse.ArgumentParser) -> None:
    """Add what ``start`` takes."""
    text = "Accepted: there is nothing to debug"
    parser.add_argument("--debug", "-d", action="store_true", help=text)


def run_start(_options: argparse.Namespace) -> int:
    """Say what a second start says; scripts go on then."""
    return _answer("The daemon is already running")


def run_status(_options: argparse.Namespace) -> int:
    """Say that none runs."""
    return _answer("The daemon is not running")


def run_stop(_options: argparse.Namespace) -> int:
    """Say that none runs."""
    return _answer("The daemon is not running")


def _answer(text: str) -> int:
    print(text)
    print(_WHY, file=sys.stderr)
    return 0
