"""The state machines of goals at the server: actionlib's and ROS 2's.

Sources: http://wiki.ros.org/actionlib/DetailedDescription and the ROS 2 design article on actions
(https://design.ros2.org/articles/actions.html). The numbers are those on the wire.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping

from gazelle.errors import GraphError

__all__ = [
    "ACTIONLIB",
    "ROS2",
    "ActionlibStatus",
    "GoalEvent",
    "GoalStateError",
    "Ros2Status",
    "Status",
    "next_status",
    "state_error",
]


class ActionlibStatus(enum.IntEnum):
    """States of a goal in actionlib (``actionlib_msgs/GoalStatus``)."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8
    LOST = 9

    @property
    def is_terminal(self) -> bool:
        """True when nothing can happen to the goal any more."""
        return self in _ACTIONLIB_ENDS

    @property
    def is_executing(self) -> bool:
        """True from the goal's acceptance to its end."""
        return self in (ActionlibStatus.ACTIVE, ActionlibStatus.PREEMPTING)

    @property
    def is_canceling(self) -> bool:
        """True while a cancel request waits for the server to end the goal."""
        return self in (ActionlibStatus.PREEMPTING, ActionlibStatus.RECALLING)


class Ros2Status(enum.IntEnum):
    """States of a goal in ROS 2 (``action_msgs/msg/GoalStatus``).

    UNKNOWN is a goal that the server has not decided on. REJECTED is never on the wire: a goal
    that was not taken has no status there.
    """

    REJECTED = -1
    UNKNOWN = 0
    ACCEPTED = 1
    EXECUTING = 2
    CANCELING = 3
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6

    @property
    def is_terminal(self) -> bool:
        """True when nothing can happen to the goal any more."""
        return self in _ROS2_ENDS

    @property
    def is_executing(self) -> bool:
        """True from the goal's acceptance to its end."""
        return Ros2Status.ACCEPTED <= self <= Ros2Status.CANCELING

    @property
    def is_canceling(self) -> bool:
        """True while a cancel request waits for the server to end the goal."""
        return self is Ros2Status.CANCELING


Status = ActionlibStatus | Ros2Status


class GoalEvent(enum.StrEnum):
    """What a server or a client does to a goal; the value is the word of error messages."""

    ACCEPT = "accept"
    EXECUTE = "execute"
    REJECT = "reject"
    REQUEST_CANCEL = "request a cancel"
    CANCEL = "cancel"
    SUCCEED = "succeed"
    ABORT = "abort"


class GoalStateError(GraphError):
    """A goal cannot do that in the state it is in."""


_A, _R, _E = ActionlibStatus, Ros2Status, GoalEvent
_ACTIONLIB_ENDS = frozenset(
    {_A.PREEMPTED, _A.SUCCEEDED, _A.ABORTED, _A.REJECTED, _A.RECALLED, _A.LOST}
)
_ROS2_ENDS = frozenset({_R.REJECTED, _R.SUCCEEDED, _R.CANCELED, _R.ABORTED})

ACTIONLIB: Mapping[tuple[ActionlibStatus, GoalEvent], ActionlibStatus] = {
    (_A.PENDING, _E.ACCEPT): _A.ACTIVE,
    (_A.PENDING, _E.REJECT): _A.REJECTED,
    (_A.PENDING, _E.REQUEST_CANCEL): _A.RECALLING,
    (_A.PENDING, _E.CANCEL): _A.RECALLED,
    (_A.RECALLING, _E.ACCEPT): _A.PREEMPTING,
    (_A.RECALLING, _E.REJECT): _A.REJECTED,
    (_A.RECALLING, _E.CANCEL): _A.RECALLED,
    (_A.ACTIVE, _E.REQUEST_CANCEL): _A.PREEMPTING,
    (_A.ACTIVE, _E.CANCEL): _A.PREEMPTED,
    (_A.ACTIVE, _E.SUCCEED): _A.SUCCEEDED,
    (_A.ACTIVE, _E.ABORT): _A.ABORTED,
    (_A.PREEMPTING, _E.CANCEL): _A.PREEMPTED,
    (_A.PREEMPTING, _E.SUCCEED): _A.SUCCEEDED,
    (_A.PREEMPTING, _E.ABORT): _A.ABORTED,
}
"""actionlib: what is not here cannot happen."""

ROS2: Mapping[tuple[Ros2Status, GoalEvent], Ros2Status] = {
    (_R.UNKNOWN, _E.ACCEPT): _R.ACCEPTED,
    (_R.UNKNOWN, _E.REJECT): _R.REJECTED,
    (_R.ACCEPTED, _E.EXECUTE): _R.EXECUTING,
    (_R.ACCEPTED, _E.REQUEST_CANCEL): _R.CANCELING,
    (_R.EXECUTING, _E.REQUEST_CANCEL): _R.CANCELING,
    (_R.EXECUTING, _E.SUCCEED): _R.SUCCEEDED,
    (_R.EXECUTING, _E.ABORT): _R.ABORTED,
    (_R.CANCELING, _E.SUCCEED): _R.SUCCEEDED,
    (_R.CANCELING, _E.ABORT): _R.ABORTED,
    (_R.CANCELING, _E.CANCEL): _R.CANCELED,
}
"""ROS 2: what is not here cannot happen."""

_ACTIONLIB_WORDS = {
    _E.ACCEPT: ("an active", "a pending or recalling"),
    _E.REJECT: ("a rejected", "a pending or recalling"),
    _E.CANCEL: ("a cancelled", "a pending, recalling, active, or preempting"),
    _E.SUCCEED: ("a succeeded", "an active or preempting"),
    _E.ABORT: ("an aborted", "an active or preempting"),
}


def next_status(status: Status, event: GoalEvent) -> Status | None:
    """Return the state that an event leads to, None when it cannot happen in this state."""
    if isinstance(status, ActionlibStatus):
        return ACTIONLIB.get((status, event))
    return ROS2.get((status, event))


def state_error(goal_id: str, status: Status, event: GoalEvent) -> GoalStateError:
    """Return the error of an event that cannot happen, with ROS's own words."""
    text = f"goal {goal_id} is {status.name}: the server cannot {event} it now"
    if isinstance(status, Ros2Status):
        said = "goal_handle attempted invalid transition from state {} with event {}"
        return GoalStateError(
            f"{text}\n  ROS says: {said.format(status.name, event.name.split('_')[-1])}"
        )
    to, source = _ACTIONLIB_WORDS.get(event, (f"the state after '{event}',", "another"))
    return GoalStateError(
        f"{text}\n  ROS says: To transition to {to} state, the goal must be in {source} state, "
        f"it is currently in state: {int(status)}"
    )
