"""Why there is no plan, in MoveIt's codes and in words."""

from __future__ import annotations

import enum

from gazelle.errors import GazelleError

__all__ = ["ErrorCode", "PlanningError"]


class ErrorCode(enum.IntEnum):
    """The values of ``moveit_msgs/MoveItErrorCodes`` that planning can end with."""

    SUCCESS = 1
    FAILURE = 99999
    PLANNING_FAILED = -1
    INVALID_MOTION_PLAN = -2
    TIMED_OUT = -6
    START_STATE_IN_COLLISION = -10
    START_STATE_VIOLATES_PATH_CONSTRAINTS = -11
    GOAL_IN_COLLISION = -12
    GOAL_VIOLATES_PATH_CONSTRAINTS = -13
    GOAL_CONSTRAINTS_VIOLATED = -14
    INVALID_GROUP_NAME = -15
    INVALID_GOAL_CONSTRAINTS = -16
    INVALID_ROBOT_STATE = -17
    INVALID_LINK_NAME = -18
    FRAME_TRANSFORM_FAILURE = -21
    NO_IK_SOLUTION = -31


class PlanningError(GazelleError):
    """There is no plan.

    Attributes:
        code: what MoveIt answers in this case.
        reason: why, with the names of joints and links.
    """

    def __init__(self, code: ErrorCode, reason: str) -> None:
        self.code = code
        self.reason = reason
        super().__init__(f"{code.name}: {reason}")
