"""Which words are the new Gazebo's, and how its commands end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from gazelle.cli.gz.gz_sim import model, service, sim, topic
from gazelle.cli.gz.options import GzCommand, ended, help_text, run_with_options
from gazelle.cli.sdf.sdf_file import say

__all__ = ["NEW_COMMANDS", "explain", "is_new", "run"]

_ROWS: tuple[tuple[GzCommand, Callable[[Mapping[str, str]], int]], ...] = (
    (model.COMMAND, model.run),
    (service.COMMAND, service.run),
    (topic.COMMAND, topic.run),
)
_COMMANDS = {command.name: (command, action) for command, action in _ROWS}
NEW_COMMANDS = ("model", "service", "sim", "topic")
# What Gazebo 11 has not under the same name; its own words have none of these.
_SIGNS = {
    "model": ({"--list", "--model", "--link", "--joint", "--sensor"}, "lj"),
    "topic": ({"--topic", "--pub", "--msgtype", "--num", "--json-output", "--frequency"}, "tnf"),
}


def is_new(name: str, argv: Iterable[str], *, in_use: Callable[[], bool]) -> bool:
    """Tell whether words behind ``gz NAME`` are the new Gazebo's and not Gazebo 11's.

    Args:
        name: the command.
        argv: those behind it.
        in_use: tells whether the surroundings speak of the new Gazebo; asked where words are
            good for both.
    """
    if name not in _SIGNS:
        return name in NEW_COMMANDS
    argv = list(argv)
    if name == "model" and len(argv) == 2 and argv[0] in {"-m", "--model-name"}:
        # Gazebo 11 has nothing to do then.
        return True
    long, letters = _SIGNS[name]
    if any(
        word.partition("=")[0] in long or (word[:1] == "-" and word[1:2] and word[1] in letters)
        for word in argv
    ):
        return True
    return _is_of_both(name, argv) and in_use()


def _is_of_both(name: str, argv: Sequence[str]) -> bool:
    """Tell whether both Gazebos have these words: none, ``--help``, or a model and ``--pose``."""
    options = [word.partition("=")[0] for word in argv if word.startswith("-")]
    if not argv or any(word in {"-h", "--help"} for word in options):
        return True
    return name == "model" and set(options) <= {"-m", "--pose", "-p"}


def run(name: str, argv: list[str]) -> int:
    """Run a command; see `ended` for what it returns."""
    if name == "sim":
        return ended(lambda: sim.run(argv))
    command, action = _COMMANDS[name]
    given = _with_values(command, argv) if argv else ["--help"]
    return ended(lambda: run_with_options(command, action, given))


def explain(name: str) -> None:
    """Print a command's options."""
    if name == "sim":
        sim.run(["--help"])
    else:
        say([help_text(_COMMANDS[name][0])])


def _with_values(command: GzCommand, argv: Iterable[str]) -> list[str]:
    """Give options whose value may be left out an empty one."""
    if command.name != "model":
        return list(argv)
    spelled = {f"--{row.name}": row.name for row in command.options if row.name in model.OPTIONAL}
    spelled |= {f"-{row.letter}": row.name for row in command.options if row.name in model.OPTIONAL}
    found, rest = [], list(argv)
    while rest:
        word = rest.pop(0)
        if word in spelled:
            value = rest.pop(0) if rest and not rest[0].startswith("-") else ""
            found.append(f"--{spelled[word]}={value}")
        else:
            found.append(word)
    return found
