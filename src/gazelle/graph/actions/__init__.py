"""Actions: goals that take time, with feedback, results and cancelling; ROS 1's and ROS 2's."""

from __future__ import annotations

from gazelle.graph.actions.action_info import ActionInfo, actions_of
from gazelle.graph.actions.client import ActionClient
from gazelle.graph.actions.client_goal import ClientGoal, CommState
from gazelle.graph.actions.goal import (
    ActionlibStatus,
    GoalEvent,
    GoalStateError,
    LocalGoal,
    Ros2Status,
    ServerGoal,
    Status,
)
from gazelle.graph.actions.server import ActionServer, ActionTiming
from gazelle.graph.actions.types import ActionTypes, action_name, action_types, as_message

__all__ = [
    "ActionClient",
    "ActionInfo",
    "ActionServer",
    "ActionTiming",
    "ActionTypes",
    "ActionlibStatus",
    "ClientGoal",
    "CommState",
    "GoalEvent",
    "GoalStateError",
    "LocalGoal",
    "Ros2Status",
    "ServerGoal",
    "Status",
    "action_name",
    "action_types",
    "actions_of",
    "as_message",
]
