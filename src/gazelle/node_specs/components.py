"""Which built-in node does the work of a component, which is a library of C++."""

from __future__ import annotations

import re

from gazelle.node_specs.registry import builtin_executables

__all__ = ["executable_of_component"]

_WORD = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")
_SUFFIXES = ("_node", "_component", "_nodelet")
# Components whose names say something else than the node that does their work.
_OTHERS = {
    "ros_gz_bridge::RosGzBridge": "bridge_node",
    "ros_gz_sim::GzServer": "gzserver",
    "tf2_ros::StaticTransformBroadcasterNode": "static_transform_publisher",
}


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
