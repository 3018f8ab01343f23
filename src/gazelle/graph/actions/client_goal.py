"""One goal as the client that sent it sees it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Protocol

from gazelle.graph.actions.comm_state import CommState
from gazelle.graph.actions.goal import ActionlibStatus, Ros2Status, Status

__all__ = ["ClientGoal", "GoalSender"]


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
