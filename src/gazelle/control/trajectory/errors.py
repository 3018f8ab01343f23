"""Why a trajectory is not taken, in the codes of control_msgs/FollowJointTrajectory."""

from __future__ import annotations

from enum import IntEnum

__all__ = ["ErrorCode", "TrajectoryError"]


class ErrorCode(IntEnum):
    """Values of ``error_code`` in a result of FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


class TrajectoryError(ValueError):
    """A trajectory cannot be executed; the message says why.

    Attributes:
        code: what the action's result has to say.
    """

    def __init__(self, code: ErrorCode, text: str) -> None:
        super().__init__(text)
        self.code = code
