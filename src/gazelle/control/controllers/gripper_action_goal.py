"""The goal of a gripper: reached, or stalled on what it grips."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Any

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.ports import GoalPort
from gazelle.parameters import Parameter

__all__ = ["GRIPPER_ROWS", "GripperGoal", "Outcome"]

_NANO = 1_000_000_000

GRIPPER_ROWS = (
    Parameter("joint", "text", None, "the joint; required"),
    Parameter("goal_tolerance", "number", 0.01, "how near the goal counts as reached", "rad, m"),
    Parameter(
        "stall_velocity_threshold",
        "number",
        0.001,
        "slower than this counts as standing",
        "rad/s, m/s",
    ),
    Parameter("stall_timeout", "number", 1.0, "standing this long counts as stalled", "s"),
    Parameter(
        "allow_stalling", "flag", False, "stalling is a success; else it aborts", generations=(2,)
    ),
    Parameter("action_monitor_rate", "number", 20.0, "rate of feedback", "Hz"),
)


class Outcome(Enum):
    """How a gripper's motion ended."""

    REACHED = "reached"
    STALLED = "stalled"


class GripperGoal:
    """Watches one goal at a time, and ends it.

    Attributes:
        goal: what is executed, None for nothing.
    """

    def __init__(
        self,
        context: ControllerContext,
        message: Callable[[float, Outcome | None], dict[str, Any]],
    ) -> None:
        """Read the tolerances.

        Args:
            context: of the controller.
            message: makes a result, or feedback, from a position and what was the outcome.
        """
        parameters = context.parameters
        self.goal: GoalPort | None = None
        self._is_ros1 = context.generation == 1
        self._tolerance = abs(parameters.number("goal_tolerance"))
        self._slow = parameters.number("stall_velocity_threshold")
        self._timeout_ns = round(parameters.number("stall_timeout") * _NANO)
        self._stalls_well = parameters.flag("allow_stalling") and not self._is_ros1
        rate_hz = parameters.number("action_monitor_rate")
        self._feedback_ns = round(_NANO / rate_hz) if rate_hz > 0.0 else 0
        self._next_ns = 0
        self._moved_ns = 0
        self._message = message

    def begin(self, goal: GoalPort, time_ns: int) -> None:
        """Take a goal over; the one before is replaced."""
        self.end()
        self.goal = goal
        self._moved_ns = time_ns
        self._next_ns = time_ns + self._feedback_ns
        goal.accept()

    def end(self) -> None:
        """End a goal that is not pursued any more."""
        goal, self.goal = self.goal, None
        # Its server may have been closed before, and has ended it then.
        if goal is None or not goal.is_active:
            return
        if self._is_ros1:
            goal.cancel()
        else:
            goal.abort()

    def cancel(self, goal: GoalPort) -> bool:
        """End the goal when it is this one; tells whether it is."""
        if goal is not self.goal:
            return False
        self.goal = None
        goal.cancel()
        return True

    def watch(self, time_ns: int, error: float, position: float, velocity: float) -> None:
        """End the goal when it is reached or the gripper stands still for too long."""
        goal = self.goal
        if goal is None:
            return
        if abs(error) < self._tolerance:
            self._finish(goal, Outcome.REACHED, position, is_good=True)
        elif abs(velocity) > self._slow:
            self._moved_ns = time_ns
        elif time_ns - self._moved_ns > self._timeout_ns:
            self._finish(goal, Outcome.STALLED, position, is_good=self._stalls_well)
        if self.goal is not None and self._feedback_ns and time_ns >= self._next_ns:
            self._next_ns = time_ns + self._feedback_ns
            if goal.is_feedback_wanted:
                goal.publish_feedback(self._message(position, None))

    def _finish(self, goal: GoalPort, outcome: Outcome, position: float, *, is_good: bool) -> None:
        self.goal = None
        result = self._message(position, outcome)
        if is_good:
            goal.succeed(result)
        else:
            goal.abort(result, "the gripper stalled before it reached the goal")
