"""``moveit_msgs/MoveItErrorCodes``, and failures that carry one with the reason."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

from gazelle.errors import GazelleError
from gazelle.interfaces import message_type

__all__ = ["ErrorCode", "MoveGroupError", "code_message"]

_SOURCE = "move_group"


class ErrorCode(IntEnum):
    """MoveIt's numbers, ``moveit_msgs/msg/MoveItErrorCodes.msg``."""

    SUCCESS = 1
    FAILURE = 99999
    PLANNING_FAILED = -1
    INVALID_MOTION_PLAN = -2
    MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE = -3
    CONTROL_FAILED = -4
    TIMED_OUT = -6
    PREEMPTED = -7
    START_STATE_IN_COLLISION = -10
    START_STATE_VIOLATES_PATH_CONSTRAINTS = -11
    GOAL_IN_COLLISION = -12
    GOAL_VIOLATES_PATH_CONSTRAINTS = -13
    GOAL_CONSTRAINTS_VIOLATED = -14
    INVALID_GROUP_NAME = -15
    INVALID_GOAL_CONSTRAINTS = -16
    INVALID_ROBOT_STATE = -17
    INVALID_LINK_NAME = -18
    INVALID_OBJECT_NAME = -19
    FRAME_TRANSFORM_FAILURE = -21
    COLLISION_CHECKING_UNAVAILABLE = -22
    ROBOT_STATE_STALE = -23
    START_STATE_INVALID = -26
    GOAL_STATE_INVALID = -27
    NO_IK_SOLUTION = -31


class MoveGroupError(GazelleError):
    """A request that cannot be fulfilled.

    Attributes:
        code: MoveIt's number for it.
        why: what is in the way, in words.
    """

    def __init__(self, code: ErrorCode, why: str) -> None:
        """Note both."""
        super().__init__(why)
        self.code = code
        self.why = why


def code_message(code: ErrorCode, why: str = "") -> Any:
    """Return the message; ROS 1's form of it has no room for the reason, the log has it."""
    return message_type("moveit_msgs/msg/MoveItErrorCodes")(
        val=int(code), message=why, source=_SOURCE if why else ""
    )
