"""Options of a ``gz`` command: reading them, printing them, and how the command ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from getopt import GetoptError, gnu_getopt
from typing import NamedTuple

from gazelle.cli.sdf.sdf_file import say
from gazelle.errors import GazelleError

__all__ = [
    "GZ_INSTEAD",
    "IGN_INSTEAD",
    "GzCommand",
    "GzError",
    "GzOption",
    "ended",
    "help_text",
    "number",
    "read_options",
    "run_with_options",
    "seconds",
]

_TEXT_COLUMN = 24
_HELP = ("help", "h")
_FAILED = 255
GZ_INSTEAD = {
    "camera": "the browser page of the simulator",
    "debug": "gazelle --help",
    "marker": "a visualization_msgs/Marker topic",
    "physics": "rosservice call /gazebo/set_physics_properties",
    "plugin": "gazelle doctor FILE, which says what a plug-in is here",
}
IGN_INSTEAD = {
    "fuel": "models in local folders; nothing is downloaded",
    "gui": "ign gazebo -g",
    "launch": "roslaunch",
    "log": "rosbag",
    "msg": "rosmsg show",
    "param": "rosparam, or ros2 param",
    "plugin": "gazelle doctor FILE, which says what a plug-in is here",
    "sim": "ign gazebo, as Fortress calls it, or gz sim",
}


class GzError(GazelleError):
    """Why a ``gz`` command cannot do what it was asked."""


class GzOption(NamedTuple):
    """One option.

    Attributes:
        name: long name.
        letter: short name, empty when it has none.
        text: what it does.
        takes: it is followed by a value.
    """

    name: str
    letter: str
    text: str
    takes: bool = False


class GzCommand(NamedTuple):
    """A command of ``gz``: its name, what it is for, its options."""

    name: str
    about: str
    options: tuple[GzOption, ...]


def read_options(command: GzCommand, argv: Iterable[str]) -> dict[str, str] | None:
    """Return long name → value (empty for options without one); None when help is wanted.

    Raises:
        GzError: an option that the command does not have, or one without its value.
    """
    rows = command.options
    short = "h" + "".join(row.letter + (":" if row.takes else "") for row in rows if row.letter)
    long = ["help", *(row.name + ("=" if row.takes else "") for row in rows)]
    try:
        pairs, rest = gnu_getopt(list(argv), short, long)
    except GetoptError as error:
        raise GzError(f"Invalid arguments: {error}; see gz help {command.name}") from None
    if rest:
        raise GzError(f"Invalid arguments: '{rest[0]}' belongs to no option")
    names = {row.letter: row.name for row in rows if row.letter}
    given = {word.lstrip("-"): value for word, value in pairs}
    if any(name in given for name in _HELP):
        return None
    return {names.get(name, name) if len(name) == 1 else name: given[name] for name in given}


def help_text(command: GzCommand) -> str:
    """Return what ``gz help COMMAND`` prints."""
    rows = [*command.options, GzOption("help", "h", "Print this help message")]
    lines = [f" gz {command.name} [options]", "", f"\t{command.about}", "", "Options:"]
    for row in rows:
        head = f"  -{row.letter} [ --{row.name} ]" if row.letter else f"  --{row.name}"
        head += " arg" if row.takes else ""
        lines.append(f"{head:<{_TEXT_COLUMN}}  {row.text}")
    return "\n".join(lines)


def number(options: Mapping[str, str], name: str, default: float = 0.0) -> float:
    """Return an option's number.

    Raises:
        GzError: it is none.
    """
    if name not in options:
        return default
    try:
        return float(options[name])
    except ValueError:
        raise GzError(f"--{name}: '{options[name]}' is not a number") from None


def seconds(options: Mapping[str, str]) -> float | None:
    """Return ``--duration`` in seconds, None for no end."""
    return number(options, "duration") if "duration" in options else None


def ended(work: Callable[[], int]) -> int:
    """Do a command's work.

    Returns:
        what the work does; 0 for Ctrl-C; 255 when it could not do what it was asked, where
        Gazebo often ends with 0.
    """
    try:
        return work()
    except KeyboardInterrupt:
        return 0
    except GazelleError as error:
        say([error])
        return _FAILED


def run_with_options(
    command: GzCommand, action: Callable[[Mapping[str, str]], int], argv: Iterable[str]
) -> int:
    """Read a command's options and do what they say, or print them where help is wanted."""
    options = read_options(command, argv)
    if options is None:
        say([help_text(command)])
        return 0
    return action(options)
