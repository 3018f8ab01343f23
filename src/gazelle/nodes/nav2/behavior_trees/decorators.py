"""Decorators of BehaviorTree.CPP and Nav2: nodes that change what one child says or when it runs.

Periods count in the node's clock.
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

from gazelle.interfaces.stamps import ns_of
from gazelle.nodes.nav2.behavior_trees.ros_interface import path_length_m, poses_of
from gazelle.nodes.nav2.behavior_trees.script import evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import Decorator, Status

__all__ = ["DECORATORS"]

_S = Status
_NANO = 1e9


class _Inverter(Decorator):
    """Success for failure and the other way round."""

    def tick(self) -> Status:
        status = self.child.execute()
        if not status.is_done:
            return status
        self.halt_children()
        return _S.FAILURE if status is _S.SUCCESS else _S.SUCCESS


class _Force(Decorator):
    """Says one thing whatever the child says."""

    SAYS = _S.SUCCESS

    def tick(self) -> Status:
        status = self.child.execute()
        if not status.is_done:
            return status
        self.halt_children()
        return self.SAYS


class _ForceSuccess(_Force):
    """Success, whatever the child says."""


class _ForceFailure(_Force):
    """Failure, whatever the child says."""

    SAYS = _S.FAILURE


class _Again(Decorator):
    """The child again and again: `AGAIN` goes on, the other one ends."""

    AGAIN = _S.SUCCESS
    PORT = "num_cycles"

    def begin(self) -> None:
        self.count = 0

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        most = int(self.ports.number(self.PORT))
        while most < 0 or self.count < most:
            status = self.child.execute()
            if status in (_S.RUNNING, _S.SKIPPED):
                return status
            self.halt_children()
            if status is not self.AGAIN:
                self.begin()
                return status
            self.count += 1
            if self.count != most:
                # The original returns to its loop, too, so that nothing blocks for ever.
                return _S.RUNNING
        self.begin()
        return self.AGAIN


class _Repeat(_Again):
    """So many times, until it fails."""

    INPUTS = ("num_cycles",)


class _Retry(_Again):
    """So many times, until it succeeds."""

    INPUTS = ("num_attempts",)
    AGAIN = _S.FAILURE
    PORT = "num_attempts"


class _KeepRunningUntilFailure(Decorator):
    """Again and again until the child fails."""

    def tick(self) -> Status:
        status = self.child.execute()
        if status is _S.SUCCESS:
            self.halt_children()
            return _S.RUNNING
        if status is _S.FAILURE:
            self.halt_children()
        return status


class _KeepRunningUntilSuccess(Decorator):
    """Again and again until the child succeeds."""

    def tick(self) -> Status:
        status = self.child.execute()
        if status is _S.FAILURE:
            self.halt_children()
            return _S.RUNNING
        return status


class _Timed(Decorator):
    """Knows since when it runs."""

    def begin(self) -> None:
        self.since_ns: int | None = None

    def halted(self) -> None:
        self.begin()

    def elapsed_s(self) -> float:
        """Return for how long, from the first question on."""
        now_ns = self.ros.now_ns()
        if self.since_ns is None or self.since_ns > now_ns:
            self.since_ns = now_ns
        return (now_ns - self.since_ns) / _NANO


class _Delay(_Timed):
    """Waits before the child."""

    INPUTS = ("delay_msec",)

    def tick(self) -> Status:
        if self.elapsed_s() * 1000 < self.ports.number("delay_msec"):
            return _S.RUNNING
        status = self.child.execute()
        if status.is_done:
            self.halt_children()
            self.begin()
        return status


class _Timeout(_Timed):
    """Fails when the child takes too long."""

    INPUTS = ("msec",)

    def tick(self) -> Status:
        late = self.elapsed_s() * 1000 > self.ports.number("msec")
        status = _S.FAILURE if late else self.child.execute()
        if status is not _S.RUNNING:
            self.halt_children()
            self.begin()
        return status


class _RunOnce(Decorator):
    """The child once in the tree's life, halts or not."""

    INPUTS = ("then_skip",)

    def begin(self) -> None:
        self.kept: Status | None = None

    def tick(self) -> Status:
        if self.kept is not None:
            return _S.SKIPPED if self.ports.flag("then_skip", True) else self.kept
        status = self.child.execute()
        if status.is_done:
            self.kept = status
            self.halt_children()
        return status


class _SingleTrigger(Decorator):
    """Nav2: the child once, failure afterwards until a halt."""

    def begin(self) -> None:
        self.fired = False

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        if self.fired:
            return _S.FAILURE
        status = self.child.execute()
        self.fired = status.is_done
        return status


class _Precondition(Decorator):
    """The child while a script says so, else the status of the port ``else``."""

    INPUTS = ("if", "else")

    def tick(self) -> Status:
        blackboard = self.ports.blackboard
        if self.child.status is _S.RUNNING or evaluate(self.ports.get("if"), blackboard):
            return self.child.execute()
        return Status[str(self.ports.get("else", "FAILURE")).upper()]


class _RateController(_Timed):
    """Nav2: the child so many times a second."""

    INPUTS: ClassVar[tuple[str, ...]] = ("hz",)

    def begin(self) -> None:
        super().begin()
        self.first = True

    def tick(self) -> Status:
        if self.status is _S.IDLE:
            self.begin()
        due = self.elapsed_s() >= self.period_s()
        if not (self.first or self.child.status is _S.RUNNING or due):
            return _S.RUNNING
        self.first = False
        status = self.child.execute()
        if status is _S.SUCCESS:
            self.since_ns = self.ros.now_ns()
        return status

    def period_s(self) -> float:
        """Return the time between two ticks of the child."""
        return 1.0 / max(self.ports.number("hz", 10.0), 1e-6)


class _SpeedController(_RateController):
    """Nav2: the child more often the faster the robot is."""

    INPUTS = ("min_rate", "max_rate", "min_speed", "max_speed", "goal", "goals")

    def begin(self) -> None:
        super().begin()
        self.goal: Any = None

    def tick(self) -> Status:
        goal = self.ports.get("goal", None)
        if goal is not self.goal:
            self.begin()
            self.goal = goal
        return super().tick()

    def period_s(self) -> float:
        number = self.ports.number
        low, high = number("min_speed", 0.0), number("max_speed", 0.5)
        slow, fast = number("min_rate", 0.1), number("max_rate", 1.0)
        share = min(max((self.ros.speed_m_s() - low) / max(high - low, 1e-9), 0.0), 1.0)
        return 1.0 / max(slow + share * (fast - slow), 1e-6)


class _DistanceController(Decorator):
    """Nav2: the child each time the robot has gone so far."""

    INPUTS = ("distance", "global_frame", "robot_base_frame")

    def begin(self) -> None:
        self.start: Any = None
        self.first = True

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        if self.status is _S.IDLE:
            self.begin()
        frames = (self.ports.get("global_frame", ""), self.ports.get("robot_base_frame", ""))
        pose = self.ros.pose(*frames)
        if pose is None:
            return _S.FAILURE
        self.start = self.start or pose
        moved = math.hypot(pose.x_m - self.start.x_m, pose.y_m - self.start.y_m)
        far = moved >= self.ports.number("distance", 1.0)
        if not (self.first or far or self.child.status is _S.RUNNING):
            return _S.RUNNING
        self.first = False
        status = self.child.execute()
        if status is _S.SUCCESS:
            self.start = pose
        return status


class _GoalUpdater(Decorator):
    """Nav2: goals of the topic ``goal_update`` take the place of older ones."""

    INPUTS = ("input_goal", "input_goals")
    OUTPUTS = ("output_goal", "output_goals")

    def tick(self) -> Status:
        goal = self.ports.get("input_goal", None)
        newest = self.ros.latest("goal_update", "geometry_msgs/msg/PoseStamped")
        if newest is not None and (
            goal is None or ns_of(newest.header.stamp) > ns_of(goal.header.stamp)
        ):
            goal = newest
        if goal is not None:
            self.ports.set("output_goal", goal)
        if self.ports.has("input_goals"):
            self.ports.set("output_goals", self.ports.get("input_goals"))
        return self.child.execute()


class _GoalUpdatedController(Decorator):
    """Nav2: the child at the beginning and whenever the goal changes."""

    INPUTS = ("goal", "goals")

    def begin(self) -> None:
        self.goal: Any = None
        self.waits = True

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        goal = (self.ports.get("goal", None), self.ports.get("goals", None))
        if self.status is _S.IDLE or goal != self.goal:
            self.goal, self.waits = goal, True
        if not (self.waits or self.child.status is _S.RUNNING):
            return _S.RUNNING
        self.waits = False
        return self.child.execute()


class _PathLongerOnApproach(Decorator):
    """Nav2: the child when the path gets much longer close to the goal."""

    INPUTS = ("path", "prox_len", "length_factor")

    def begin(self) -> None:
        self.old: Any = None

    def tick(self) -> Status:
        new = self.ports.get("path", None)
        if new is None:
            return self.child.execute()
        old, factor = self.old, self.ports.number("length_factor", 2.0)
        if old is not None and self.status is not _S.RUNNING and new is not old:
            is_same_goal = poses_of(old)[-1:] == poses_of(new)[-1:]
            before, after = path_length_m(old), path_length_m(new)
            near = after < self.ports.number("prox_len", 3.0)
            if not (is_same_goal and near and after > before * factor):
                self.old = new
                return _S.SUCCESS
        elif self.status is not _S.RUNNING:
            self.old = new
            return _S.SUCCESS
        status = self.child.execute()
        if status.is_done:
            self.old = new
        return status


DECORATORS: dict[str, type[Decorator]] = {
    "Inverter": _Inverter,
    "ForceSuccess": _ForceSuccess,
    "ForceFailure": _ForceFailure,
    "Repeat": _Repeat,
    "RetryUntilSuccessful": _Retry,
    "RetryUntilSuccesful": _Retry,
    "KeepRunningUntilFailure": _KeepRunningUntilFailure,
    "KeepRunningUntilSuccess": _KeepRunningUntilSuccess,
    "Delay": _Delay,
    "Timeout": _Timeout,
    "RunOnce": _RunOnce,
    "Precondition": _Precondition,
    "SingleTrigger": _SingleTrigger,
    "RateController": _RateController,
    "SpeedController": _SpeedController,
    "DistanceController": _DistanceController,
    "GoalUpdater": _GoalUpdater,
    "GoalUpdatedController": _GoalUpdatedController,
    "PathLongerOnApproach": _PathLongerOnApproach,
}
"""Decorators by their names in XML."""
