"""One goal as the client that sent it sees it, with actionlib's states of the talk about it.

Source: http://wiki.ros.org/actionlib/DetailedDescription, "Client State Machine".
"""

from __future__ import annotations

import enum
import threading
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from gazelle.graph.actions.goal import ActionlibStatus, Ros2Status, Status

__all__ = ["TRANSITIONS", "ClientGoal", "CommState", "GoalSender", "steps"]


class CommState(enum.IntEnum):
    """How far the talk with the server about one goal has come."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8


_S, _C = ActionlibStatus, CommState

_ENDS = (_S.REJECTED, _S.RECALLED, _S.PREEMPTED, _S.SUCCEEDED, _S.ABORTED)

_RESULT = (_C.WAITING_FOR_RESULT,)

_STAY: tuple[CommState, ...] = ()

TRANSITIONS: Mapping[CommState, Mapping[ActionlibStatus, tuple[CommState, ...]]] = {
    _C.WAITING_FOR_GOAL_ACK: {
        _S.PENDING: (_C.PENDING,),
        _S.ACTIVE: (_C.ACTIVE,),
        _S.REJECTED: (_C.PENDING, *_RESULT),
        _S.RECALLING: (_C.PENDING, _C.RECALLING),
        _S.RECALLED: (_C.PENDING, *_RESULT),
        _S.PREEMPTED: (_C.ACTIVE, _C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.ACTIVE, *_RESULT),
        _S.ABORTED: (_C.ACTIVE, *_RESULT),
        _S.PREEMPTING: (_C.ACTIVE, _C.PREEMPTING),
    },
    _C.PENDING: {
        _S.PENDING: _STAY,
        _S.ACTIVE: (_C.ACTIVE,),
        _S.REJECTED: _RESULT,
        _S.RECALLING: (_C.RECALLING,),
        _S.RECALLED: (_C.RECALLING, *_RESULT),
        _S.PREEMPTED: (_C.ACTIVE, _C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.ACTIVE, *_RESULT),
        _S.ABORTED: (_C.ACTIVE, *_RESULT),
        _S.PREEMPTING: (_C.ACTIVE, _C.PREEMPTING),
    },
    _C.ACTIVE: {
        _S.ACTIVE: _STAY,
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: _RESULT,
        _S.ABORTED: _RESULT,
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.WAITING_FOR_RESULT: dict.fromkeys((_S.ACTIVE, *_ENDS), _STAY),
    _C.WAITING_FOR_CANCEL_ACK: {
        _S.PENDING: _STAY,
        _S.ACTIVE: _STAY,
        _S.REJECTED: _RESULT,
        _S.RECALLING: (_C.RECALLING,),
        _S.RECALLED: (_C.RECALLING, *_RESULT),
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.PREEMPTING, *_RESULT),
        _S.ABORTED: (_C.PREEMPTING, *_RESULT),
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.RECALLING: {
        _S.REJECTED: _RESULT,
        _S.RECALLING: _STAY,
        _S.RECALLED: _RESULT,
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.PREEMPTING, *_RESULT),
        _S.ABORTED: (_C.PREEMPTING, *_RESULT),
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.PREEMPTING: {
        _S.PREEMPTED: _RESULT,
        _S.SUCCEEDED: _RESULT,
        _S.ABORTED: _RESULT,
        _S.PREEMPTING: _STAY,
    },
    _C.DONE: dict.fromkeys(_ENDS, _STAY),
}

"""States passed one after the other when the server tells a status; what is missing is invalid."""


def steps(state: CommState, status: ActionlibStatus) -> tuple[CommState, ...] | None:
    """Return the states that a told status leads through, None when it makes no sense."""
    return TRANSITIONS.get(state, {}).get(status)


class GoalSender(Protocol):
    """What a client's goal needs of its client."""

    def cancel_goal(self, goal: ClientGoal) -> None:
        """Ask the server to cancel one goal."""
        ...

    def forget(self, goal: ClientGoal) -> None:
        """Follow a goal no more."""
        ...


class ClientGoal:
    """A goal that was sent.

    Callbacks run in the graph's threads.

    Attributes:
        goal_id: unique name; in ROS 2 the hexadecimal UUID.
        request: the goal message.
        status: the last status known, of actionlib or ROS 2. LOST and, in ROS 2, UNKNOWN at the
            end mean that the server is gone.
        text: what the server said about it; why a goal was lost.
        result: the result message, None before the end.
        feedback: the last feedback message.
        comm_state: actionlib's state of the talk with the server.
        is_acknowledged: the server has told of it (actionlib).
        on_feedback: called with each feedback message.
        on_done: called with the goal at its end.
        on_transition: called with the goal at each change of `comm_state` (actionlib), or of
            `status` (ROS 2).
    """

    def __init__(
        self,
        sender: GoalSender,
        goal_id: str,
        request: Any,
        status: Status,
        *,
        on_feedback: Callable[[Any], None] | None,
        on_done: Callable[[ClientGoal], None] | None,
        on_transition: Callable[[ClientGoal], None] | None,
    ) -> None:
        """Begin; made by `ActionClient.send_goal`."""
        self.goal_id = goal_id
        self.request = request
        self.status = status
        self.text = ""
        self.result: Any = None
        self.feedback: Any = None
        self.comm_state = CommState.WAITING_FOR_GOAL_ACK
        self.is_acknowledged = False
        self.on_feedback = on_feedback
        self.on_done = on_done
        self.on_transition = on_transition
        self.lock = threading.RLock()
        self.ended = threading.Event()
        self._over = False
        self._sender = sender

    @property
    def is_done(self) -> bool:
        """True when nothing can happen to it any more."""
        return self._over

    @property
    def is_accepted(self) -> bool:
        """True once the server took it."""
        return self.status not in (
            Ros2Status.UNKNOWN,
            Ros2Status.REJECTED,
            ActionlibStatus.PENDING,
            ActionlibStatus.RECALLING,
            ActionlibStatus.RECALLED,
            ActionlibStatus.REJECTED,
        )

    def cancel(self) -> None:
        """Ask the server to cancel it; what comes of it is seen in `status`."""
        self._sender.cancel_goal(self)

    def forget(self) -> None:
        """Hear nothing of it any more; the server goes on."""
        self.on_feedback = self.on_done = self.on_transition = None
        self._sender.forget(self)

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait in wall time until it is over and `on_done` has run; tell whether that came."""
        return self.ended.wait(timeout_s)

    def take_feedback(self, feedback: Any) -> None:
        """Note feedback from the server."""
        self.feedback = feedback
        if self.on_feedback is not None and not self.is_done:
            self.on_feedback(feedback)

    def finish(self) -> None:
        """Note the end."""
        if self._over:
            return
        self._over = True
        self._sender.forget(self)
        try:
            if self.on_done is not None:
                self.on_done(self)
        finally:
            self.ended.set()
