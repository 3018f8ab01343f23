"""Which built-in node answers to a name: nodes, components, commands, those of pip packages."""

from __future__ import annotations

import re
from functools import cache

from gazelle.node_specs.control import CONTROL
from gazelle.node_specs.driving import DRIVING
from gazelle.node_specs.guis import WINDOWS
from gazelle.node_specs.localization import LOCALISATION
from gazelle.node_specs.navigation import NAVIGATION
from gazelle.node_specs.robot_state_and_tf import TRANSFORMS
from gazelle.node_specs.simulation import SIMULATION
from gazelle.node_specs.slam import SLAM
from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeSpec
from gazelle.node_specs.topics import TOPICS
from gazelle.node_specs.turtlesim import TURTLES

__all__ = [
    "COMMANDS",
    "builtin_executables",
    "builtin_packages",
    "command_of",
    "executable_of_component",
    "installed_names",
    "installed_spec",
    "names_of_other_ros",
    "node_spec",
    "node_specs",
]


# The words behind ``gazelle`` by name.
COMMANDS: dict[NodeName, str] = {
    **{
        NodeName(name, name, ROS_1): name
        for name in ("rosmsg", "rosnode", "rosparam", "rosservice", "rostopic")
    },
    NodeName("dynamic_reconfigure", "dynparam", ROS_1): "dynparam",
    NodeName("tf", "tf_echo", ROS_1): "tf_echo",
    NodeName("tf2_ros", "tf2_echo", ROS_2): "tf_echo --tf2",
    NodeName("tf", "tf_monitor", ROS_1): "tf_monitor",
    NodeName("tf2_ros", "tf2_monitor", ROS_2): "tf_monitor",
    NodeName("tf", "view_frames", ROS_1): "view_frames",
    NodeName("tf2_tools", "view_frames", ROS_2): "view_frames --tf2",
    NodeName("tf2_tools", "view_frames.py"): "view_frames --tf2",
    NodeName("xacro", "xacro"): "xacro",
    NodeName("xacro", "xacro.py", ROS_1): "xacro",
}

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
_WORD = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")
_SUFFIXES = ("_node", "_component", "_nodelet")

# Components whose names say something else than the node that does their work.
_OTHERS = {
    "ros_gz_bridge::RosGzBridge": "bridge_node",
    "ros_gz_sim::GzServer": "gzserver",
    "tf2_ros::StaticTransformBroadcasterNode": "static_transform_publisher",
}


def installed_names() -> tuple[tuple[str, str], ...]:
    """Return packages of ROS and executables that installed packages add; imports none."""
    from gazelle.extensions import ExtensionGroup, entry_points_of

    names = (point.name.partition("/") for point in entry_points_of(ExtensionGroup.NODES))
    return tuple((package, executable) for package, _, executable in names)


def installed_spec(package: str, executable: str) -> NodeSpec | None:
    """Return the row of an installed package's node, None when there is none of this name.

    Raises:
        ExtensionError: the row cannot be imported, or is something else.
    """
    from gazelle.extensions import ExtensionGroup, find_entry_point, load_extension

    point = find_entry_point(ExtensionGroup.NODES, f"{package}/{executable}")
    return None if point is None else load_extension(point, NodeSpec)


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


def executable_of_component(package: str, plugin: str) -> str:
    """Return the executable that does the work of a component, empty when there is none.

    Args:
        package: of the component.
        plugin: its type, such as ``robot_state_publisher::RobotStatePublisher``.
    """
    name = _OTHERS.get(plugin) or _WORD.sub("_", plugin.rpartition("::")[2]).lower()
    bare = next((name.removesuffix(end) for end in _SUFFIXES if name.endswith(end)), name)
    executables = builtin_executables(package)
    return next((one for one in (name, bare, f"{bare}_node") if one in executables), "")


@cache
def _by_name() -> dict[tuple[str, str], NodeSpec]:
    return {(name.package, name.executable): spec for spec in _SPECS for name in spec.names}


@cache
def _commands() -> dict[tuple[str, str], str]:
    return {(name.package, name.executable): words for name, words in COMMANDS.items()}
