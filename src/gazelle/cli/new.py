"""``gazelle new robot|world|package NAME``: a package that runs at once.

``gazelle new moveit_config ROBOT.urdf`` is `gazelle.cli.new_moveit_config`; ``gazelle new robot``
without a name, or with a robot's file, opens the page's Setup Assistant.
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
_ASSISTANT = "moveit_setup_assistant/moveit_setup_assistant"
_DESCRIPTIONS = (".urdf", ".xacro")


def main(argv: list[str]) -> int:
    """Write the package and say how to start it."""
    if argv[:1] == [_MOVEIT_CONFIG]:
        from gazelle.cli import new_moveit_config

        return new_moveit_config.main(argv[1:], _source_folder(Path.cwd()))
    parser = _parser()
    options = parser.parse_args(argv)
    if options.kind == "robot" and (options.name or _DESCRIPTIONS[0]).endswith(_DESCRIPTIONS):
        return _open_assistant(options.name)
    if options.name is None:
        parser.error("the name of the package is missing")
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
    add(
        "name",
        nargs="?",
        help="of the package; of a robot its URDF or xacro, or nothing: the page's Setup Assistant",
    )
    ros_version = parser.add_mutually_exclusive_group()
    ros_version.add_argument("--ros1", action="store_true", help="for ROS 1, catkin (the default)")
    ros_version.add_argument("--ros2", action="store_true", help="for ROS 2, ament_python")
    add("--into", type=Path, metavar="FOLDER", help="where to (default: src here, else here)")
    return parser


def _open_assistant(file: str | None) -> int:
    """Show the page's Setup Assistant, on a robot's file if there is one, until Ctrl-C."""
    from gazelle.nodes.__main__ import main as run_node

    if file is not None and not Path(file).is_file():
        raise ScaffoldError(f"there is no file {file}")
    os.environ.setdefault("ROS_NAMESPACE", "/")
    return run_node([_ASSISTANT, *(["--urdf_path", file] if file else [])])


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
