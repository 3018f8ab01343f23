"""``gz``: Gazebo 11's tool and the new one's; ``gz sdf`` is here, the rest beside it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from getopt import GetoptError, gnu_getopt
from pathlib import Path

from gazelle.cli.gz import joint, log, model, stats, topic, world
from gazelle.cli.gz.gz_sim import which_gazebo as new_front
from gazelle.cli.gz.ign import without_version
from gazelle.cli.gz.options import GZ_INSTEAD, GzCommand, ended, help_text, run_with_options
from gazelle.cli.sdf.ign_sdf import run_sdf as run_new_sdf
from gazelle.cli.sdf.ign_sdf import usage
from gazelle.cli.sdf.sdf_file import read_for, report_findings, say, take_quiet
from gazelle.cli.sdf.which_sdformat import sdformat_release
from gazelle.description.sdformat_emulation.gz_sdf_command import to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.console import error_line
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import described_specification
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["main"]

_ROWS: tuple[tuple[GzCommand, Callable[[Mapping[str, str]], int]], ...] = (
    (joint.COMMAND, joint.run),
    (log.COMMAND, log.run),
    (model.COMMAND, model.run),
    (stats.COMMAND, stats.run),
    (topic.COMMAND, topic.run),
    (world.COMMAND, world.run),
)
_WORLD_COMMANDS = {command.name: (command, action) for command, action in _ROWS}
_OLD = Release.V9
_UNKNOWN = 255
_HELP = """This tool modifies various aspects of a running Gazebo simulation.

  Usage:  gz <command>

List of commands:

  help      Print this help text.
  joint     Modify properties of a joint
  log       Record the state of a world into a bag, and read it
  model     Modify properties of a model
  sdf       Converts between SDF versions, and provides info about SDF files
  service   Lists and calls services, as the new Gazebo has them
  sim       Run a world with the options of the new Gazebo
  stats     Print statistics about a running gzserver instance.
  topic     Lists information about topics on a Gazebo master
  world     Modify world properties


Use "gz help <command>" to print help for a command."""
_SDF_HELP = """ gz sdf [options]

\tIntrospect, convert, and output SDF files.
\tUse the -v option to specify the version of
\tSDF for use with other options.

Options:
  --verbose             Print extra information
  -h [ --help ]         Print this help message
  -d [ --describe ]     Print SDF format for given version(-v).
  -c [ --convert ] arg  In place conversion of arg to the latest SDF version.
  -o [ --doc ]          Print HTML SDF. Use -v to specify version.
  -k [ --check ] arg    Validate arg.
  -v [ --version ] arg  Version of SDF to use with other options.
  -p [ --print ] arg    Print arg, useful for debugging and as a conversion 
                        tool.
  --no-findings         Gazelle: leave out its own findings behind the output.
"""  # noqa: W291
_HELP_WORDS = ("help", "--help", "-h")
_SHORT = "hdc:ok:v:p:"
_LONG = ["verbose", "help", "describe", "convert=", "doc", "check=", "version=", "print="]
_NAMES = {
    "-h": "help", "-d": "describe", "-c": "convert", "-o": "doc", "-k": "check", "-v": "version",
    "-p": "print",
}  # fmt: skip
_NEW_HELP = """The 'gz' command provides a command line interface to the Gazebo Tools.

  gz <command> [options]

List of available commands:

  help:          Print this help text.
  model:         Print information about models.
  sdf:           Utilities for SDF files.
  service:       Print information about services.
  sim:           Run and manage the Gazebo Simulator.
  topic:         Print information about topics.

Options:

  --force-version <VERSION>  Use a specific library version.
  --versions                 Show the available versions.
  --commands                 Show the available commands.

Use 'gz help <command>' to print help for a command."""


def main(argv: list[str]) -> int:
    """Run a command of ``gz``.

    Returns:
        0 for every command there is, also when a file is wrong, as the original does; 255 for
        others.
    """
    name = argv[0] if argv else ""
    if name == "--commands":
        print("\n".join(sorted({*_WORLD_COMMANDS, *new_front.NEW_COMMANDS, "sdf"})))
        return 0
    if name == "sdf":
        tokens, version = without_version(argv[1:])
        release = sdformat_release(tokens, os.environ)
        if version and not release.is_new:
            release = Release.V12
        return run_new_sdf(tokens, "gz", release) if release.is_new else _run_sdf(tokens)
    if name == "help" and argv[1:] == ["sdf"]:
        if _is_new_in_use():
            print(usage("gz", sdformat_release((), os.environ)))
        else:
            say([_SDF_HELP])
        return 0
    if name == "help" and len(argv) == 2 and new_front.is_new(argv[1], (), in_use=_is_new_in_use):
        new_front.explain(argv[1])
        return 0
    if new_front.is_new(name, argv[1:], in_use=_is_new_in_use):
        return new_front.run(name, argv[1:])
    if name == "help" and len(argv) == 2 and argv[1] in _WORLD_COMMANDS:
        _explain(argv[1])
        return 0
    if name in _WORLD_COMMANDS:
        return _run(name, argv[1:])
    if name in GZ_INSTEAD:
        say([f"gazelle: gz {name} is not here; use {GZ_INSTEAD[name]}"])
        return _UNKNOWN
    if _is_new_in_use():
        print(_NEW_HELP)
        return 0 if name in _HELP_WORDS else _UNKNOWN
    say([_HELP])
    return 0 if name == "help" else _UNKNOWN


def _run(name: str, argv: list[str]) -> int:
    """Run a command on a running world; see `ended` for what it returns."""
    command, action = _WORLD_COMMANDS[name]
    return ended(lambda: run_with_options(command, action, argv))


def _explain(name: str) -> None:
    """Print such a command's options, on standard error as Gazebo does."""
    say([help_text(_WORLD_COMMANDS[name][0])])


def _is_new_in_use() -> bool:
    return sdformat_release((), os.environ).is_new


def _run_sdf(argv: list[str]) -> int:
    argv, is_quiet = take_quiet(argv)
    try:
        pairs, _rest = gnu_getopt(argv, _SHORT, _LONG)
    except GetoptError:
        say(["Invalid arguments"])
        return 0
    options = {_NAMES.get(name, name.lstrip("-")): value for name, value in pairs}
    version = options.get("version", "1.7")
    if version != "1.7":
        say([f"gazelle: gz sdf knows SDF 1.7 only, not {version}; ign sdf knows 1.9"])
        return _UNKNOWN
    word = options.get("check", options.get("print", ""))
    if "check" in options:
        _check(word)
    elif "describe" in options:
        sys.stdout.write(described_specification(_OLD))
    elif "doc" in options or "convert" in options:
        return _say_missing(options)
    elif "print" in options:
        _print(word)
    else:
        say([_SDF_HELP])
    if word and not is_quiet:
        report_findings(word)
    return 0


def _check(word: str) -> None:
    if _text_of(word) is not None:
        print("Check complete")


def _print(word: str) -> None:
    text = _text_of(word)
    if text is not None:
        sys.stdout.write(text)


def _text_of(word: str) -> str | None:
    """Return a file as sdformat 9 prints it; None, said why, when it refuses it."""
    if not Path(word).exists():
        say([f"Error: File doesn't exist[{word}]"])
    document = read_for(word, _OLD)
    say(document.console.lines)
    say(error_line(error, _OLD) for error in document.errors)
    if document.root is None:
        say(["Error: SDF parsing the xml failed"])
        return None
    return to_text(document.root, _OLD)


def _say_missing(options: dict[str, str]) -> int:
    if "convert" in options:
        file = options["convert"]
        say([f"gazelle: gz sdf does not rewrite '{file}' in place; use gz sdf -p {file} > NEW.sdf"])
    else:
        say(["gazelle: gz sdf has no HTML; use gz sdf -d, or sdformat.org/spec"])
    return _UNKNOWN
