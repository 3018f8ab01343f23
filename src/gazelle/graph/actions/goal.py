"""One goal at the server, and the handle of who submitted it in the same process.

Sources: http://wiki.ros.org/actionlib/DetailedDescription and the ROS 2 design article on actions
(https://design.ros2.org/articles/actions.html). The numbers are those on the wire.
"""

from __future__ import annotations

import enum
import threading
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from gazelle.errors import GraphError
from gazelle.graph.actions.types import ActionTypes, as_message
from gazelle.graph.errors import TimeJumpError

if TYPE_CHECKING:
    from gazelle.graph.clock import Clock

__all__ = [
    "ACTIONLIB",
    "ROS2",
    "ActionlibStatus",
    "GoalEvent",
    "GoalOwner",
    "GoalStateError",
    "LocalGoal",
    "Ros2Status",
    "ServerGoal",
    "Status",
    "StatusTimer",
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


class StatusTimer:
    """Calls back once a period, from a thread of its own or when `tick` finds it due."""

    def __init__(
        self, period_ns: int, now_ns: Callable[[], int], callback: Callable[[], None]
    ) -> None:
        """Begin at the clock's time; a period of 0 never comes."""
        self._period_ns = period_ns
        self._now_ns = now_ns
        self._callback = callback
        self._last_ns = now_ns()
        self._closed = False

    def start(self, clock: Clock, name: str) -> None:
        """Keep the period in a thread, on a node's clock."""
        if self._period_ns:
            threading.Thread(
                target=self._loop, args=(clock,), name=f"status {name}", daemon=True
            ).start()

    def tick(self) -> None:
        """Call back when the period is over, or time went back."""
        if self._period_ns and not 0 <= self._now_ns() - self._last_ns < self._period_ns:
            self._last_ns = self._now_ns()
            self._callback()

    def close(self) -> None:
        """Call back no more."""
        self._closed = True
        self._period_ns = 0

    def _loop(self, clock: Clock) -> None:
        while not self._closed:
            try:
                if not clock.sleep(self._period_ns):
                    return
            except TimeJumpError:
                continue
            if not self._closed:
                self._callback()


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
    """One goal of an action server; satisfies `gazelle.control.controller_node_interface.GoalPort`.

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
        is_ros1 = owner.types.ros_version == 1
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
        self._apply(GoalEvent.ACCEPT, text, tell=self._owner.types.ros_version == 1)
        if self._owner.types.ros_version == 2:
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
