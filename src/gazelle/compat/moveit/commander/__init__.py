"""moveit_commander: MoveIt from ROS 1's Python, over the actions and services of move_group."""

from __future__ import annotations

from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.move_group import MoveGroupCommander
from gazelle.compat.moveit.commander.robot import RobotCommander
from gazelle.compat.moveit.commander.roscpp_initializer import roscpp_initialize, roscpp_shutdown
from gazelle.compat.moveit.commander.scene import PlanningSceneInterface

__all__ = [
    "MoveGroupCommander",
    "MoveItCommanderException",
    "PlanningSceneInterface",
    "RobotCommander",
    "roscpp_initialize",
    "roscpp_shutdown",
]
