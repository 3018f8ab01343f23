"""launch_ros: nodes, their parameters, namespaces and states, in launch files of ROS 2."""

from __future__ import annotations

from gazelle.launch.ros2.launch_ros import (
    actions,
    descriptions,
    event_handlers,
    events,
    substitutions,
)

__all__ = ["actions", "descriptions", "event_handlers", "events", "substitutions"]
