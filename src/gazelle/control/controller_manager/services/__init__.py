"""The manager's services, of ros_control and of ros2_control."""

from __future__ import annotations

from gazelle.control.controller_manager.services.ros1 import offer_ros1
from gazelle.control.controller_manager.services.ros2 import offer_ros2

__all__ = ["offer_ros1", "offer_ros2"]
