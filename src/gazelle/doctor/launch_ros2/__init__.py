"""What a static reading of ROS 2 launch files shows; nothing in them is executed."""

from __future__ import annotations

from gazelle.doctor.launch_ros2.all_checks import check_launch
from gazelle.doctor.launch_ros2.launch_file import LaunchReading, RobotSource

__all__ = ["LaunchReading", "RobotSource", "check_launch"]
