"""What the commands of ``ros2`` share: their verbs, help in ros2cli's layout, exit codes."""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any, NamedTuple

from gazelle.cli.error_text import error_text
from gazelle.cli.ros_tool import hint
from gazelle.errors import GazelleError, UserFileError

__all__ = [
    "Command",
    "Verb",
    "add_direct_arguments",
    "add_strategy_arguments",
    "add_verbs",
    "command_parser",
    "fail",
    "guarded",
    "non_negative_int",
    "positive_float",
    "positive_int",
    "run_command",
]

Parser = argparse.ArgumentParser


class Verb(NamedTuple):
    """One verb.

    Attributes:
        about: its line of help.
        module: has ``add_arguments(parser)`` and ``run(options)``, or these names with
            ``_<verb>`` behind them when it holds several verbs.
    """

    about: str
    module: str


class Command(NamedTuple):
    """A command with verbs: ``topic``, its line of help, the verbs, options of its own."""

    name: str
    about: str
    verbs: Mapping[str, Verb]
    add_arguments: Callable[[Parser], None] | None = None


def run_command(command: Command, argv: list[str]) -> int:
    """Run a verb; without one, print the help.

    Returns:
        0, 1 for errors (told on standard error), 2 for wrong usage and for Ctrl-C.
    """
    name = next((word for word in argv if word in command.verbs), "")
    parser = command_parser(command, name)
    return guarded(lambda: _run(parser, name, command, argv))


def guarded(action: Callable[[], int | None]) -> int:
    """Run what a command does and return the exit code that ros2cli's would have."""
    try:
        return action() or 0
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1
    except KeyboardInterrupt:
        return int(signal.SIGINT)
    except UserFileError:
        # Its findings are rendered with their places by whoever runs all commands.
        raise
    except GazelleError as error:
        return fail(str(error))


def fail(text: str) -> int:
    """Print why a command ends early, behind what it has printed so far; return 1."""
    from gazelle.diagnostics.launch_journal import keep_error

    sys.stdout.flush()
    keep_error(text)
    print(error_text(text), file=sys.stderr, flush=True)
    return 1


def command_parser(command: Command, chosen: str = "") -> Parser:
    """Return the parser of a command; of its verbs, only the chosen one has its arguments."""
    parser = Parser(
        prog=f"ros2 {command.name}",
        description=command.about,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    if command.add_arguments is not None:
        command.add_arguments(parser)
    verbs = add_verbs(parser, {name: verb.about for name, verb in command.verbs.items()})
    if chosen:
        _function(command.verbs[chosen], chosen, "add_arguments")(verbs[chosen])
    return parser


def add_verbs(parser: Parser, abouts: Mapping[str, str]) -> dict[str, Parser]:
    """Add verbs with their lines of help, listed as ros2cli lists them; return their parsers."""
    width = max(map(len, abouts))
    lines = [f"{name:<{width}}  {about}" for name, about in sorted(abouts.items())]
    verbs = parser.add_subparsers(
        title="Commands",
        description="\n".join(lines),
        metavar=f"Call `{parser.prog} <command> -h` for more detailed usage.",
        dest="verb",
    )
    layout = argparse.RawDescriptionHelpFormatter
    return {
        name: verbs.add_parser(name, description=about, formatter_class=layout)
        for name, about in abouts.items()
    }


def add_direct_arguments(parser: Parser) -> None:
    """Add the options of verbs that have a node of their own."""
    parser.add_argument(
        "--spin-time",
        type=float,
        default=0.5,
        help="Accepted: the graph is known at once here, nothing waits for discovery",
    )
    parser.add_argument(
        "-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time"
    )


def add_strategy_arguments(parser: Parser) -> None:
    """Add the options of verbs that ask ros2cli's daemon."""
    add_direct_arguments(parser)
    parser.add_argument(
        "--no-daemon", action="store_true", help="Accepted: there is no daemon here"
    )


def positive_int(text: str) -> int:
    """Read a whole number above zero."""
    value = int(text) if text.strip().lstrip("+-").isdigit() else -1
    if value <= 0:
        raise argparse.ArgumentTypeError("value must be a positive integer")
    return value


def non_negative_int(text: str) -> int:
    """Read a whole number of zero or more."""
    if not text.strip().isdigit():
        raise argparse.ArgumentTypeError("Value must be positive or zero")
    return int(text)


def positive_float(text: str) -> float:
    """Read a number above zero."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError("Expects a floating point number") from None
    if value <= 0.0:
        raise argparse.ArgumentTypeError("Value must be positive")
    return value


def _run(parser: Parser, name: str, command: Command, argv: list[str]) -> int | None:
    _refuse_unknown(command, name, argv)
    options = parser.parse_args(argv)
    if not options.verb:
        parser.print_help()
        return 0
    verb = command.verbs[options.verb]
    result: int | None = _function(verb, options.verb, "run")(options)
    return result


def _refuse_unknown(command: Command, name: str, argv: list[str]) -> None:
    """Put the nearest verb in front of argparse's complaint, which lists them all."""
    word = next((one for one in argv if not one.startswith("-")), "")
    if word and not name:
        near = hint(word, command.verbs).strip()
        if near:
            print(f"ros2 {command.name}: no command '{word}'; {near}", file=sys.stderr)


def _function(verb: Verb, name: str, role: str) -> Callable[..., Any]:
    module = import_module(verb.module)
    found: Callable[..., Any] = getattr(module, f"{role}_{name}", None) or getattr(module, role)
    return found
