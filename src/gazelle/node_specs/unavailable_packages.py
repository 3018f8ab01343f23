"""What is said of packages and programs of ROS that are not here, and what does their work."""

from __future__ import annotations

from functools import cache

from gazelle.errors import NotFoundError
from gazelle.node_specs.unavailable_package_rows import (
    FAMILIES,
    PACKAGES,
    PROGRAMS,
    PackageElsewhere,
    ProgramElsewhere,
    Sends,
)

__all__ = [
    "missing_node",
    "missing_package",
    "packages_elsewhere",
    "replacement_of",
    "what_it_sends",
]

# Commands by the version of ROS whose user is told of them.
_COMMANDS = {
    1: {
        "topic": "rostopic",
        "param": "rosparam",
        "rviz": "rviz",
        "controllers": "`controller_manager list`, `start` and `stop`",
    },
    2: {
        "topic": "ros2 topic",
        "param": "ros2 param",
        "rviz": "rviz2",
        "controllers": "`ros2 control list_controllers`, `switch_controllers`, "
        "`list_hardware_components` and `set_hardware_component_state`",
    },
}


def packages_elsewhere() -> frozenset[str]:
    """Return the names of packages that ROS has and Gazelle has not."""
    return frozenset(_packages())


def what_it_sends(package: str, executable: str) -> Sends:
    """Return what of tf and joint states a node that is not here sends in ROS."""
    program = _programs().get((package, executable))
    if program is not None:
        return program.sends
    row = _row(package)
    return Sends.ANYTHING if row is None else row.sends


def replacement_of(package: str, ros_version: int = 2) -> str:
    """Return what a package of ROS is and what replaces it here; empty when that is not known.

    Args:
        package: its name.
        ros_version: whose commands are named.
    """
    row = _row(package)
    known = "" if row is None else row.instead.format_map(_COMMANDS[ros_version])
    return f"{package} is {known}" if known.startswith(("the ", "a ", "compiled")) else known


def missing_node(package: str, name: str) -> str:
    """Return what a program is that its package has in ROS and not here, and what does its work.

    Empty for programs that are not known: those are misspelt, or the user's.
    """
    known = _programs().get((package, name))
    return f"{name} is {known.instead}" if known is not None else ""


def missing_package(error: NotFoundError, ros_version: int) -> tuple[str, str]:
    """Return what is said of a package that is not found, and what to do about it.

    A package of ROS whose work is done by something here cannot be put into a workspace: most are
    C++.
    """
    # A package of the workspace with nearly this name is meant, unless this one is known itself.
    row = _packages().get(error.name)
    is_other = bool(error.nearest) and (row is None or not row.instead)
    known = "" if is_other else replacement_of(error.name, ros_version)
    text = str(error)
    return (text.partition("\n")[0].partition(";")[0] if known else text), known


def _row(package: str) -> PackageElsewhere | None:
    own = _packages().get(package)
    if own is not None and own.instead:
        return own
    return next((row for row in FAMILIES if package.startswith(row.name)), own)


@cache
def _packages() -> dict[str, PackageElsewhere]:
    return {row.name: row for row in PACKAGES}


@cache
def _programs() -> dict[tuple[str, str], ProgramElsewhere]:
    return {(row.package, row.executable): row for row in PROGRAMS}
