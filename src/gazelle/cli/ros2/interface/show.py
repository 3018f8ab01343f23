"""``ros2 interface show``."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator

from gazelle.cli.ros2.interface.names import checked_name, interface_text
from gazelle.cli.ros2.verbs import fail
from gazelle.interfaces.definition import FORMATS

__all__ = ["add_arguments", "interface_lines", "run"]

_SEPARATOR = "---"
_FIELD = re.compile(r"\s*(?P<type>[\w/]+)(?:<=\d+)?(?:\[[^\]]*\])?\s+(?P<name>\w+)\s*(?P<rest>.*)")
_PRIMITIVES = frozenset({*FORMATS, "string", "wstring"})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``show`` takes."""
    group = parser.add_mutually_exclusive_group()
    text = "Show all comments, including for nested interface definitions"
    group.add_argument("--all-comments", action="store_true", help=text)
    text = "Show no comments or whitespace"
    group.add_argument("--no-comments", action="store_true", help=text)
    parser.add_argument(
        "type",
        help="Show an interface definition (e.g. 'example_interfaces/msg/String'). Passing '-' "
        "reads the argument from stdin (e.g. 'ros2 topic type /chatter | ros2 interface show -').",
    )


def run(options: argparse.Namespace) -> int:
    """Print an interface's definition, those of its fields' types indented below them."""
    name = options.type
    if name == "-":
        if sys.stdin.isatty():
            return fail("ros2 interface show: error: expected stdin pipe")
        name = sys.stdin.readline().strip()
    if not name:
        return fail("ros2 interface show: error: the passed value is empty")
    lines = interface_lines(name, comments=not options.no_comments, nested=options.all_comments)
    for line in lines:
        print(line)
    return 0


def interface_lines(name: str, *, comments: bool, nested: bool, level: int = 0) -> Iterator[str]:
    """Yield the lines of a definition.

    Args:
        name: ``pkg/part/Name``.
        comments: with comments and empty lines.
        nested: with those of the fields' types too.
        level: how deep it is indented, by tabs.

    Raises:
        ToolError: nothing defines it.
    """
    package, part, bare = checked_name(name)
    for line in interface_text(package, part, bare).splitlines():
        text = line.rstrip() if comments else _bare_line(line)
        if text or comments:
            yield "\t" * level + text if text else ""
        inner = _nested_type(line, package)
        if inner:
            yield from interface_lines(inner, comments=nested, nested=nested, level=level + 1)


def _bare_line(line: str) -> str:
    """A line without its comment; ``#`` in a text's default or a string constant stays."""
    match = _FIELD.match(line)
    is_text = match is not None and match["type"] in ("string", "wstring")
    if is_text and match is not None and match["rest"].startswith(("=", '"', "'")):
        return line.strip()
    return line.partition("#")[0].strip()


def _nested_type(line: str, package: str) -> str:
    text = line.partition("#")[0]
    match = _FIELD.match(text)
    if match is None or match["type"] in _PRIMITIVES or text.strip() == _SEPARATOR:
        return ""
    words = match["type"].split("/")
    return "/".join([words[0] if len(words) > 1 else package, "msg", words[-1]])
