"""``rosbag check`` and ``fix``: bags whose types are defined differently here."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from gazelle.bag import BagReader, BagWriter, Connection, Encoding, create_bag, open_bag
from gazelle.bag.conversion import copy_bag
from gazelle.bag.formats import ROS1
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.bag.type_migration import Change, Migration, migration_of
from gazelle.cli.ros_tool import ToolError, add_flag, option_parser
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.diagnostics import Diagnostics, render
from gazelle.interfaces import md5sum, ros1_definition

__all__ = ["check", "fix"]

_NO_RULES = "accepted: rule files are not read"


def check(argv: list[str]) -> int:
    """Tell which types of a bag are defined differently in the current system."""
    parser = option_parser("rosbag", "check BAG")
    add_flag(parser, "-n", "--noplugins", dest="noplugins", text=_NO_RULES)
    _, args = parser.parse_args(argv)
    if not args:
        parser.error("You must specify a bag file to check.")
    _refuse_rules(args[1:])
    migrations = [one for one in _migrations(open_bag(args[0])).values() if one is not None]
    if not migrations:
        print("Bag file does not need any migrations.")
        return 0
    print("The following migrations need to occur:")
    _print(migrations)
    if any(one.missing for one in migrations):
        print(f"\n`rosbag fix {args[0]} OUTBAG --force` copies these messages as they are")
    else:
        print("\nAll rules defined.  Bag is ready to be migrated")
    return 0


def fix(argv: list[str]) -> int:
    """Write a bag anew, with an index and its messages in the types of the current system."""
    parser = option_parser("rosbag", "fix INBAG OUTBAG")
    add_flag(parser, "-n", "--noplugins", dest="noplugins", text=_NO_RULES)
    text = "proceed, and copy what cannot be migrated as it is"
    add_flag(parser, "--force", dest="force", text=text)
    options, args = parser.parse_args(argv)
    if len(args) < 1:
        parser.error("You must pass input and output bag files.")
    if len(args) < 2:
        parser.error("You must pass an output bag file.")
    if Path(args[1]).suffix == ".bmr":
        parser.error("Input file should be a bag file, not a rule file.")
    if Path(args[1]).suffix != ROS1.suffix:
        parser.error("Output file must be a bag file.")
    _refuse_rules(args[2:])
    source, target = Path(args[0]), Path(args[1])
    if source.resolve() == target.resolve():
        raise ToolError(f"Cannot use same file as input and output [{source}]")
    bag = open_bag(source)
    migrations = _migrations(bag)
    missing = [one for one in migrations.values() if one is not None and one.missing]
    if missing and not options.force:
        text = "The following migrations could not be performed:"
        print(f"Bag could not be migrated.  {text}")
        _print(missing)
        print("Try running 'rosbag fix' with the '--force' option.")
        return 1
    _write(bag, target, migrations)
    print("Bag migrated successfully.")
    return 0


def _refuse_rules(names: list[str]) -> None:
    if names:
        text = f"{names[0]}: rule files (.bmr) are programs for genpy, which are not run here"
        hint = "`rosbag fix` of ROS Noetic reads them"
        raise ToolError(f"{text}; types with the same fields need none\n  fix: {hint}")


def _migrations(bag: BagReader) -> dict[int, Migration | None]:
    """Return what has to happen to each connection of the bag."""
    learn_workspace_types()
    warn_of_unindexed(bag)
    known: dict[tuple[str, str], Migration | None] = {}
    found: dict[int, Migration | None] = {}
    counts = bag.summary.counts
    for one in bag.connections:
        key = (one.type_name, one.md5sum)
        if one.encoding is not Encoding.ROS1 or one.md5sum in ("", "*") or not counts.get(one.id):
            found[one.id] = None
            continue
        if key not in known:
            known[key] = migration_of(one)
        found[one.id] = known[key]
    return found


def _write(bag: BagReader, target: Path, migrations: dict[int, Migration | None]) -> None:
    packing = next((name for name in bag.summary.packs if name in ("bz2", "lz4")), "")
    part, diagnostics = target.with_name(f"{target.name}.tmp"), Diagnostics()
    writer = create_bag(part, ROS1.name, compression=packing)
    if any(one.encoding is not Encoding.ROS1 for one in bag.connections):
        copy_bag(bag, writer, diagnostics=diagnostics)
    else:
        _migrate(bag, writer, migrations)
    writer.close()
    part.replace(target)
    render(diagnostics)


def _migrate(bag: BagReader, writer: BagWriter, migrations: dict[int, Migration | None]) -> None:
    routes: dict[int, Connection] = {}
    for message in bag.messages():
        one, stamp_ns, data = message
        migration = migrations[one.id]
        convert = None if migration is None else migration.convert
        if one.id not in routes:
            new = one if convert is None else _as_known_here(one)
            routes[one.id] = writer.add(new)
        writer.write(routes[one.id], stamp_ns, data if convert is None else convert(data))


def _as_known_here(one: Connection) -> Connection:
    name = one.type_name
    return replace(one, md5sum=md5sum(name), definition=ros1_definition(name))


def _print(migrations: list[Migration]) -> None:
    """Print as the real one does; why something cannot be migrated goes to stderr."""
    told = set()
    for one in dict.fromkeys(migrations):
        _print_change(one.changes[0], "")
        if one.missing:
            print(f"    {len(one.missing)} rules missing:")
        for change in one.missing:
            _print_change(change, "    ")
    sys.stdout.flush()
    for change in (change for one in migrations for change in one.missing):
        for text in change.problems:
            if (line := f"{change.type_name}: {text}") not in told:
                told.add(line)
                print(line, file=sys.stderr)


def _print_change(one: Change, indent: str) -> None:
    target = f"{one.type_name} [{one.own_sum}]" if one.own_sum else "Unknown"
    print(f"{indent} * From: {one.type_name} [{one.bag_sum}]\n{indent}   To:   {target}")
