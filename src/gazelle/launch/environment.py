"""The environment of launched nodes: drop-in modules and ROS-named commands on their paths."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cache_folders import own_cache
from gazelle.user_folders import cache_folder

if TYPE_CHECKING:
    from gazelle.workspace import Workspace

__all__ = [
    "ROS_COMMANDS",
    "command_folder",
    "drop_in_folder",
    "is_own_command",
    "node_environment",
    "ros1_variables",
]

# What makes several commands of one.
_SHELL_SIGNS = frozenset(";&|`\n")

ROS_COMMANDS = (
    "catkin",
    "catkin_create_pkg",
    "catkin_make",
    "check_urdf",
    "colcon",
    "gazebo",
    "gz",
    "gzclient",
    "gzserver",
    "ign",
    "launch_test",
    "ros2",
    "rosbag",
    "rosclean",
    "roscore",
    "rosdep",
    "roslaunch",
    "rosmsg",
    "rosnode",
    "rospack",
    "rosparam",
    "rosrun",
    "rosservice",
    "rossrv",
    "rostest",
    "rostopic",
    "rosversion",
    "roswtf",
    "rqt",
    "rqt_bag",
    "rqt_console",
    "rqt_graph",
    "rqt_image_view",
    "rqt_logger_level",
    "rqt_plot",
    "rqt_publisher",
    "rqt_reconfigure",
    "rqt_robot_steering",
    "rqt_service_caller",
    "rqt_tf_tree",
    "rqt_topic",
    "rviz",
    "rviz2",
    "urdf_to_graphiz",
    "urdf_to_graphviz",
    "xacro",
)


def drop_in_folder() -> Path:
    """Return the folder with `rospy` and its kin; only nodes of ours have it on their path."""
    return Path(__file__).parents[1] / "compat" / "modules"


def command_folder() -> Path:
    """Return a folder with the ROS-named commands, made on first use for this Python."""
    import hashlib

    key = hashlib.sha256(f"{sys.executable}\0{__file__}".encode()).hexdigest()[:12]
    top = own_cache("bin")
    if top is None:
        # Says which folder cannot be used, and why.
        top = cache_folder() / "bin"
    folder = top / key
    folder.mkdir(parents=True, exist_ok=True)
    for name in ROS_COMMANDS:
        script = folder / name
        text = f'#!/bin/sh\nexec "{sys.executable}" -m gazelle.cli {name} "$@"\n'
        if not script.is_file() or script.read_text(encoding="utf-8") != text:
            part = script.with_suffix(f".{os.getpid()}")
            part.write_text(text, encoding="utf-8")
            part.chmod(0o755)
            part.replace(script)
    return folder


def is_own_command(argv: Sequence[str], path: str | None) -> bool:
    """Tell whether a command is one of Gazelle's, which all begin with `end_at_interrupts`.

    Args:
        argv: the command, or one word that a shell splits.
        path: ``PATH`` where it is looked for.
    """
    if list(argv[:2]) == [sys.executable, "-m"]:
        return argv[2].startswith("gazelle.")
    text = " ".join(argv)
    if not set(text).isdisjoint(_SHELL_SIGNS):
        return False
    name, *_ = [*text.removeprefix("exec ").split(), ""]
    found = shutil.which(name, path=path) if name else None
    return found is not None and command_folder() in Path(found).parents


def node_environment(environ: Mapping[str, str], workspace: Workspace) -> dict[str, str]:
    """Return the environment for nodes and commands of a launch.

    A real ROS on the path stays reachable: our folders only come first.
    """
    environment = dict(environ)
    environment["PATH"] = _prepended(command_folder(), environ.get("PATH", ""))
    environment["PYTHONPATH"] = _prepended(drop_in_folder(), environ.get("PYTHONPATH", ""))
    # Nodes run in another folder and must find what this one's workspace has.
    found = [*environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep), *_source_folders(workspace)]
    environment["ROS_PACKAGE_PATH"] = os.pathsep.join(dict.fromkeys(filter(None, found)))
    environment.setdefault("PYTHONUNBUFFERED", "1")
    return {**ros1_variables(environment), **environment}


def ros1_variables(environ: Mapping[str, str]) -> dict[str, str]:
    """Return what every shell with ROS 1 has set, where `environ` has nothing else.

    Launch files take that for granted: ``$(env ROS_DISTRO)``.
    """
    variables = {
        "ROS_DISTRO": "noetic",
        "ROS_MASTER_URI": "http://localhost:11311",
        "ROS_PYTHON_VERSION": "3",
        "ROS_VERSION": "1",
    }
    return {name: environ.get(name, value) for name, value in variables.items()}


def _source_folders(workspace: Workspace) -> list[str]:
    folders = {str(item.path.parent) for item in workspace.user_packages}
    return sorted(folders)


def _prepended(folder: Path, path: str) -> str:
    parts = [part for part in path.split(os.pathsep) if part and part != str(folder)]
    return os.pathsep.join([str(folder), *parts])
