"""``gazelle COMMAND …``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module

from gazelle._version import __version__
from gazelle.cli.commands import COMMANDS
from gazelle.cli.error_text import error_text
from gazelle.errors import GazelleError, UserFileError, file_refusal_text
from gazelle.process_lifetime import drop_output

__all__ = ["main"]

# One module runs several commands; it is told which.
_SHARED_MODULES = ("gazelle.cli.rosmsg", "gazelle.cli.rospack", "gazelle.cli.rqt")


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command.

    Returns:
        Its exit code: 0 for success, 1 for a failure it explained, 2 for wrong usage,
        130 for Ctrl-C.
    """
    tokens = list(sys.argv[1:] if argv is None else argv)
    try:
        return _main(tokens)
    except BrokenPipeError:
        # The reader of our output has gone, as in `rostopic list | head`, which is no failure.
        drop_output(sys.stdout)
        return 0


def _main(argv: list[str]) -> int:
    if not argv or argv[0] in {"-h", "--help", "help"}:
        print(_usage())
        return 0 if argv else 2
    if argv[0] == "--version":
        print(f"gazelle {__version__}")
        return 0
    code: int | str | None = 1
    try:
        code = _run(argv[0], argv[1:])
    except SystemExit as stop:
        code = stop.code
        raise
    finally:
        if code:
            _tell_of_printed_characters(argv[0], argv[1:])
    return code


def _tell_of_printed_characters(name: str, rest: list[str]) -> None:
    if all(word.isascii() for word in rest):
        return
    from gazelle.cli.error_text import printed_characters

    for line in printed_characters(rest):
        print(f"{name}: {line}", file=sys.stderr)


def _run(name: str, rest: list[str]) -> int:
    command = COMMANDS.get(name)
    if command is None:
        from gazelle.diagnostics import did_you_mean

        hint = did_you_mean(name, COMMANDS)
        print(
            f"gazelle: '{name}' is not a command; {hint or 'see gazelle --help'}", file=sys.stderr
        )
        return 2
    try:
        module = import_module(command.module)
        if command.module in _SHARED_MODULES:
            rest = [name, *rest]
        return int(module.main(rest))
    except UserFileError as error:
        from gazelle.diagnostics import render

        render(error.diagnostics)
        return 1
    except GazelleError as error:
        print(f"{name}: {error_text(error)}", file=sys.stderr)
        return 1
    except OSError as error:
        text = file_refusal_text(error)
        if not text:
            raise
        print(f"{name}: {text}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def _usage() -> str:
    width = max(map(len, COMMANDS)) + 2
    lines = ["usage: gazelle COMMAND …", "", "commands:"]
    lines += [f"  {name:<{width}}{command.help}" for name, command in COMMANDS.items()]
    env = 'eval "$(gazelle env)" makes the ROS-named ones available.'
    return "\n".join(
        [*lines, "", "New here? 'gazelle demo scout' shows a robot in its world.", env]
    )
