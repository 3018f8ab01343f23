"""``rosmsg`` and ``rossrv``: definitions of messages and services."""

from __future__ import annotations

import sys
from functools import partial
from optparse import OptionParser
from typing import NamedTuple

from gazelle.cli.ros_tool import Tool, ToolError, add_flag, hint, option_parser, run_tool
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.errors import NotFoundError
from gazelle.interfaces import (
    definition,
    find_source,
    known_types,
    md5sum,
    service_md5sum,
    show_message,
    show_service,
)
from gazelle.interfaces.definition import RosVersion

__all__ = ["main"]


class _Mode(NamedTuple):
    """Messages or services."""

    tool: str
    part: str
    word: str


_MODES = {
    "rosmsg": _Mode("rosmsg", "msg", "message"),
    "rossrv": _Mode("rossrv", "srv", "service"),
}
_USAGE = """{0} is a command-line tool for displaying information about ROS {1} types.

Commands:
\t{0} show\tShow {2} description
\t{0} info\tAlias for {0} show
\t{0} list\tList all {2}s
\t{0} md5\tDisplay {2} md5sum
\t{0} package\tList {2}s in a package
\t{0} packages\tList packages that contain {2}s

Type {0} <command> -h for more detailed usage
"""


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosmsg`` or ``rossrv``, which the first word says."""
    mode, tokens = _MODES[argv[0]], argv[1:]
    commands = {
        "info": partial(_show, mode),
        "list": partial(_list, mode),
        "md5": partial(_md5, mode),
        "package": partial(_package, mode),
        "packages": partial(_packages, mode),
        "show": partial(_show, mode),
    }
    usage = _USAGE.format(mode.tool, mode.word.capitalize(), mode.word)
    tool = Tool(mode.tool, commands, usage, 64 if tokens else 0, takes_remappings=False)
    learn_workspace_types()
    return run_tool(tool, tokens)


def _show(mode: _Mode, argv: list[str]) -> int:
    parser = option_parser(mode.tool, f"show [options] <{mode.word} type>")
    add_flag(parser, "-r", "--raw", dest="raw", text="show raw message text, including comments")
    parser.add_option("-b", "--bag", metavar="BAGFILE", help="show message from .bag file")
    options, args = parser.parse_args(argv)
    if options.bag:
        return _show_of_bag(options.bag, args, raw=options.raw)
    name = _one(parser, args, f"{mode.word} type").removesuffix(f".{mode.part}")
    if "::" in name or "." in name:
        parser.error(
            f"invalid {mode.word} type '{name}'.\n"
            f"Please refer to {mode.part} types as 'package_name/Type'."
        )
    if "/" in name:
        print(_text(mode, name, raw=options.raw))
        return 0
    found = _named(mode, name)
    if not found:
        near = hint(name, [one.split("/")[1] for one in _types(mode)])
        print(f"Could not find {mode.part} '{name}'{near}", file=sys.stderr)
        return 1
    for one in found:
        print(f"[{one}]:")
        print(_text(mode, one, raw=options.raw))
    return 0


def _show_of_bag(path: str, args: list[str], *, raw: bool) -> int:
    """Print types as a bag defines them; all of them when none is named."""
    from gazelle.bag import ros1_name_of
    from gazelle.cli.rostopic.bag import opened

    kinds = {ros1_name_of(one): one for one in opened(path).connections}
    wanted = [name for name in kinds if not args or args[0] in (name, name.split("/")[1])]
    if args and not wanted:
        raise ToolError(f"type [{args[0]}] is not in bag file [{path}]{hint(args[0], kinds)}")
    for name in wanted:
        if len(wanted) > 1 or not args or "/" not in args[0]:
            print(f"[{name}]:")
        print(kinds[name].definition if raw else show_message(name))
    return 0


def _list(mode: _Mode, argv: list[str]) -> int:
    option_parser(mode.tool, "list").parse_args(argv)
    print("\n".join(_types(mode)))
    return 0


def _md5(mode: _Mode, argv: list[str]) -> int:
    parser = option_parser(mode.tool, f"md5 <{mode.word} type>")
    _, args = parser.parse_args(argv)
    name = _one(parser, args, f"{mode.word} type")
    if "/" in name:
        try:
            print(_sum(mode, name))
        except NotFoundError:
            print(f"Cannot locate [{name}]{hint(name, _types(mode))}", file=sys.stderr)
        return 0
    found = _named(mode, name)
    for one in found:
        print(f"[{one}]: {_sum(mode, one)}")
    if not found:
        near = hint(name, [one.split("/")[1] for one in _types(mode)])
        print(f"No {mode.word}s matching the name [{name}]{near}", file=sys.stderr)
    return 0


def _package(mode: _Mode, argv: list[str]) -> int:
    parser = option_parser(mode.tool, "package <package>")
    add_flag(parser, "-s", dest="single", text="list all on a single line")
    options, args = parser.parse_args(argv)
    package = _one(parser, args, "package")
    types = _types(mode, package)
    if not types:
        every = sorted({one.split("/")[0] for one in _types(mode)})
        print(f"Invalid package: {package}{hint(package, every)}", file=sys.stderr)
        return 64
    print((" " if options.single else "\n").join(types))
    return 0


def _packages(mode: _Mode, argv: list[str]) -> int:
    parser = option_parser(mode.tool, "packages")
    add_flag(parser, "-s", dest="single", text="list all packages on a single line")
    options, _ = parser.parse_args(argv)
    names = sorted({one.split("/")[0] for one in _types(mode)})
    print((" " if options.single else "\n").join(names))
    return 0


def _one(parser: OptionParser, args: list[str], what: str) -> str:
    """Return the one word; read it from standard input when none is given, as the original."""
    if len(args) > 1:
        parser.error(f"you may only specify one {what}")
    found = args[0] if args else sys.stdin.readline().strip()
    if not found:
        parser.error(f"please specify a {what}")
    return found


def _types(mode: _Mode, package: str = "") -> list[str]:
    """Return the types of ROS 1 as ``pkg/Name``; what only ROS 2 has is left out."""
    found = []
    for full in known_types(mode.part, package):
        owner, part, name = full.split("/")
        is_ros1 = find_source(owner, part, name, RosVersion.ROS1) is not None
        if is_ros1 or find_source(owner, part, name, RosVersion.ROS2) is None:
            found.append(f"{owner}/{name}")
    return found


def _named(mode: _Mode, name: str) -> list[str]:
    return [one for one in _types(mode) if one.split("/")[1] == name]


def _text(mode: _Mode, name: str, *, raw: bool) -> str:
    try:
        if raw:
            return _raw_text(mode, name)
        return show_message(name) if mode.part == "msg" else show_service(name)
    except NotFoundError as error:
        what = "Unable to load msg" if mode.part == "msg" else "Unknown srv type"
        raise ToolError(f"{what} [{name}]: {error}") from None


def _raw_text(mode: _Mode, name: str) -> str:
    package, _, bare = name.partition("/")
    if mode.part == "msg":
        return definition(f"{package}/msg/{bare}", RosVersion.ROS1).text
    full = f"{package}/srv/{bare}"
    parts = (definition(f"{full}{end}", RosVersion.ROS1) for end in ("_Request", "_Response"))
    return "\n---\n".join(part.text.strip("\n") for part in parts)


def _sum(mode: _Mode, name: str) -> str:
    return md5sum(name) if mode.part == "msg" else service_md5sum(name)
