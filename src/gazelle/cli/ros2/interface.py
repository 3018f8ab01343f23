"""``ros2 interface``: messages, services and actions, and what they consist of."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator

from gazelle.cli.ros2.verbs import Command, Verb, fail, run_command
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.interfaces import (
    action_type,
    definition,
    find_source,
    known_types,
    message_type,
    service_type,
)
from gazelle.interfaces.definition import FORMATS, RosVersion

__all__ = [
    "add_arguments",
    "add_arguments_package",
    "add_arguments_proto",
    "add_arguments_show",
    "interfaces",
    "main",
    "run_list",
    "run_package",
    "run_packages",
    "run_proto",
    "run_show",
]

_PARTS = ("msg", "srv", "action")
_PIECES = {
    "msg": ("",),
    "srv": ("_Request", "_Response"),
    "action": ("_Goal", "_Result", "_Feedback"),
}
_OPTIONS = (
    ("-m", "--only-msgs", "message", "msg"),
    ("-s", "--only-srvs", "service", "srv"),
    ("-a", "--only-actions", "action", "action"),
)
_TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_SEPARATOR = "---"
_FIELD = re.compile(r"\s*(?P<type>[\w/]+)(?:<=\d+)?(?:\[[^\]]*\])?\s+(?P<name>\w+)\s*(?P<rest>.*)")
_PRIMITIVES = frozenset({*FORMATS, "string", "wstring"})
_VERBS = {
    "list": Verb("List all interface types available", __name__),
    "package": Verb("Output a list of available interface types within one package", __name__),
    "packages": Verb("Output a list of packages that provide interfaces", __name__),
    "proto": Verb("Output an interface prototype", __name__),
    "show": Verb("Output the interface definition", __name__),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 interface``."""
    about = "Show information about ROS interfaces"
    return run_command(Command("interface", about, _VERBS), argv)


def interfaces(part: str, package: str = "") -> list[str]:
    """Return the types of a part as ``pkg/part/Name``; what only ROS 1 has is left out."""
    learn_workspace_types()
    found = []
    for full in known_types(part, package):
        owner, its_part, name = full.split("/")
        only_ros1 = find_source(owner, its_part, name, RosVersion.ROS2) is None
        if not only_ros1 or _is_users(owner, its_part, name):
            found.append(full)
    return found


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``list`` and ``packages`` take."""
    for short, long, word, _ in _OPTIONS:
        text = f"Print out only the {word} types"
        parser.add_argument(short, long, action="store_true", help=text)


def add_arguments_package(parser: argparse.ArgumentParser) -> None:
    """Add what ``package`` takes."""
    add_arguments(parser)
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')")


def run_list(options: argparse.Namespace) -> int:
    """Print all types, messages, services and actions apart."""
    for part in _chosen(options):
        print(f"{_TITLES[part]}:")
        for name in interfaces(part):
            print(f"    {name}")
    return 0


def run_package(options: argparse.Namespace) -> int:
    """Print the types of a package."""
    package = options.package_name
    found = [name for part in _chosen(options) for name in interfaces(part, package)]
    if not found and not _has_types(package):
        from gazelle.workspace import Workspace

        packages = Workspace.discover().packages
        if package not in packages:
            known = {name.split("/")[0] for part in _PARTS for name in interfaces(part)}
            return fail(f"Unknown package '{package}'{hint(package, [*known, *packages])}")
    for name in sorted(found):
        print(name)
    return 0


def run_packages(options: argparse.Namespace) -> int:
    """Print the packages that define types; of several options the first counts."""
    parts = _chosen(options)
    if len(parts) < len(_PARTS):
        parts = parts[:1]
    for name in sorted({name.split("/")[0] for part in parts for name in interfaces(part)}):
        print(name)
    return 0


def add_arguments_show(parser: argparse.ArgumentParser) -> None:
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


def run_show(options: argparse.Namespace) -> int:
    """Print an interface's definition, those of its fields' types indented below them."""
    name = options.type
    if name == "-":
        if sys.stdin.isatty():
            return fail("ros2 interface show: error: expected stdin pipe")
        name = sys.stdin.readline().strip()
    if not name:
        return fail("ros2 interface show: error: the passed value is empty")
    lines = _interface_lines(name, comments=not options.no_comments, nested=options.all_comments)
    for line in lines:
        print(line)
    return 0


def add_arguments_proto(parser: argparse.ArgumentParser) -> None:
    """Add what ``proto`` takes."""
    text = "Show an interface definition (e.g. 'example_interfaces/msg/String')"
    parser.add_argument("type", help=text)
    text = "if true output has no outer quotes."
    parser.add_argument("--no-quotes", action="store_true", help=text)


def run_proto(options: argparse.Namespace) -> int:
    """Print what ``pub``, ``call`` or ``send_goal`` may be given, with the fields' defaults."""
    from gazelle.cli.text.ros2_text import message_yaml

    part = _checked_name(options.type)[1]
    if part == "msg":
        message = message_type(options.type)()
    elif part == "srv":
        message = service_type(options.type).Request()
    else:
        message = action_type(options.type).Goal()
    text = message_yaml(message)
    print(text if options.no_quotes else f'"{text}"')
    return 0


def _checked_name(name: str) -> tuple[str, str, str]:
    """Return package, part and name of an interface.

    Raises:
        ToolError: it is not written so, or nothing defines it.
    """
    parts = name.split("/")
    if len(parts) != 3:
        raise ToolError(
            f"Invalid name '{name}'. Expected three parts separated by '/'{_spelled(name)}"
        )
    package, part, bare = parts
    learn_workspace_types()
    if part in _PARTS and name in known_types(part, package):
        return package, part, bare
    everything = [one for its_part in _PARTS for one in interfaces(its_part)]
    near = hint(name, everything)
    if not any(one.startswith(f"{package}/") for one in everything):
        raise ToolError(f"Unknown package '{package}'{near}")
    raise ToolError(f"Could not find the interface '{name}'{near}")


def _interface_text(package: str, part: str, bare: str) -> str:
    """Return the text that defines an interface, of ROS 1's ones what ROS 2 would write."""
    source = find_source(package, part, bare, RosVersion.ROS2)
    if source is not None:
        return source.text
    pieces = [
        definition(f"{package}/{part}/{bare}{suffix}", RosVersion.ROS2) for suffix in _PIECES[part]
    ]
    return "\n---\n".join(piece.text.strip("\n") for piece in pieces)


def _interface_lines(name: str, *, comments: bool, nested: bool, level: int = 0) -> Iterator[str]:
    """Yield the lines of a definition.

    Args:
        name: ``pkg/part/Name``.
        comments: with comments and empty lines.
        nested: with those of the fields' types too.
        level: how deep it is indented, by tabs.

    Raises:
        ToolError: nothing defines it.
    """
    package, part, bare = _checked_name(name)
    for line in _interface_text(package, part, bare).splitlines():
        text = line.rstrip() if comments else _bare_line(line)
        if text or comments:
            yield "\t" * level + text if text else ""
        inner = _nested_type(line, package)
        if inner:
            yield from _interface_lines(inner, comments=nested, nested=nested, level=level + 1)


def _is_users(package: str, part: str, name: str) -> bool:
    source = find_source(package, part, name, RosVersion.ROS1)
    return source is not None and not source.file.startswith("<")


def _spelled(name: str) -> str:
    """``std_msgs/String`` is ROS 1's spelling; tell ROS 2's."""
    parts = name.split("/")
    if len(parts) != 2:
        return ""
    learn_workspace_types()
    full = [f"{parts[0]}/{part}/{parts[1]}" for part in _PARTS]
    there = [one for one, part in zip(full, _PARTS, strict=True) if one in known_types(part)]
    return f"\n  did you mean '{there[0]}'?" if there else ""


def _chosen(options: argparse.Namespace) -> list[str]:
    given = [part for _, long, _, part in _OPTIONS if getattr(options, long[2:].replace("-", "_"))]
    return given or list(_PARTS)


def _has_types(package: str) -> bool:
    return any(interfaces(part, package) for part in _PARTS)


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
    parts = match["type"].split("/")
    return "/".join([parts[0] if len(parts) > 1 else package, "msg", parts[-1]])
