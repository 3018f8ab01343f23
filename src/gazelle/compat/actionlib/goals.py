"""Goals as actionlib's users see them: their ids and states, and what makes an action's class."""

from __future__ import annotations

import itertools
from typing import Any

from gazelle.compat.rospy.client import get_name
from gazelle.compat.rospy.rostime import get_rostime
from gazelle.graph.actions import CommState as _CommState
from gazelle.interfaces import ros1_message_type

__all__ = [
    "ActionException",
    "CommState",
    "GoalID",
    "GoalIDGenerator",
    "GoalStatus",
    "GoalStatusArray",
    "check_spec",
    "constant_name",
]

GoalID: Any = ros1_message_type("actionlib_msgs/GoalID")
GoalStatus: Any = ros1_message_type("actionlib_msgs/GoalStatus")
GoalStatusArray: Any = ros1_message_type("actionlib_msgs/GoalStatusArray")
_NUMBERS = itertools.count(1)


class ActionException(Exception):  # noqa: N818 - actionlib's name
    """A class that is no action was given."""


class CommState:
    """How far the talk with the server about one goal has come."""

    WAITING_FOR_GOAL_ACK = int(_CommState.WAITING_FOR_GOAL_ACK)
    PENDING = int(_CommState.PENDING)
    ACTIVE = int(_CommState.ACTIVE)
    WAITING_FOR_RESULT = int(_CommState.WAITING_FOR_RESULT)
    WAITING_FOR_CANCEL_ACK = int(_CommState.WAITING_FOR_CANCEL_ACK)
    RECALLING = int(_CommState.RECALLING)
    PREEMPTING = int(_CommState.PREEMPTING)
    DONE = int(_CommState.DONE)
    LOST = int(_CommState.LOST)

    @classmethod
    def to_string(cls, number: int) -> str:
        """Return the constant's name."""
        return constant_name(cls, number)


def constant_name(cls: type, number: int) -> str:
    """Return the name of a class's integer constant; actionlib's own words if there is none."""
    for name, value in vars(cls).items():
        if isinstance(value, int) and value == number:
            return name
    return f"NO_SUCH_STATE_{number}"


def check_spec(action_spec: Any) -> Any:
    """Return the class of an action, such as ``FibonacciAction``, after a look at it.

    Raises:
        ActionException: it is another class.
    """
    fields = getattr(action_spec, "__slots__", ())
    if not {"action_goal", "action_result", "action_feedback"} <= set(fields):
        raise ActionException(f"Type is not an action spec: {action_spec}")
    return action_spec


# actionlib adds this to the message class, and programs print states with it.
GoalStatus.to_string = classmethod(constant_name)


class GoalIDGenerator:
    """Makes ids out of a name, a count and the time.

    Args:
        name: the node's own by default.
    """

    def __init__(self, name: str | None = None) -> None:
        self.name = get_name() if name is None else name

    def set_name(self, name: str) -> None:
        """Set what ids begin with."""
        self.name = name

    def generate_ID(self) -> Any:
        """Return a new id, stamped with the time now."""
        now = get_rostime()
        text = f"{self.name}-{next(_NUMBERS)}-{now.secs}.{now.nsecs}"
        return GoalID(stamp=now, id=text)
