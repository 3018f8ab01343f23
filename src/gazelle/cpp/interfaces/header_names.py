"""Where a message's C++ class is: the file that declares it and its name in C++."""

from __future__ import annotations

import re

from gazelle.interfaces import RosVersion, split_name

__all__ = ["class_name", "header_path", "snake_name"]

_WORD_STARTS = re.compile(r"(?<=.)(?=[A-Z][a-z])|(?<=[a-z0-9])(?=[A-Z])")
_ROS1_PARTS = re.compile(r"_(Request|Response)$")
_ROS2_PARTS = re.compile(
    r"_(?:SendGoal|GetResult)_(?:Request|Response)$|_(?:Request|Response)$"
    r"|_(?:Goal|Result|Feedback|FeedbackMessage|SendGoal|GetResult)$"
)


def snake_name(name: str) -> str:
    """Return a type's name as rosidl writes it in files' names: ``point_cloud2``."""
    return _WORD_STARTS.sub("_", name).lower()


def header_path(full: str, ros_version: RosVersion) -> str:
    """Return the header of a message, service or action, or of a part of these two.

    Args:
        full: full name: ``sensor_msgs/msg/LaserScan``, ``std_srvs/srv/SetBool_Request`` …
        ros_version: ``sensor_msgs/LaserScan.h`` or ``sensor_msgs/msg/laser_scan.hpp``.
    """
    package, part, name = split_name(full)
    if ros_version is RosVersion.ROS1:
        bare = _ROS1_PARTS.sub(r"\1", name) if part == "srv" else name
        return f"{package}/{bare}.h"
    if part != "msg":
        name = _ROS2_PARTS.sub("", name)
    return f"{package}/{part}/{snake_name(name)}.hpp"


def class_name(full: str, ros_version: RosVersion, allocator: str = "") -> str:
    """Return the C++ name of a message's class.

    Args:
        full: full name.
        ros_version: ``::std_msgs::String`` or ``::std_msgs::msg::String``.
        allocator: of ROS 1's template; the usual class when empty.
    """
    package, part, name = split_name(full)
    if ros_version is RosVersion.ROS2:
        return f"::{package}::{part}::{name}"
    bare = _ROS1_PARTS.sub(r"\1", name) if part == "srv" else name
    return f"::{package}::{bare}_<{allocator}>" if allocator else f"::{package}::{bare}"
