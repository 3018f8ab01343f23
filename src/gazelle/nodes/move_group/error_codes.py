"""``moveit_msgs/MoveItErrorCodes``, and failures of move_group that carry one."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type
from gazelle.motion.planning.error_codes import CodedError, ErrorCode

__all__ = ["MoveGroupError", "code_message"]

_SOURCE = "move_group"


class MoveGroupError(CodedError):
    """A request that cannot be fulfilled."""


def code_message(code: ErrorCode, why: str = "") -> Any:
    """Return the message; ROS 1's form of it has no room for the reason, the log has it."""
    return message_type("moveit_msgs/msg/MoveItErrorCodes")(
        val=int(code), message=why, source=_SOURCE if why else ""
    )
