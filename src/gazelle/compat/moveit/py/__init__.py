"""moveit_py: MoveIt from ROS 2's Python, planning in the program's own process."""

from __future__ import annotations
