"""``gazelle new moveit_config ROBOT.urdf``: a MoveIt config package that the robot suggests."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace
from gazelle.workspace.scaffold import ScaffoldError, check_package_name

if TYPE_CHECKING:
    from gazelle.description.model import Model
    from gazelle.motion.setup_assistant import (
        ChosenChain,
        ChosenHand,
        CollisionSearch,
        PlannedFile,
        RobotSource,
        SetupAssistantConfig,
    )
    from gazelle.motion.setup_assistant.config import RosVersion

__all__ = ["main"]

_WIDE = 200
_GROUP = re.compile(r"([^=:]+)=([^=:]+):([^=:]+)")
_HAND = re.compile(r"([^=:]+)=([^=:]+)")


def main(argv: list[str], source_folder: Path) -> int:
    """Write the package, show what was proposed and say what to type next.

    Args:
        argv: words behind ``gazelle new moveit_config``.
        source_folder: where packages are made unless the words say otherwise.
    """
    options = _parser().parse_args(argv)
    parent: Path = options.into or source_folder
    robot_file = Path(options.robot)
    workspace = Workspace.discover(extra=[robot_file.resolve().parent, parent])
    found = Diagnostics()
    from gazelle.motion.setup_assistant import read_robot

    source, model = read_robot(
        robot_file,
        workspace=workspace,
        diagnostics=found,
        xacro_args=" ".join(options.xacro_args),
    )
    config = _proposal(options, source, model, _ros_version(options, workspace, source), found)
    folder = parent / config.package_name
    _check_place(workspace, folder, config.package_name, update=options.update)
    if options.update:
        config = _updated(config, model, folder, workspace, options)
    for finding in found.errors:
        print(finding, file=sys.stderr)
    written, kept = _written(config, folder, options.overwrite)
    print("\n".join(os.path.relpath(folder / item.path) for item in written))
    print()
    _show(config)
    if kept:
        print("\nedited since they were written, and kept (--overwrite FILE writes them):")
        print("\n".join(f"    {path}" for path in kept))
    print()
    from gazelle.motion.setup_assistant.next_steps import next_steps

    print("\n".join(next_steps(config)))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle new moveit_config",
        description="Write a MoveIt config package for a robot, as MoveIt's Setup Assistant does: "
        "planning groups, named poses, pairs of links that need no collision check, controllers.",
    )
    add = parser.add_argument
    add("robot", help="its URDF or xacro")
    ros_version = parser.add_mutually_exclusive_group()
    ros_version.add_argument("--ros1", action="store_true", help="for MoveIt 1")
    ros_version.add_argument("--ros2", action="store_true", help="for MoveIt 2")
    add(
        "--group",
        action="append",
        default=[],
        metavar="NAME=BASE:TIP",
        help="a planning group of the joints between two links, in place of the proposed arms",
    )
    add(
        "--ee",
        action="append",
        default=[],
        metavar="NAME=LINK",
        help="an end effector: a group of the joints below a link, in place of proposed hands",
    )
    add("--name", default="", help="of the package (default: ROBOT_moveit_config)")
    add("--xacro-args", nargs="+", default=[], metavar="NAME:=VALUE", help="for the robot's xacro")
    add(
        "--trials",
        type=int,
        default=10_000,
        metavar="N",
        help="random configurations that links are looked for in that never meet (10000)",
    )
    add("--seed", type=int, default=0, metavar="N", help="of those configurations (0)")
    add("--author", default="", help="who maintains the package")
    add("--email", default="", help="his or her address")
    add("--into", type=Path, metavar="FOLDER", help="where to (default: src here, else here)")
    add("--update", action="store_true", help="of a package that is there: look at the robot anew")
    add(
        "--overwrite",
        action="append",
        default=[],
        metavar="FILE",
        help="with --update, write a file of the package although somebody edited it",
    )
    return parser


def _ros_version(
    options: argparse.Namespace, workspace: Workspace, source: RobotSource
) -> RosVersion:
    """What was asked for, else that of the robot's own package."""
    if options.ros1 or options.ros2:
        return 1 if options.ros1 else 2
    package = workspace.user_package(source.package) if source.package else None
    return 2 if package is not None and package.ros_version == 2 else 1


def _proposal(
    options: argparse.Namespace,
    source: RobotSource,
    model: Model,
    ros_version: RosVersion,
    found: Diagnostics,
) -> SetupAssistantConfig:
    from gazelle.motion.model import RobotModel
    from gazelle.motion.setup_assistant import chosen_groups, propose
    from gazelle.motion.setup_assistant.proposal import package_name_for

    chains, hands = _chains(options.group), _hands(options.ee)
    name = options.name or package_name_for(model.name)
    check_package_name(name)
    groups = chosen_groups(RobotModel.build(model, diagnostics=Diagnostics()), chains, hands)
    with _search(options) as search:
        config = propose(
            model,
            source,
            diagnostics=found,
            ros_version=ros_version,
            package_name=name,
            groups=groups,
            search=search,
        )
    author = config.author
    author = replace(
        author, name=options.author or author.name, email=options.email or author.email
    )
    return replace(config, author=author)


def _updated(
    proposed: SetupAssistantConfig,
    model: Model,
    folder: Path,
    workspace: Workspace,
    options: argparse.Namespace,
) -> SetupAssistantConfig:
    """What the package says already, with the pairs that need no check found anew."""
    from gazelle.motion.setup_assistant import read_config_package, with_groups

    there, _ = read_config_package(folder, workspace=workspace, diagnostics=Diagnostics())
    srdf = replace(there.srdf, disabled_pairs=proposed.srdf.disabled_pairs)
    config = replace(there, srdf=srdf, collision_trials=proposed.collision_trials)
    if options.group or options.ee:
        return with_groups(config, model, proposed.srdf.groups, proposed.srdf.end_effectors)
    return config


def _chains(words: Sequence[str]) -> list[ChosenChain]:
    from gazelle.motion.setup_assistant import ChosenChain

    return [ChosenChain(*_matched(word, _GROUP, "--group NAME=BASE:TIP")) for word in words]


def _hands(words: Sequence[str]) -> list[ChosenHand]:
    from gazelle.motion.setup_assistant import ChosenHand

    return [ChosenHand(*_matched(word, _HAND, "--ee NAME=LINK")) for word in words]


def _matched(word: str, form: re.Pattern[str], usage: str) -> tuple[str, ...]:
    match = form.fullmatch(word)
    if match is None:
        raise ScaffoldError(f"'{word}' is not understood; write {usage}")
    return tuple(match.groups())


@contextmanager
def _search(options: argparse.Namespace) -> Iterator[CollisionSearch]:
    """How pairs are looked for; a person at a terminal sees how far it is."""
    from gazelle.motion.setup_assistant import CollisionSearch

    if options.trials < 1:
        raise ScaffoldError("--trials: at least one is needed")
    with _progress() as told:
        yield CollisionSearch(options.trials, seed=options.seed, progress=told)


@contextmanager
def _progress() -> Iterator[Callable[[float], None] | None]:
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console

    with Console(file=sys.stderr).status("looking for links that never meet") as status:
        yield lambda done: status.update(f"looking for links that never meet: {done:.0%}")


def _check_place(workspace: Workspace, folder: Path, name: str, *, update: bool) -> None:
    taken = workspace.packages.get(name)
    if taken is not None and taken.path.resolve() != folder.resolve():
        raise ScaffoldError(f"there is a package '{name}' already: {taken.path}")
    is_there = folder.is_dir() and any(folder.iterdir())
    if is_there and not update:
        raise ScaffoldError(
            f"{folder} is there already; nothing was written (--update looks at the robot anew "
            "and keeps what was edited)"
        )
    if update and not is_there:
        raise ScaffoldError(f"{folder} is not there; leave --update out to make it")


def _written(
    config: SetupAssistantConfig, folder: Path, overwrite: Sequence[str]
) -> tuple[list[PlannedFile], list[str]]:
    """Write the package; return what was written and what was edited and kept."""
    from gazelle.motion.setup_assistant import FileState, planned_files, write_package

    planned = planned_files(config, folder)
    unknown = sorted(set(overwrite) - {item.path for item in planned})
    if unknown:
        raise ScaffoldError(
            f"--overwrite: '{unknown[0]}' is no file that the package is written of"
        )
    written = write_package(config, folder, overwrite=overwrite)
    paths = {item.path for item in written}
    edited = [item.path for item in planned if item.state is FileState.EDITED]
    return list(written), [path for path in edited if path not in paths]


def _show(config: SetupAssistantConfig) -> None:
    """Print what was proposed as a table."""
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 3, 0, 0))
    for row in _rows(config):
        table.add_row(*row)
    console = Console(width=None if sys.stdout.isatty() else _WIDE, highlight=False)
    with console.capture() as captured:
        console.print(table)
    print("\n".join(line.rstrip() for line in captured.get().splitlines()))


def _rows(config: SetupAssistantConfig) -> Iterator[tuple[str, str]]:
    srdf = config.srdf
    for group in srdf.groups:
        chains = [f"{chain.base_link} to {chain.tip_link}" for chain in group.chains]
        parts = [*chains, *group.links, *group.joints, *group.subgroups]
        yield f"group {group.name}", ", ".join(parts)
    for state in srdf.states:
        values = ", ".join(f"{values[0]:g}" for values in state.values.values())
        yield f"pose {state.group}/{state.name}", values
    for effector in srdf.end_effectors:
        where = f"{effector.group} on {effector.parent_link} of {effector.parent_group}"
        yield f"end effector {effector.name}", where
    for joint in srdf.virtual_joints:
        yield (
            f"virtual joint {joint.name}",
            f"{joint.type}, {joint.parent_frame} to {joint.child_link}",
        )
    if srdf.passive_joints:
        yield "passive joints", ", ".join(srdf.passive_joints)
    for controller in config.controllers:
        yield f"controller {controller.name}", f"{controller.plugin}, {controller.type}"
    counts: dict[str, int] = {}
    for pair in srdf.disabled_pairs:
        counts[pair.reason] = counts.get(pair.reason, 0) + 1
    shown = ", ".join(f"{count} {reason}" for reason, count in counts.items())
    yield "pairs without a check", f"{len(srdf.disabled_pairs)}: {shown}" if shown else "none"
