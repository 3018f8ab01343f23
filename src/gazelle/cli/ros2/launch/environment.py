"""The environment of a launch: what launch files, and the processes of them, find."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping

from gazelle.launch.environment import drop_in_folder, node_environment
from gazelle.workspace.ament_index import known_workspace

__all__ = ["ros2_environment", "surround_launch_files"]

_DISTRO = "humble"
_ROS1_DISTROS = frozenset({"", "noetic", "melodic", "kinetic", "indigo", "jade", "lunar", "hydro"})


def ros2_environment(environ: Mapping[str, str]) -> dict[str, str]:
    """Return an environment in which ROS's commands and modules are Gazelle's, as ROS 2 has it.

    Some launch files choose files by ``ROS_DISTRO``; without a ROS 2 it is one that most know.
    """
    given = dict(environ)
    if given.get("ROS_DISTRO", "") in _ROS1_DISTROS:
        given["ROS_DISTRO"] = _DISTRO
    given["ROS_VERSION"] = "2"
    given.setdefault("ROS_PYTHON_VERSION", "3")
    return node_environment(given, known_workspace())


def surround_launch_files() -> None:
    """Let this process, in which launch files are run, have that environment and the modules."""
    from gazelle.compat.import_hooks import install

    os.environ.update(ros2_environment(os.environ))
    folder = str(drop_in_folder())
    if folder not in sys.path:
        sys.path.insert(1, folder)
    install()
