"""Which ``gz`` commands talk to a running world, and how they end."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from gazelle.cli.gz import joint, log, model, stats, topic, world
from gazelle.cli.gz.options import GzCommand, help_text, read_options
from gazelle.cli.sdf.sdf_file import say
from gazelle.errors import GazelleError

__all__ = ["WORLD_COMMANDS", "explain", "run"]

_FAILED = 255
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
    """Run a command.

    Returns:
        0, also for Ctrl-C; 255 when it could not do what it was asked, where Gazebo often ends
        with 0.
    """
    command, action = _COMMANDS[name]
    try:
        options = read_options(command, words)
        if options is None:
            explain(name)
            return 0
        return action(options)
    except KeyboardInterrupt:
        return 0
    except GazelleError as error:
        say([error])
        return _FAILED


def explain(name: str) -> None:
    """Print a command's options, on standard error as Gazebo does."""
    say([help_text(_COMMANDS[name][0])])
