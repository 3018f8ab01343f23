"""ActionClient and ClientGoalHandle (actionlib.action_client)."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from typing import Any

from gazelle.compat.actionlib.goals import CommState, GoalStatus, check_spec, constant_name
from gazelle.compat.rospy.client import is_shutdown
from gazelle.compat.rospy.log import logerr, logwarn
from gazelle.compat.rospy.rostime import Duration, get_rostime
from gazelle.compat.rospy.state import STATE
from gazelle.errors import GazelleError, InterfaceError
from gazelle.graph.actions import ActionClient as _Client
from gazelle.graph.actions import ClientGoal, action_types
from gazelle.interfaces import Time as _Time

__all__ = ["ActionClient", "ClientGoalHandle", "TerminalState", "as_duration"]

_SLICE_S = 0.0625
_PATIENCE_S = 2.0


class TerminalState:
    """How a goal may have ended."""

    RECALLED = GoalStatus.RECALLED
    REJECTED = GoalStatus.REJECTED
    PREEMPTED = GoalStatus.PREEMPTED
    ABORTED = GoalStatus.ABORTED
    SUCCEEDED = GoalStatus.SUCCEEDED
    LOST = GoalStatus.LOST

    @classmethod
    def to_string(cls, number: int) -> str:
        """Return the constant's name."""
        return constant_name(cls, number)


_ENDS = frozenset(value for name, value in vars(TerminalState).items() if name.isupper())


def as_duration(timeout: Any) -> Any:
    """Return a timeout, a Duration or a number of seconds, as a Duration."""
    return timeout if hasattr(timeout, "to_sec") else Duration.from_sec(float(timeout))


class ClientGoalHandle:
    """A goal that was sent."""

    def __init__(self, goal: ClientGoal) -> None:
        self.impl = goal

    def cancel(self) -> None:
        """Ask the server to cancel this goal."""
        self.impl.cancel()

    def get_comm_state(self) -> int:
        """Return how far the talk with the server has come (`CommState`)."""
        return int(self.impl.comm_state)

    def get_goal_status(self) -> int:
        """Return the last known status (``GoalStatus``)."""
        return int(self.impl.status)

    def get_goal_status_text(self) -> str:
        """Return what the server said about the status."""
        return self.impl.text

    def get_result(self) -> Any:
        """Return the result message, None before it has come."""
        return self.impl.result

    def get_terminal_state(self) -> int:
        """Return how the goal ended (`TerminalState`)."""
        state = self.get_comm_state()
        if state != CommState.DONE:
            logwarn(f"Asking for the terminal state when we're in [{CommState.to_string(state)}]")
        status = self.get_goal_status()
        if status in _ENDS:
            return status
        logerr(f"Asking for a terminal state, but the goal status is {status}")
        return int(GoalStatus.LOST)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and other.impl.goal_id == self.impl.goal_id

    def __hash__(self) -> int:
        return hash(self.impl.goal_id)


class ActionClient:
    """Sends goals of one action; several may be under way.

    Args:
        ns: the action's name.
        ActionSpec: such as ``FibonacciAction``.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        types = action_types(check_spec(ActionSpec), 1)
        self.ns = ns
        self.ActionSpec = ActionSpec
        self.ActionGoal = types.Envelope["goal"]
        self.ActionResult = types.Envelope["result"]
        self.ActionFeedback = types.Envelope["feedback"]
        self._goal_class = types.Goal
        node = STATE.require(f"ActionClient('{ns}')")
        self._client = _Client(node, ns, ActionSpec, ros_version=1)

    def stop(self) -> None:
        """Leave the action."""
        self._client.close()

    def send_goal(
        self,
        goal: Any,
        transition_cb: Callable[[ClientGoalHandle], Any] | None = None,
        feedback_cb: Callable[[ClientGoalHandle, Any], Any] | None = None,
    ) -> ClientGoalHandle:
        """Send a goal, whether or not a server hears it.

        Args:
            goal: such as ``FibonacciGoal``.
            transition_cb: called with the handle at each change of the `CommState`.
            feedback_cb: called with the handle and each feedback message.

        Raises:
            InterfaceError: the goal is a message of another type.
        """
        if not isinstance(goal, self._goal_class):
            wanted, given = self._goal_class._type, type(goal)
            name = getattr(goal, "_type", f"{given.__module__}.{given.__qualname__}")
            raise InterfaceError(f"action {self.ns} takes a {wanted}, this goal is a {name}")

        sent: list[ClientGoalHandle] = []
        is_sent = threading.Event()

        def on_feedback(feedback: Any) -> None:
            is_sent.wait()
            if feedback_cb is not None:
                feedback_cb(sent[0], feedback)

        def on_transition(changed: ClientGoal) -> None:
            if transition_cb is not None:
                transition_cb(ClientGoalHandle(changed))

        made = self._client.send_goal(
            goal, on_feedback=on_feedback, on_transition=on_transition, check=False
        )
        sent.append(ClientGoalHandle(made))
        is_sent.set()
        return sent[0]

    def cancel_all_goals(self) -> None:
        """Ask to cancel all goals of the server, those of others too."""
        self._client.cancel_all()

    def cancel_goals_at_and_before_time(self, time: _Time) -> None:
        """Ask to cancel all goals sent until a time."""
        self._client.cancel_before(time.to_nsec())

    def wait_for_server(self, timeout: Any = Duration()) -> bool:  # noqa: B008 - actionlib's
        """Wait until a server is there; a timeout of 0 waits for ever.

        Args:
            timeout: Duration, or seconds, of the node's clock.
        """
        limit = as_duration(timeout)
        start = get_rostime()
        slices = itertools.count(1)
        while not is_shutdown():
            if self._client.wait_for_server(_SLICE_S):
                return True
            if next(slices) * _SLICE_S == _PATIENCE_S:
                self._log_missing_connections()
            if limit > Duration() and get_rostime() - start >= limit:
                return False
        return False

    wait_for_action_server_to_start = wait_for_server

    def _log_missing_connections(self) -> None:
        try:
            self._client.require_server()
        except GazelleError as error:
            logwarn(str(error))
