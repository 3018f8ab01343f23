"""Checks of ROS 1 launch files: everything that would be started, before it is."""

from __future__ import annotations

from gazelle.doctor.launch_ros1.all_checks import examine_launch

__all__ = ["examine_launch"]
