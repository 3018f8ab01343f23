"""What Gazelle's own launch files of nav2_bringup are made of; ROS has no such module."""

from gazelle.launch.ros2.nav2_bringup import (
    RELATIVE_TF,
    Managed,
    arguments,
    configured,
    is_true,
    lifecycle_manager,
    log_absent_nodes,
    navigation_nodes,
    section_names,
    started,
    value_of,
)

__all__ = [
    "RELATIVE_TF",
    "Managed",
    "arguments",
    "configured",
    "is_true",
    "lifecycle_manager",
    "log_absent_nodes",
    "navigation_nodes",
    "section_names",
    "started",
    "value_of",
]
