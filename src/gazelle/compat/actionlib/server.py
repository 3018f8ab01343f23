"""ActionServer and ServerGoalHandle (actionlib.action_server)."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.compat.actionlib.goals import GoalID, GoalStatus, check_spec
from gazelle.compat.rospy.log import logerr, logwarn
from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.graph.actions import ActionServer as _Server
from gazelle.graph.actions import ActionTiming, GoalStateError, ServerGoal, action_types

__all__ = ["ActionServer", "ServerGoalHandle", "nop_cb"]

_UNINITIALISED = "Attempt to set status on an uninitialized ServerGoalHandle"


def nop_cb(goal_handle: Any) -> None:
    """Do nothing, where a callback is wanted."""


class ServerGoalHandle:
    """One goal at the server; without a goal it stands for none."""

    def __init__(
        self, goal: ServerGoal | None = None, action_server: ActionServer | None = None
    ) -> None:
        self.impl = goal
        self.action_server = action_server
        self.goal = None if goal is None else goal.request

    def get_default_result(self) -> Any:
        """Return an empty result message."""
        assert self.action_server is not None
        return self.action_server.ActionResultType()

    def set_accepted(self, text: str = "") -> None:
        """Take the goal: it is ACTIVE, or PREEMPTING when a cancel request came before."""
        self._apply(lambda goal: goal.accept(text or ""))

    def set_canceled(self, result: Any = None, text: str = "") -> None:
        """End the goal as RECALLED or PREEMPTED."""
        self._apply(lambda goal: goal.cancel(result, text or ""))

    def set_rejected(self, result: Any = None, text: str = "") -> None:
        """Do not take the goal."""
        self._apply(lambda goal: goal.reject(result, text or ""))

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """End the goal as ABORTED."""
        self._apply(lambda goal: goal.abort(result, text or ""))

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """End the goal as SUCCEEDED."""
        self._apply(lambda goal: goal.succeed(result, text or ""))

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how the goal goes."""
        self._apply(lambda goal: goal.publish_feedback(feedback))

    def set_cancel_requested(self) -> bool:
        """Note that somebody wants the goal cancelled; False when that changes nothing."""
        return self.impl is not None and self.impl.begin_canceling()

    def get_goal(self) -> Any:
        """Return the goal message, None without a goal."""
        return None if self.impl is None else self.impl.request

    def get_goal_id(self) -> Any:
        """Return the goal's id and stamp."""
        if self.impl is None:
            logerr("Attempt to get a goal id on an uninitialized ServerGoalHandle")
            return GoalID()
        return GoalID(stamp=Time(nsecs=self.impl.stamp_ns), id=self.impl.goal_id)

    def get_goal_status(self) -> Any:
        """Return the goal's status message."""
        if self.impl is None:
            logerr("Attempt to get goal status on an uninitialized ServerGoalHandle")
            return GoalStatus()
        status = GoalStatus(status=int(self.impl.status), text=self.impl.text)
        status.goal_id = self.get_goal_id()
        return status

    def _apply(self, step: Callable[[ServerGoal], None]) -> None:
        """Take a step; actionlib logs one that cannot be and goes on."""
        if self.impl is None:
            logerr(_UNINITIALISED)
            return
        try:
            step(self.impl)
        except GoalStateError as error:
            logerr(str(error).partition("ROS says: ")[2] or str(error))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ServerGoalHandle) or self.impl is None or other.impl is None:
            return False
        return self.impl.goal_id == other.impl.goal_id

    def __hash__(self) -> int:
        return hash(self.impl.goal_id if self.impl is not None else None)


class ActionServer:
    """Takes goals of one action and hands them to callbacks.

    Args:
        ns: the action's name.
        ActionSpec: such as ``FibonacciAction``.
        goal_cb: called with each new goal's handle.
        cancel_cb: called with the handle of a goal that somebody wants cancelled.
        auto_start: offer it at once; better False and `start`.
    """

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,
        goal_cb: Callable[[Any], Any],
        cancel_cb: Callable[[Any], Any] = nop_cb,
        auto_start: bool = True,
    ) -> None:
        types = action_types(check_spec(ActionSpec), 1)
        self.ns = ns
        self.ActionSpec = ActionSpec
        self.ActionGoal = types.Envelope["goal"]
        self.ActionResult = types.Envelope["result"]
        self.ActionResultType = types.Result
        self.ActionFeedback = types.Envelope["feedback"]
        self.lock = threading.RLock()
        self.goal_callback = goal_cb
        self.cancel_callback = cancel_cb
        self.auto_start = auto_start
        self.started = False
        self._server: _Server | None = None
        if auto_start:
            logwarn(
                "You've passed in true for auto_start to the python action server, you should "
                "always pass in false to avoid race conditions."
            )
            self.start()

    def register_goal_callback(self, cb: Callable[[Any], Any]) -> None:
        """Set what is called with each new goal's handle."""
        self.goal_callback = cb

    def register_cancel_callback(self, cancel_cb: Callable[[Any], Any]) -> None:
        """Set what is called with the handle of a goal that somebody wants cancelled."""
        self.cancel_callback = cancel_cb

    def start(self) -> None:
        """Offer the action."""
        if self._server is not None:
            return
        node = STATE.require(f"ActionServer('{self.ns}')")
        name = node.parameters.search("actionlib_status_frequency")
        status_hz = 5.0 if name is None else float(node.parameters.get(name, 5.0))
        self.started = True
        self._server = _Server(
            node,
            self.ns,
            self.ActionSpec,
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
            timing=ActionTiming(status_hz=status_hz),
        )

    def stop(self) -> None:
        """Stop offering the action; goals should be over."""
        self.started = False
        if self._server is not None:
            self._server.close()
            self._server = None

    def publish_status(self) -> None:
        """Tell the status of all goals now."""
        if self._server is not None:
            self._server.publish_status()

    def _on_goal(self, goal: ServerGoal) -> None:
        self.goal_callback(ServerGoalHandle(goal, self))

    def _on_cancel(self, goal: ServerGoal) -> None:
        self.cancel_callback(ServerGoalHandle(goal, self))
