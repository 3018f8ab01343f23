"""Real ROS 2 through its own ``rclpy``, in a process of ROS's Python."""

from __future__ import annotations

from gazelle.bridge.ros2.bridge import Bridge
from gazelle.bridge.ros2.interpreters import Interpreter, candidates, is_open
from gazelle.bridge.ros2.rclpy_process import About

__all__ = ["About", "Bridge", "Interpreter", "candidates", "is_open"]
