"""SimpleActionClient: one goal at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.compat.actionlib.client import ActionClient, ClientGoalHandle, as_duration
from gazelle.compat.actionlib.goals import CommState, GoalStatus, constant_name
from gazelle.compat.rospy.client import is_shutdown
from gazelle.compat.rospy.log import logerr
from gazelle.compat.rospy.rostime import Duration, get_rostime
from gazelle.interfaces import Time as _Time

__all__ = ["SimpleActionClient", "SimpleGoalState"]

_PERIOD_S = 0.1
_SIMPLE = {GoalStatus.RECALLING: GoalStatus.PENDING, GoalStatus.PREEMPTING: GoalStatus.ACTIVE}


class SimpleGoalState:
    """How a simple client sees its goal."""

    PENDING = 0
    ACTIVE = 1
    DONE = 2

    @classmethod
    def to_string(cls, number: int) -> str:
        """Return the constant's name."""
        return constant_name(cls, number)


class SimpleActionClient:
    """Sends goals of one action and follows the last one.

    Args:
        ns: the action's name.
        ActionSpec: such as ``FibonacciAction``.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        self.action_client = ActionClient(ns, ActionSpec)
        self.simple_state = SimpleGoalState.DONE
        self.gh: ClientGoalHandle | None = None
        self.done_condition = threading.Condition()
        self.done_cb: Callable[[int, Any], Any] | None = None
        self.active_cb: Callable[[], Any] | None = None
        self.feedback_cb: Callable[[Any], Any] | None = None

    def wait_for_server(self, timeout: Any = Duration()) -> bool:  # noqa: B008 - actionlib's
        """Wait until a server is there; a timeout of 0 waits for ever."""
        return self.action_client.wait_for_server(timeout)

    def send_goal(
        self,
        goal: Any,
        done_cb: Callable[[int, Any], Any] | None = None,
        active_cb: Callable[[], Any] | None = None,
        feedback_cb: Callable[[Any], Any] | None = None,
    ) -> None:
        """Send a goal and forget the one before, which goes on at the server.

        Args:
            goal: such as ``FibonacciGoal``.
            done_cb: called at the end with the status and the result.
            active_cb: called when the goal becomes active.
            feedback_cb: called with each feedback message.
        """
        self.stop_tracking_goal()
        self.done_cb = done_cb
        self.active_cb = active_cb
        self.feedback_cb = feedback_cb
        self.simple_state = SimpleGoalState.PENDING
        self.gh = self.action_client.send_goal(goal, self._on_transition, self._on_feedback)

    def send_goal_and_wait(
        self,
        goal: Any,
        execute_timeout: Any = Duration(),  # noqa: B008 - actionlib's signature
        preempt_timeout: Any = Duration(),  # noqa: B008 - actionlib's signature
    ) -> int:
        """Send a goal, wait for its end, and cancel it when that takes too long.

        Args:
            goal: such as ``FibonacciGoal``.
            execute_timeout: how long it may take, 0 for ever.
            preempt_timeout: how long to wait for the end of the cancelled goal, 0 for ever.
        """
        self.send_goal(goal)
        if not self.wait_for_result(execute_timeout):
            self.cancel_goal()
            self.wait_for_result(preempt_timeout)
        return self.get_state()

    def wait_for_result(self, timeout: Any = Duration()) -> bool:  # noqa: B008 - actionlib's
        """Wait until the goal has ended; a timeout of 0 waits for ever."""
        if self.gh is None:
            logerr("Called wait_for_result when no goal exists")
            return False
        limit, start = as_duration(timeout), get_rostime()
        with self.done_condition:
            while self.simple_state != SimpleGoalState.DONE and not is_shutdown():
                left_s = _PERIOD_S
                if limit > Duration():
                    left_s = min(left_s, (limit - (get_rostime() - start)).to_sec())
                if left_s <= 0:
                    break
                self.done_condition.wait(left_s)
        return self.simple_state == SimpleGoalState.DONE

    def get_result(self) -> Any:
        """Return the result message, None before it has come."""
        if self.gh is None:
            logerr("Called get_result when no goal is running")
            return None
        return self.gh.get_result()

    def get_state(self) -> int:
        """Return the goal's status: PENDING, ACTIVE or how it ended; LOST without a goal."""
        if self.gh is None:
            return int(GoalStatus.LOST)
        status = self.gh.get_goal_status()
        return int(_SIMPLE.get(status, status))

    def get_goal_status_text(self) -> str:
        """Return what the server said about the status."""
        if self.gh is None:
            text = "Called get_goal_status_text when no goal is running"
            logerr(text)
            return f"ERROR: {text}"
        return self.gh.get_goal_status_text()

    def cancel_all_goals(self) -> None:
        """Ask to cancel all goals of the server, those of others too."""
        self.action_client.cancel_all_goals()

    def cancel_goals_at_and_before_time(self, time: _Time) -> None:
        """Ask to cancel all goals sent until a time."""
        self.action_client.cancel_goals_at_and_before_time(time)

    def cancel_goal(self) -> None:
        """Ask to cancel the goal."""
        if self.gh is not None:
            self.gh.cancel()

    def stop_tracking_goal(self) -> None:
        """Follow the goal no more; it goes on at the server."""
        if self.gh is not None:
            self.gh.impl.forget()
        self.gh = None

    def _on_transition(self, handle: ClientGoalHandle) -> None:
        state = handle.get_comm_state()
        if state in (CommState.ACTIVE, CommState.PREEMPTING):
            if self.simple_state == SimpleGoalState.PENDING:
                self.simple_state = SimpleGoalState.ACTIVE
                if self.active_cb is not None:
                    self.active_cb()
        elif state == CommState.DONE and self.simple_state != SimpleGoalState.DONE:
            try:
                if self.done_cb is not None:
                    self.done_cb(handle.get_goal_status(), handle.get_result())
            finally:
                with self.done_condition:
                    if self.gh is None or self.gh == handle:
                        self.simple_state = SimpleGoalState.DONE
                    self.done_condition.notify_all()

    def _on_feedback(self, handle: ClientGoalHandle, feedback: Any) -> None:
        if self.feedback_cb is not None:
            self.feedback_cb(feedback)
