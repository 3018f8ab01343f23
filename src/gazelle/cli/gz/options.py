"""Options of a ``gz`` command: reading them and printing them as the original does."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from getopt import GetoptError, gnu_getopt
from typing import NamedTuple

from gazelle.errors import GazelleError

__all__ = ["GzCommand", "GzError", "GzOption", "help_text", "number", "read_options", "seconds"]

_TEXT_COLUMN = 24
_HELP = ("help", "h")


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


def read_options(command: GzCommand, words: Iterable[str]) -> dict[str, str] | None:
    """Return long name → value (empty for options without one); None when help is wanted.

    Raises:
        GzError: an option that the command does not have, or one without its value.
    """
    rows = command.options
    short = "h" + "".join(row.letter + (":" if row.takes else "") for row in rows if row.letter)
    long = ["help", *(row.name + ("=" if row.takes else "") for row in rows)]
    try:
        pairs, rest = gnu_getopt(list(words), short, long)
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
