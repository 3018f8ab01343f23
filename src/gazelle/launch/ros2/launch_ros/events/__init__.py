"""launch_ros.events."""

from __future__ import annotations

from gazelle.launch.ros2.launch_ros.events import lifecycle
from gazelle.launch.ros2.launch_ros.events.matchers import matches_node_name

__all__ = ["lifecycle", "matches_node_name"]
