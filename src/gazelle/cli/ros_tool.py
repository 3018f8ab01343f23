"""What the ROS-named commands share: the originals' usage, errors and exit codes."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from optparse import OptionParser
from typing import NamedTuple

from gazelle.cli.error_text import error_text
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError
from gazelle.graph import Graph, NoGraphError
from gazelle.graph.names import parse_command_line, resolve

__all__ = [
    "Tool",
    "ToolError",
    "add_flag",
    "global_name",
    "hint",
    "join_graph",
    "option_parser",
    "run_tool",
]

_USAGE_CODE = 64
_NO_MASTER = "Unable to communicate with master!"

Command = Callable[[list[str]], int]


class ToolError(GazelleError):
    """What the original prints behind ``ERROR:`` before it ends with exit code 1."""


class Tool(NamedTuple):
    """A command with subcommands.

    Attributes:
        name: such as ``rostopic``.
        commands: subcommand → function, or ``module:function``; it takes the words behind the
            subcommand and returns an exit code.
        usage: what is printed without a subcommand.
        usage_code: exit code of that.
        takes_remappings: words with ``:=`` are ROS's and not the command's.
    """

    name: str
    commands: Mapping[str, str | Command]
    usage: str
    usage_code: int = _USAGE_CODE
    takes_remappings: bool = True


def run_tool(tool: Tool, argv: list[str]) -> int:
    """Run a subcommand; print what goes wrong as the original does.

    Returns:
        0, also for Ctrl-C, which is how most of them end; 1 for errors; 2 for wrong options;
        64 (``EX_USAGE``) when the subcommand is missing or unknown.
    """
    if tool.takes_remappings:
        argv = parse_command_line(argv).rest
    target = tool.commands.get(argv[0]) if argv else None
    if target is None:
        return _usage(tool, argv)
    try:
        return _load(target)(argv[1:])
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1
    except KeyboardInterrupt:
        return 0
    except GazelleError as error:
        sys.stdout.flush()
        print(f"ERROR: {error_text(error)}", file=sys.stderr)
        return 1


@contextmanager
def join_graph() -> Iterator[Graph]:
    """Join the graph as a client for the time of a ``with`` block.

    Raises:
        ToolError: there is no graph.
    """
    try:
        graph = Graph.open(role="client")
    except NoGraphError as error:
        reason = str(error).replace(f" ({_NO_MASTER})", "")
        raise ToolError(f"{_NO_MASTER}\n  {reason}") from None
    with graph:
        yield graph


def global_name(name: str, tool: str) -> str:
    """Return the global name; relative ones start at ``ROS_NAMESPACE``."""
    namespace = resolve(os.environ.get("ROS_NAMESPACE", ""))
    return resolve(name, namespace, node=f"/{tool}")


def hint(name: str, existing: Iterable[str]) -> str:
    """Return a line that names what exists and is spelled alike, empty when nothing is."""
    near = did_you_mean(name, existing)
    return f"\n  {near}" if near else ""


def option_parser(tool: str, usage: str) -> OptionParser:
    """Return a parser that talks as the original's does."""
    return OptionParser(usage=f"usage: %prog {usage}", prog=tool)


def add_flag(parser: OptionParser, *names: str, dest: str, text: str) -> None:
    """Add an option without a value; it is False when it is not given."""
    parser.add_option(*names, dest=dest, action="store_true", default=False, help=text)


def _load(target: str | Command) -> Command:
    if not isinstance(target, str):
        return target
    module, _, function = target.partition(":")
    found: Command = getattr(import_module(module), function)
    return found


def _usage(tool: Tool, argv: list[str]) -> int:
    print(tool.usage)
    if not argv:
        return tool.usage_code
    if argv[0] in {"-h", "--help"}:
        return 0
    near = did_you_mean(argv[0], tool.commands)
    print(f"{tool.name}: no command '{argv[0]}'; {near}".rstrip("; "), file=sys.stderr)
    return tool.usage_code
