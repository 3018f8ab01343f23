"""Which built-in node answers to which name."""

from __future__ import annotations

from functools import cache

from gazelle.node_specs.commands import COMMANDS
from gazelle.node_specs.control import CONTROL
from gazelle.node_specs.driving import DRIVING
from gazelle.node_specs.guis import WINDOWS
from gazelle.node_specs.installed import installed_names, installed_spec
from gazelle.node_specs.localization import LOCALISATION
from gazelle.node_specs.navigation import NAVIGATION
from gazelle.node_specs.simulation import SIMULATION
from gazelle.node_specs.slam import SLAM
from gazelle.node_specs.spec import NodeSpec
from gazelle.node_specs.topics import TOPICS
from gazelle.node_specs.transforms import TRANSFORMS
from gazelle.node_specs.turtlesim import TURTLES

__all__ = [
    "builtin_executables",
    "builtin_packages",
    "command_of",
    "names_of_other_ros",
    "node_spec",
    "node_specs",
]

_SPECS = (
    *SIMULATION,
    *TRANSFORMS,
    *CONTROL,
    *TOPICS,
    *NAVIGATION,
    *LOCALISATION,
    *SLAM,
    *TURTLES,
    *DRIVING,
    *WINDOWS,
)


def node_specs() -> tuple[NodeSpec, ...]:
    """Return the rows of all built-in nodes."""
    return _SPECS


def node_spec(package: str, executable: str) -> NodeSpec | None:
    """Return the node that answers to a name, or None; installed packages add theirs.

    Raises:
        ExtensionError: an installed package names one that cannot be had.
    """
    return _by_name().get((package, executable)) or installed_spec(package, executable)


def builtin_executables(package: str) -> tuple[str, ...]:
    """Return the executables that exist under a package's name, commands included."""
    names = (*_by_name(), *_commands(), *installed_names())
    return tuple(sorted({name for owner, name in names if owner == package}))


def command_of(package: str, executable: str) -> tuple[str, ...]:
    """Return the words behind ``gazelle`` of a command that is named as a node; empty for none."""
    return tuple(_commands().get((package, executable), "").split())


def builtin_packages() -> frozenset[str]:
    """Return the packages that have built-in nodes, or installed ones."""
    return frozenset(package for package, _executable in (*_by_name(), *installed_names()))


@cache
def names_of_other_ros(ros_version: int) -> frozenset[tuple[str, str]]:
    """Return packages and executables that only the other version of ROS has.

    A package all of whose executables are such stands there once more, with an empty executable.
    """
    names = [*COMMANDS, *(name for spec in _SPECS for name in spec.names)]
    own = {name.package for name in names if ros_version in name.ros}
    others = [name for name in names if ros_version not in name.ros]
    packages = {(name.package, "") for name in others if name.package not in own}
    return frozenset(packages | {(name.package, name.executable) for name in others})


@cache
def _by_name() -> dict[tuple[str, str], NodeSpec]:
    return {(name.package, name.executable): spec for spec in _SPECS for name in spec.names}


@cache
def _commands() -> dict[tuple[str, str], str]:
    return {(name.package, name.executable): words for name, words in COMMANDS.items()}
