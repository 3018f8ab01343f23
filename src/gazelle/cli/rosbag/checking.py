"""``rosbag check`` and ``fix``: bags whose types are defined differently here."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import NamedTuple

from gazelle.bag import BagReader, Connection, Storage, create_bag, open_bag, ros1_name_of
from gazelle.bag.copying import copy_bag
from gazelle.bag.unindexed import tell_of_unindexed
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.cli.tool import ToolError, add_flag, option_parser
from gazelle.diagnostics import Diagnostics, render
from gazelle.errors import NotFoundError
from gazelle.interfaces import md5sum, ros1_definition

__all__ = ["check", "fix"]


class _Difference(NamedTuple):
    """A type that the bag and the system define differently; `own_sum` is empty for unknown."""

    type_name: str
    bag_sum: str
    own_sum: str
    lines: tuple[str, ...]


def check(words: list[str]) -> int:
    """Tell which types of a bag are defined differently in the current system."""
    parser = option_parser("rosbag", "check BAG")
    add_flag(parser, "-n", "--noplugins", dest="noplugins", text="accepted: there are no plugins")
    _, args = parser.parse_args(words)
    if not args:
        parser.error("You must specify a bag file to check.")
    found = _differences(open_bag(args[0]))
    if not found:
        print("Bag file does not need any migrations.")
        return 0
    _print(found)
    return 1


def fix(words: list[str]) -> int:
    """Write a bag anew, with an index; types that are defined differently are not translated."""
    parser = option_parser("rosbag", "fix INBAG OUTBAG")
    add_flag(parser, "-n", "--noplugins", dest="noplugins", text="accepted: there are no plugins")
    _, args = parser.parse_args(words)
    if len(args) < 1:
        parser.error("You must pass input and output bag files.")
    if len(args) < 2:
        parser.error("You must pass an output bag file.")
    source, target = Path(args[0]), Path(args[1])
    if source.resolve() == target.resolve():
        raise ToolError(f"Cannot use same file as input and output [{source}]")
    bag = open_bag(source)
    found = _differences(bag)
    if found:
        print("Bag could not be migrated.  The following messages could not be migrated:")
        _print(found)
        return 1
    writer, diagnostics = create_bag(target, Storage.ROS1), Diagnostics()
    copy_bag(bag, writer, diagnostics=diagnostics)
    writer.close()
    print("Bag migrated successfully.")
    render(diagnostics)
    return 0


def _differences(bag: BagReader) -> list[_Difference]:
    learn_workspace_types()
    tell_of_unindexed(bag)
    kinds = {one.type_name: one for one in bag.connections if one.md5sum not in ("", "*")}
    compared = (_compare(one) for _, one in sorted(kinds.items()))
    return [one for one in compared if one is not None]


def _compare(one: Connection) -> _Difference | None:
    name = ros1_name_of(one)
    try:
        own = md5sum(name)
    except NotFoundError:
        return _Difference(name, one.md5sum, "", ())
    if own == one.md5sum:
        return None
    old, new = _plain(one.definition), _plain(ros1_definition(name))
    lines = [line for line in difflib.ndiff(old, new) if line.startswith(("- ", "+ "))]
    return _Difference(name, one.md5sum, own, tuple(lines))


def _plain(text: str) -> list[str]:
    """Lines without comments and blanks, so that only what counts is compared."""
    lines = (" ".join(line.partition("#")[0].split()) for line in text.splitlines())
    return [line for line in lines if line and not line.startswith("=====")]


def _print(found: list[_Difference]) -> None:
    print("The following migrations need to occur:")
    for one in found:
        target = f"[{one.own_sum}]" if one.own_sum else "(this type is not known here)"
        print(f" * From: {one.type_name} [{one.bag_sum}]\n   To:   {one.type_name} {target}")
        for line in one.lines:
            print(f"     {line}")
