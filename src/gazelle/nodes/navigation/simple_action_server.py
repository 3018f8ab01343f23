"""Actions that work on one goal at a time, as SimpleActionServers of ROS 1 and Nav2 do."""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING, Any, Literal

from gazelle.graph.actions import ActionServer, GoalStateError, LocalGoal, ServerGoal

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["SimpleActionServer"]

_ACCEPTED = "This goal has been accepted by the simple action server"
_REPLACED = "This goal was canceled because another goal was received by the simple action server"


class SimpleActionServer:
    """The newest goal is worked on; those before it end.

    Attributes:
        current: the goal that is worked on, None without one.
        name: of the action.
    """

    def __init__(
        self, node: Node, name: str, action_type: str, *, ros_version: Literal[1, 2] = 1
    ) -> None:
        """Offer the action."""
        self.current: ServerGoal | None = None
        self.name = name
        self._next: ServerGoal | None = None
        self._changed = threading.Condition()
        self._ros_version = ros_version
        self._refuses = ""
        self._server = ActionServer(
            node,
            name,
            action_type,
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
            ros_version=ros_version,
        )

    @property
    def has_new(self) -> bool:
        """True when a newer goal waits."""
        return self._next is not None

    @property
    def is_cancelled(self) -> bool:
        """True when somebody asked for the end of the current goal."""
        return self.current is not None and self.current.is_cancel_requested

    @property
    def should_end(self) -> bool:
        """True when the current goal is to be left: cancelled, or a newer one waits."""
        return self.is_cancelled or self.has_new

    @property
    def goal_class(self) -> Any:
        """The action's goal message."""
        return self._server.types.Goal

    @property
    def result_class(self) -> Any:
        """The action's result message."""
        return self._server.types.Result

    def refuse(self, why: str) -> None:
        """Reject goals from now on, for a reason; with an empty one take them again."""
        self._refuses = why

    def submit(self, goal: Any) -> LocalGoal:
        """Send a goal from this process."""
        return self._server.submit(goal)

    def wait(self, timeout_s: float) -> bool:
        """Wait in wall time for a new goal; tell whether one is there."""
        with self._changed:
            return self._changed.wait_for(lambda: self._next is not None, timeout_s)

    def take(self) -> ServerGoal | None:
        """Begin with the newest goal; the one before it ends. None when there is no new one."""
        with self._changed:
            goal, self._next = self._next, None
            before = self.current
            if goal is None:
                return None
            self.current = goal
        if before is not None and before.is_active:
            self._replace(before)
        if self._ros_version == 1:
            goal.accept(_ACCEPTED)
        elif not goal.status.is_terminal and not goal.is_cancel_requested:
            # Cancelled between the two: whoever works on it sees that.
            with contextlib.suppress(GoalStateError):
                goal.execute()
        return goal

    def feedback(self, feedback: Any) -> None:
        """Tell how the current goal goes."""
        if self.current is not None:
            self.current.publish_feedback(feedback)

    def succeed(self, result: Any = None, text: str = "") -> None:
        """End the current goal well."""
        goal, self.current = self.current, None
        if goal is not None and goal.is_active:
            goal.succeed(result, text)

    def abort(self, result: Any = None, text: str = "") -> None:
        """End the current goal because it cannot be reached."""
        goal, self.current = self.current, None
        if goal is not None and goal.is_active:
            goal.abort(result, text)

    def cancel(self, result: Any = None, text: str = "") -> None:
        """End the current goal because somebody asked for it."""
        goal, self.current = self.current, None
        if goal is not None and not goal.status.is_terminal:
            goal.cancel(result, text)

    def close(self) -> None:
        """Withdraw the action."""
        self._server.close()
        with self._changed:
            self._changed.notify_all()

    def _replace(self, goal: ServerGoal) -> None:
        if self._ros_version == 1:
            goal.cancel(text=_REPLACED)
        elif goal.is_cancel_requested:
            goal.cancel()
        else:
            goal.abort(text=_REPLACED)

    def _on_goal(self, goal: ServerGoal) -> None:
        if self._refuses:
            goal.reject(text=self._refuses)
            return
        if self._ros_version == 2:
            goal.accept_deferred()
        with self._changed:
            before, self._next = self._next, goal
            self._changed.notify_all()
        if before is not None:
            # It was never begun.
            if self._ros_version == 1 or before.is_cancel_requested:
                before.cancel(text=_REPLACED)
            else:
                before.execute()
                before.abort(text=_REPLACED)

    def _on_cancel(self, goal: ServerGoal) -> bool:
        if self._ros_version == 2:
            # It is not cancelled before this returns; whoever takes it sees that it is to end.
            return True
        with self._changed:
            waits = self._next is goal
            if waits:
                self._next = None
        if waits:
            goal.cancel(text="")
        return True
