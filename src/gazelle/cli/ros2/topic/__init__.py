"""``ros2 topic``: its verbs, each in a module of its name."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.verbs import Command, Verb, run_command

__all__ = ["main"]

_HERE = "gazelle.cli.ros2.topic"
_VERBS = {
    "bw": Verb("Display bandwidth used by topic", f"{_HERE}.hz_bw_delay"),
    "delay": Verb("Display delay of topic from timestamp in header", f"{_HERE}.hz_bw_delay"),
    "echo": Verb("Output messages from a topic", f"{_HERE}.echo"),
    "find": Verb("Output a list of available topics of a given type", f"{_HERE}.list"),
    "hz": Verb("Print the average publishing rate to screen", f"{_HERE}.hz_bw_delay"),
    "info": Verb("Print information about a topic", f"{_HERE}.list"),
    "list": Verb("Output a list of available topics", f"{_HERE}.list"),
    "pub": Verb("Publish a message to a topic", f"{_HERE}.pub"),
    "type": Verb("Print a topic's type", f"{_HERE}.list"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 topic``."""
    return run_command(
        Command("topic", "Various topic related sub-commands", _VERBS, _add_arguments), argv
    )


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )
