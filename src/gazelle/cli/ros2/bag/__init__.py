"""``ros2 bag``: recordings in rosbag2's formats."""

from __future__ import annotations

import sys
from importlib import import_module

from gazelle.cli.error_text import error_text
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError

__all__ = ["main"]

_VERBS = {
    "convert": ("gazelle.cli.ros2.bag.convert", "Given an input bag, write out a new bag"),
    "info": ("gazelle.cli.ros2.bag.info", "Print information about a bag to the screen"),
    "list": ("gazelle.cli.ros2.bag.plugins", "Print information about available plugins"),
    "play": ("gazelle.cli.ros2.bag.play", "Play back ROS data from a bag"),
    "record": ("gazelle.cli.ros2.bag.record", "Record ROS data to a bag"),
    "reindex": ("gazelle.cli.ros2.bag.reindexing", "Reconstruct metadata file for a bag"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 bag``."""
    verb = argv[0] if argv else ""
    if verb in {"", "-h", "--help"}:
        print("usage: ros2 bag [-h] Call `ros2 bag <command> -h` for more detailed usage. ...")
        print("\nVarious rosbag related sub-commands\n\nCommands:")
        print("\n".join(f"  {name:<9} {text}" for name, (_, text) in _VERBS.items()))
        return 0
    if verb not in _VERBS:
        hint = did_you_mean(verb, _VERBS) or f"choose from {', '.join(map(repr, _VERBS))}"
        text = f"ros2 bag: error: argument Call `ros2 bag <command> -h`: invalid choice: '{verb}'"
        print(f"{text} ({hint})", file=sys.stderr)
        return 2
    try:
        return int(import_module(_VERBS[verb][0]).main(argv[1:]))
    except GazelleError as error:
        sys.stdout.flush()
        print(f"[ERROR] [ros2bag]: {error_text(error)}", file=sys.stderr)
        return 1
