"""SimpleActionServer: one goal at a time, new ones replace old ones."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from typing import Any

from gazelle.compat.actionlib.goals import GoalStatus
from gazelle.compat.actionlib.server import ActionServer, ServerGoalHandle
from gazelle.compat.rospy.client import is_shutdown
from gazelle.compat.rospy.log import logerr, logwarn

__all__ = ["SimpleActionServer"]

_REPLACED = "This goal was canceled because another goal was received by the simple action server"
_NO_END = (
    "Your executeCallback did not set the goal to a terminal status.  This is a bug in your "
    "ActionServer implementation. Fix your code!  For now, the ActionServer will set this goal "
    "to aborted"
)
_PERIOD_S = 0.1


class SimpleActionServer:
    """An action server with at most one active goal.

    Args:
        name: the action's name.
        ActionSpec: such as ``FibonacciAction``.
        execute_cb: called with each goal message in a thread of its own, and may take its time;
            without it the program takes goals with `accept_new_goal`.
        auto_start: offer it at once; better False and `start`.
    """

    def __init__(
        self,
        name: str,
        ActionSpec: Any,
        execute_cb: Callable[[Any], Any] | None = None,
        auto_start: bool = True,
    ) -> None:
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.execute_callback = execute_cb
        self.goal_callback: Callable[[], Any] | None = None
        self.preempt_callback: Callable[[], Any] | None = None
        self.need_to_terminate = False
        self.lock = threading.RLock()
        self.execute_condition = threading.Condition(self.lock)
        self.current_goal = ServerGoalHandle()
        self.next_goal = ServerGoalHandle()
        self.execute_thread: threading.Thread | None = None
        if execute_cb is not None:
            self.execute_thread = threading.Thread(target=self._execute_loop, name=f"{name} goals")
            self.execute_thread.start()
        self.action_server = ActionServer(
            name, ActionSpec, self._on_goal, self._on_preempt, auto_start
        )

    def start(self) -> None:
        """Offer the action."""
        self.action_server.start()

    def accept_new_goal(self) -> Any:
        """Take the waiting goal, ending the active one; return its message.

        Without a waiting goal that is logged as an error and gives None.
        """
        with self.lock:
            if not self.new_goal or self.next_goal.get_goal() is None:
                logerr("Attempting to accept the next goal when a new goal is not available")
                return None
            if self.is_active() and self.current_goal != self.next_goal:
                self.current_goal.set_canceled(None, _REPLACED)
            self.current_goal = self.next_goal
            self.new_goal = False
            self.preempt_request = self.new_goal_preempt_request
            self.new_goal_preempt_request = False
            self.current_goal.set_accepted(
                "This goal has been accepted by the simple action server"
            )
            return self.current_goal.get_goal()

    def is_new_goal_available(self) -> bool:
        """Tell whether a goal waits to be taken."""
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """Tell whether the active goal should end: a client cancels it, or another goal waits."""
        return self.preempt_request

    def is_active(self) -> bool:
        """Tell whether a goal is active."""
        if self.current_goal.get_goal() is None:
            return False
        status = self.current_goal.get_goal_status().status
        return status in (GoalStatus.ACTIVE, GoalStatus.PREEMPTING)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """End the active goal as SUCCEEDED."""
        with self.lock:
            self.current_goal.set_succeeded(result, text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """End the active goal as ABORTED."""
        with self.lock:
            self.current_goal.set_aborted(result, text)

    def set_preempted(self, result: Any = None, text: str = "") -> None:
        """End the active goal as PREEMPTED."""
        with self.lock:
            self.current_goal.set_canceled(result, text)

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how the active goal goes."""
        self.current_goal.publish_feedback(feedback)

    def get_default_result(self) -> Any:
        """Return an empty result message."""
        return self.action_server.ActionResultType()

    def register_goal_callback(self, cb: Callable[[], Any]) -> None:
        """Set what is called when a goal waits; not together with `execute_cb`."""
        if self.execute_callback is not None:
            logwarn(
                "Cannot call SimpleActionServer.register_goal_callback() because an "
                "executeCallback exists. Not going to register it."
            )
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], Any]) -> None:
        """Set what is called when the active goal should end."""
        self.preempt_callback = cb

    def _on_goal(self, goal: ServerGoalHandle) -> None:
        with self.execute_condition:
            if not self._is_newest(goal):
                goal.set_canceled(None, _REPLACED)
                return
            waiting = self.next_goal.get_goal() is not None
            if waiting and self.next_goal != self.current_goal:
                self.next_goal.set_canceled(None, _REPLACED)
            self.next_goal = goal
            self.new_goal = True
            self.new_goal_preempt_request = False
            if self.is_active():
                self.preempt_request = True
                if self.preempt_callback is not None:
                    self.preempt_callback()
            if self.goal_callback is not None:
                self.goal_callback()
            self.execute_condition.notify()

    def _is_newest(self, goal: ServerGoalHandle) -> bool:
        stamp = goal.get_goal_id().stamp
        others = (self.current_goal, self.next_goal)
        return all(one.get_goal() is None or stamp >= one.get_goal_id().stamp for one in others)

    def _on_preempt(self, goal: ServerGoalHandle) -> None:
        with self.lock:
            if goal == self.current_goal:
                self.preempt_request = True
                if self.preempt_callback is not None:
                    self.preempt_callback()
            elif goal == self.next_goal:
                self.new_goal_preempt_request = True

    def _execute_loop(self) -> None:
        while not is_shutdown() and not self.need_to_terminate:
            if self.is_new_goal_available():
                self._execute(self.accept_new_goal())
            with self.execute_condition:
                if not self.new_goal:
                    self.execute_condition.wait(_PERIOD_S)

    def _execute(self, goal: Any) -> None:
        assert self.execute_callback is not None
        try:
            self.execute_callback(goal)
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            logerr(f"Exception in your execute callback: {error}\n{traceback.format_exc()}")
            self.set_aborted(None, f"Exception in execute callback: {error}")
            return
        if self.is_active():
            logwarn(_NO_END)
            self.set_aborted(None, "No terminal state was set.")
