"""What `actionlib` is in Gazelle: clients and servers of ROS 1 actions for rospy programs.

The module that users import, ``actionlib``, lies in ``compat/modules`` and re-exports this one.
Behaviour as in https://github.com/ros/actionlib (noetic).
"""

from __future__ import annotations

from gazelle.compat.actionlib.client import ActionClient, ClientGoalHandle, TerminalState
from gazelle.compat.actionlib.goals import (
    ActionException,
    CommState,
    GoalID,
    GoalIDGenerator,
    GoalStatus,
    GoalStatusArray,
)
from gazelle.compat.actionlib.server import ActionServer, ServerGoalHandle
from gazelle.compat.actionlib.simple_client import SimpleActionClient, SimpleGoalState
from gazelle.compat.actionlib.simple_server import SimpleActionServer

__all__ = [
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "GoalID",
    "GoalIDGenerator",
    "GoalStatus",
    "GoalStatusArray",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "TerminalState",
]
