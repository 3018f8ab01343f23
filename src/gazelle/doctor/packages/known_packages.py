"""Names of packages that come with ROS, so that a mistyped one is told from one not here."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import gazelle.interfaces
from gazelle.node_specs.unavailable_packages import packages_elsewhere
from gazelle.workspace.environment_paths import builtin_package_names

__all__ = ["is_ros_package", "known_packages"]

_FAMILIES = ("ament_", "nav2_", "ros2", "rosidl_", "rqt_", "moveit_", "ros_gz", "ros_ign", "gz_")


@cache
def known_packages() -> frozenset[str]:
    """Return packages of ROS distributions: those elsewhere, stood in for, and of messages."""
    definitions = Path(gazelle.interfaces.__file__).parent / "definitions"
    messages = {path.stem for path in definitions.rglob("*.txt")}
    return packages_elsewhere() | builtin_package_names() | messages


def is_ros_package(name: str) -> bool:
    """Tell whether a package comes with ROS."""
    return name in known_packages() or name.startswith(_FAMILIES)
