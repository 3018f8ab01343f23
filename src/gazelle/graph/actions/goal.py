"""One goal at the server, and the handle of who submitted it in the same process."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Protocol

from gazelle.graph.actions.states import (
    ActionlibStatus,
    GoalEvent,
    Ros2Status,
    Status,
    next_status,
    state_error,
)
from gazelle.graph.actions.types import ActionTypes, as_message

__all__ = ["GoalOwner", "LocalGoal", "ServerGoal"]


class GoalOwner(Protocol):
    """What a goal needs of its server."""

    types: ActionTypes
    lock: threading.RLock

    def goal_changed(self, goal: ServerGoal) -> None:
        """Tell others the goal's new status."""
        ...

    def goal_ended(self, goal: ServerGoal) -> None:
        """Tell others the goal's result and status."""
        ...

    def goal_feedback(self, goal: ServerGoal, feedback: Any) -> None:
        """Tell others how the goal goes."""
        ...

    def wants_feedback(self) -> bool:
        """Tell whether anybody elsewhere listens to feedback."""
        ...

    def request_cancel(self, goal: ServerGoal) -> None:
        """Ask the owner of the server to cancel a goal."""
        ...


class ServerGoal:
    """One goal of an action server; satisfies `gazelle.control.ports.GoalPort`.

    A goal is new until `accept` or `reject`; it ends with one of `succeed`, `abort`, `cancel`.
    A result may be a message of the action's result class, another message or a mapping with
    fields of the same names, or None for the defaults.

    Attributes:
        goal_id: unique name; in ROS 2 the hexadecimal UUID.
        stamp_ns: when it was sent (actionlib) or accepted (ROS 2), in the node's clock.
        request: the goal message.
        status: its state.
        text: what the server said at the last change (actionlib sends it to the client).
        result: the result message, None before the end.
        ended_ns: when it ended, None before.
    """

    def __init__(self, owner: GoalOwner, goal_id: str, stamp_ns: int, request: Any) -> None:
        """Begin new; made by the server."""
        self.goal_id = goal_id
        self.stamp_ns = stamp_ns
        self.request = request
        is_ros1 = owner.types.generation == 1
        self.status: Status = ActionlibStatus.PENDING if is_ros1 else Ros2Status.UNKNOWN
        self.text = ""
        self.result: Any = None
        self.ended_ns: int | None = None
        self.feedback: Any = None
        self.decided = threading.Event()
        self.ended = threading.Event()
        self.cancel_asked = False
        self.on_feedback: Callable[[Any], None] | None = None
        self.on_done: Callable[[ServerGoal], None] | None = None
        self._is_local = False
        self._owner = owner

    @property
    def is_active(self) -> bool:
        """True from `accept` to the end."""
        return self.status.is_executing

    @property
    def is_cancel_requested(self) -> bool:
        """True once a client asked to cancel and the server agreed."""
        return self.status.is_canceling

    @property
    def is_cancelable(self) -> bool:
        """True while a request to cancel can change anything."""
        return next_status(self.status, GoalEvent.REQUEST_CANCEL) is not None

    @property
    def is_feedback_wanted(self) -> bool:
        """True when somebody would get feedback; without, none need be built."""
        return self._is_local or self._owner.wants_feedback()

    def accept(self, text: str = "") -> None:
        """Take the goal; it is being executed from now on.

        Raises:
            GoalStateError: it was decided on before.
        """
        self._apply(GoalEvent.ACCEPT, text, tell=self._owner.types.generation == 1)
        if self._owner.types.generation == 2:
            self._apply(GoalEvent.EXECUTE, text)

    def accept_deferred(self) -> None:
        """Take the goal and begin it later with `execute` (ROS 2 only).

        Raises:
            GoalStateError: it was decided on before.
        """
        self._apply(GoalEvent.ACCEPT, "")

    def execute(self) -> None:
        """Begin a goal that was accepted with `accept_deferred`.

        Raises:
            GoalStateError: it is not waiting to begin.
        """
        self._apply(GoalEvent.EXECUTE, "")

    def reject(self, result: Any = None, text: str = "") -> None:
        """Do not take the goal.

        Raises:
            GoalStateError: it was accepted before.
        """
        self._end(GoalEvent.REJECT, result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how it goes; feedback after the end is dropped, as in ROS 2."""
        if self.status.is_terminal:
            return
        if self._is_local:
            self.feedback = as_message(feedback, self._owner.types.Feedback)
            if self.on_feedback is not None:
                self.on_feedback(self.feedback)
        self._owner.goal_feedback(self, feedback)

    def succeed(self, result: Any = None, text: str = "") -> None:
        """End it well.

        Raises:
            GoalStateError: it is not active.
        """
        self._end(GoalEvent.SUCCEED, result, text)

    def abort(self, result: Any = None, text: str = "") -> None:
        """End it because it cannot be reached or was replaced.

        Raises:
            GoalStateError: it is not active.
        """
        self._end(GoalEvent.ABORT, result, text)

    def cancel(self, result: Any = None, text: str = "") -> None:
        """End it because a client wanted so; actionlib also ends replaced goals with it.

        Raises:
            GoalStateError: it is over; in ROS 2 also when no client asked.
        """
        with self._owner.lock:
            if self.cancel_asked and self.status is Ros2Status.EXECUTING:
                self.status = Ros2Status.CANCELING
            self._end(GoalEvent.CANCEL, result, text)

    def begin_canceling(self) -> bool:
        """Note that a client asked to cancel; False when that changes nothing."""
        with self._owner.lock:
            if not self.is_cancelable:
                return False
            self._apply(GoalEvent.REQUEST_CANCEL, self.text)
            return True

    def attach(self) -> LocalGoal:
        """Return a handle for the process itself; feedback is kept from now on."""
        self._is_local = True
        return LocalGoal(self, self._owner)

    def _end(self, event: GoalEvent, result: Any, text: str) -> None:
        with self._owner.lock:
            self._check(event)
            self.result = as_message(result, self._owner.types.Result)
            self._apply(event, text, tell=False)
            self.ended.set()
            self._owner.goal_ended(self)
        if self.on_done is not None:
            self.on_done(self)

    def _apply(self, event: GoalEvent, text: str, *, tell: bool = True) -> None:
        with self._owner.lock:
            self.status = self._check(event)
            self.text = text
            if event is not GoalEvent.REQUEST_CANCEL:
                self.decided.set()
            if tell:
                self._owner.goal_changed(self)

    def _check(self, event: GoalEvent) -> Status:
        status = next_status(self.status, event)
        if status is None:
            raise state_error(self.goal_id, self.status, event)
        return status


class LocalGoal:
    """A goal that this process submitted itself, as the one who sent it sees it."""

    def __init__(self, goal: ServerGoal, owner: GoalOwner) -> None:
        """Watch a goal; made by `ActionServer.submit`."""
        self._goal = goal
        self._owner = owner

    @property
    def goal_id(self) -> str:
        """Unique name of the goal."""
        return self._goal.goal_id

    @property
    def status(self) -> Status:
        """Its state, with actionlib's or ROS 2's words."""
        return self._goal.status

    @property
    def text(self) -> str:
        """What the server said at the last change."""
        return self._goal.text

    @property
    def is_done(self) -> bool:
        """True when nothing can happen to it any more."""
        return self._goal.status.is_terminal

    @property
    def result(self) -> Any:
        """The result message, None before the end."""
        return self._goal.result

    @property
    def feedback(self) -> Any:
        """The last feedback message, None before the first."""
        return self._goal.feedback

    def cancel(self) -> None:
        """Ask the server to cancel it; a goal that is over stays as it is."""
        self._owner.request_cancel(self._goal)

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait for the end in wall time, from another thread than the server's; tell if it came."""
        return self._goal.ended.wait(timeout_s)
