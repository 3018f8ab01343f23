"""``gazelle new robot|world|package NAME``: a package that runs at once.

``gazelle new moveit_config ROBOT.urdf`` is `gazelle.cli.new_moveit_config`.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Literal

from gazelle.workspace import Workspace
from gazelle.workspace.scaffold import KINDS, ScaffoldError, check_package_name, create_package

__all__ = ["main"]

_MOVEIT_CONFIG = "moveit_config"


def main(argv: list[str]) -> int:
    """Write the package and say how to start it."""
    if argv[:1] == [_MOVEIT_CONFIG]:
        from gazelle.cli import new_moveit_config

        return new_moveit_config.main(argv[1:], _source_folder(Path.cwd()))
    options = _parser().parse_args(argv)
    check_package_name(options.name)
    parent = options.into or _source_folder(Path.cwd())
    taken = Workspace.discover().packages.get(options.name)
    if taken is not None and taken.path.resolve() != (parent / options.name).resolve():
        raise ScaffoldError(f"there is a package '{options.name}' already: {taken.path}")
    ros_version: Literal[1, 2] = 2 if options.ros2 else 1
    written = create_package(options.kind, options.name, parent, ros_version=ros_version)
    for path in written:
        print(os.path.relpath(path))
    print()
    print("\n".join(_next_steps(options.kind, options.name, ros_version)))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle new",
        description="Write a package with manifest, launch file and what it launches.",
        epilog=f"gazelle new {_MOVEIT_CONFIG} ROBOT.urdf writes a MoveIt config package; "
        f"gazelle new {_MOVEIT_CONFIG} --help says how.",
    )
    add = parser.add_argument
    add("kind", choices=KINDS, help="a robot with its world, a world, or a node")
    add("name", help="of the package")
    ros_version = parser.add_mutually_exclusive_group()
    ros_version.add_argument("--ros1", action="store_true", help="for ROS 1, catkin (the default)")
    ros_version.add_argument("--ros2", action="store_true", help="for ROS 2, ament_python")
    add("--into", type=Path, metavar="FOLDER", help="where to (default: src here, else here)")
    return parser


def _source_folder(here: Path) -> Path:
    """Return a workspace's src when it is called from the workspace's top."""
    is_top = (here / "src").is_dir() and not (here / "package.xml").exists()
    return here / "src" if is_top else here


def _next_steps(kind: str, name: str, ros_version: int) -> list[str]:
    if ros_version == 1:
        steps = [f"start it:   gazelle roslaunch {name} {name}.launch"]
    else:
        steps = [f"start it:   gazelle ros2 launch {name} {name}.launch.py"]
        node = {"robot": "wander", "package": "hello"}.get(kind)
        if node is not None:
            steps.append(f"its node:   gazelle ros2 run {name} {node}")
    return steps if kind == "package" else [*steps, f"look at it: gazelle view {name}"]
