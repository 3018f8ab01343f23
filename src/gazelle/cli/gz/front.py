"""Which ``gz`` commands talk to a running world, and how they end."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from gazelle.cli.gz import joint, log, model, stats, topic, world
from gazelle.cli.gz.options import GzCommand, help_text
from gazelle.cli.gz.running import ended, run_with_options
from gazelle.cli.sdf.sdf_file import say

__all__ = ["WORLD_COMMANDS", "explain", "run"]

_ROWS: tuple[tuple[GzCommand, Callable[[Mapping[str, str]], int]], ...] = (
    (joint.COMMAND, joint.run),
    (log.COMMAND, log.run),
    (model.COMMAND, model.run),
    (stats.COMMAND, stats.run),
    (topic.COMMAND, topic.run),
    (world.COMMAND, world.run),
)
_COMMANDS = {command.name: (command, action) for command, action in _ROWS}
WORLD_COMMANDS = tuple(_COMMANDS)


def run(name: str, words: list[str]) -> int:
    """Run a command; see `ended` for what it returns."""
    command, action = _COMMANDS[name]
    return ended(lambda: run_with_options(command, action, words))


def explain(name: str) -> None:
    """Print a command's options, on standard error as Gazebo does."""
    say([help_text(_COMMANDS[name][0])])
