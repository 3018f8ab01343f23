"""Why there is no plan, in MoveIt's codes and in words."""

from __future__ import annotations

import enum

from gazelle.errors import GazelleError

__all__ = ["CodedError", "ErrorCode", "PlanningError"]


class ErrorCode(enum.IntEnum):
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


class CodedError(GazelleError):
    """Something that cannot be done, with the number that MoveIt has for it.

    Attributes:
        code: what MoveIt answers in this case.
        reason: why, with the names of joints and links.
    """

    def __init__(self, code: ErrorCode, reason: str) -> None:
        """Note both."""
        super().__init__(reason)
        self.code = code
        self.reason = reason


class PlanningError(CodedError):
    """There is no plan."""

    def __str__(self) -> str:
        """Return the code's name and the reason."""
        return f"{self.code.name}: {self.reason}"
