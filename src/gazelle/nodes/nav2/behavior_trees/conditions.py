"""Condition nodes of BehaviorTree.CPP and Nav2: leaves that say yes or no."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from gazelle.nodes.nav2.behavior_trees.ros_interface import (
    path_length_m,
    plane_pose,
)
from gazelle.nodes.nav2.behavior_trees.script import evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import FRAME_PORTS, Leaf, Status

__all__ = ["CONDITIONS"]

_S = Status


def _status_of(value: bool) -> Status:
    return _S.SUCCESS if value else _S.FAILURE


class _ScriptCondition(Leaf):
    """Success when a script's value is true."""

    INPUTS = ("code",)

    def tick(self) -> Status:
        return _status_of(bool(evaluate(self.ports.get("code"), self.ports.blackboard)))


class _GoalReached(Leaf):
    """The robot is at the goal (25 cm, as Nav2's parameter goal_reached_tol)."""

    INPUTS = ("goal", *FRAME_PORTS)

    def tick(self) -> Status:
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in FRAME_PORTS))
        goal = self.ros.in_frame(self.ports.get("goal"))
        if pose is None or goal is None:
            return _S.FAILURE
        at = plane_pose(goal.pose)
        away = math.hypot(at.x_m - pose.x_m, at.y_m - pose.y_m)
        return _status_of(away <= float(self.ports.blackboard.root.get("goal_reached_tol", 0.25)))


class _GoalUpdated(Leaf):
    """The goal has changed since the last tick."""

    INPUTS = ("goal", "goals")

    def begin(self) -> None:
        self.goal: Any = None

    def tick(self) -> Status:
        goal = (self.ports.get("goal", None), self.ports.get("goals", None))
        # Nav2 starts to compare at the first tick after a pause.
        changed = self.status is not _S.IDLE and goal != self.goal
        self.goal = goal
        return _status_of(changed)


class _GloballyUpdatedGoal(Leaf):
    """The goal has changed since this node was ticked last, pauses included."""

    INPUTS = ("goal", "goals")

    def begin(self) -> None:
        self.goal: Any = None
        self.first = True

    def tick(self) -> Status:
        goal = (self.ports.get("goal", None), self.ports.get("goals", None))
        changed = not self.first and goal != self.goal
        self.goal, self.first = goal, False
        return _status_of(changed)


class _InitialPoseReceived(Leaf):
    """Somebody has told where the robot is."""

    INPUTS = ("initial_pose_received",)

    def tick(self) -> Status:
        return _status_of(bool(self.ports.blackboard.root.get("initial_pose_received", False)))


class _TransformAvailable(Leaf):
    """tf connects two frames; once is enough."""

    INPUTS = ("child", "parent")

    def begin(self) -> None:
        self.was_there = False

    def tick(self) -> Status:
        ends = (str(self.ports.get("parent")), str(self.ports.get("child")))
        self.was_there = self.was_there or self.ros.can_transform(*ends)
        return _status_of(self.was_there)


class _TimeExpired(Leaf):
    """So many seconds have gone by since the last success."""

    INPUTS: ClassVar[tuple[str, ...]] = ("seconds",)

    def begin(self) -> None:
        self.since_ns = 0

    def tick(self) -> Status:
        now_ns = self.ros.now_ns()
        if self.status is _S.IDLE:
            self.since_ns = now_ns
            return _S.FAILURE
        if (now_ns - self.since_ns) / 1e9 < self.ports.number("seconds", 1.0):
            return _S.FAILURE
        self.since_ns = now_ns
        return _S.SUCCESS


class _PathExpiringTimer(_TimeExpired):
    """So many seconds have gone by since the path changed."""

    INPUTS = ("seconds", "path")

    def begin(self) -> None:
        super().begin()
        self.path: Any = None

    def tick(self) -> Status:
        path = self.ports.get("path", None)
        if path is not self.path:
            self.path, self.since_ns = path, self.ros.now_ns()
        return super().tick()


class _DistanceTraveled(Leaf):
    """The robot has gone so far since the last success."""

    INPUTS = ("distance", *FRAME_PORTS)

    def begin(self) -> None:
        self.start: Any = None

    def tick(self) -> Status:
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in FRAME_PORTS))
        if pose is None:
            return _S.FAILURE
        if self.status is _S.IDLE or self.start is None:
            self.start = pose
            return _S.FAILURE
        moved = math.hypot(pose.x_m - self.start.x_m, pose.y_m - self.start.y_m)
        if moved < self.ports.number("distance", 1.0):
            return _S.FAILURE
        self.start = pose
        return _S.SUCCESS


class _IsStuck(Leaf):
    """Never: Nav2 guesses it from odometry's braking, here progress checkers tell."""

    def tick(self) -> Status:
        return _S.FAILURE


class _IsPathValid(Leaf):
    """No pose of the path is in an obstacle now; asks the planner server."""

    INPUTS = ("path", "server_timeout", "max_cost", "consider_cost_change")

    def begin(self) -> None:
        self.call: Any = None

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        kind = "nav2_msgs/srv/IsPathValid"
        if self.call is None:
            request = self.ros.message(kind)
            request.path = self.ports.get("path")
            self.call = self.ros.service("is_path_valid", kind, request)
        if not self.call.is_done:
            return _S.RUNNING
        call, self.call = self.call, None
        return _status_of(call.succeeded and bool(call.result.is_valid))


class _Battery(Leaf):
    """What the last ``BatteryState`` says."""

    INPUTS = ("battery_topic", "min_battery", "is_voltage")

    def state(self) -> Any:
        topic = str(self.ports.get("battery_topic", "/battery_status"))
        return self.ros.latest(topic, "sensor_msgs/msg/BatteryState")


class _IsBatteryLow(_Battery):
    """Percentage, or voltage, is at the limit or below."""

    def tick(self) -> Status:
        state = self.state()
        if state is None:
            return _S.FAILURE
        value = state.voltage if self.ports.flag("is_voltage", False) else state.percentage
        return _status_of(value <= self.ports.number("min_battery"))


class _IsBatteryCharging(_Battery):
    """The battery is being charged."""

    def tick(self) -> Status:
        state = self.state()
        return _status_of(state is not None and state.power_supply_status == 1)


class _ErrorCodes(Leaf):
    """The port ``error_code`` is one of some."""

    INPUTS = ("error_code", "error_codes_to_check")
    CODES: tuple[int, ...] = ()

    def tick(self) -> Status:
        wanted = set(self.CODES)
        if not self.CODES:
            text = str(self.ports.get("error_codes_to_check", ""))
            wanted = {int(word) for word in text.replace(",", ";").split(";") if word.strip()}
        code = self.ports.get("error_code", None)
        return _status_of(code is not None and int(code) in wanted)


class _ControllerRecovery(_ErrorCodes):
    """Unknown, no progress, patience exceeded, no valid control."""

    CODES = (100, 104, 105, 106)


class _PlannerRecovery(_ErrorCodes):
    """Unknown, no valid path, timeout."""

    CODES = (200, 207, 208, 300, 307, 308)


class _SmootherRecovery(_ErrorCodes):
    """Unknown, timeout, failed to smooth."""

    CODES = (500, 502, 504, 505)


class _IsPoseNear(Leaf):
    """Two poses are near each other, or robot and goal along the path."""

    INPUTS = ("path", "proximity_threshold", "max_robot_pose_search_dist")

    def tick(self) -> Status:
        path = self.ports.get("path", None)
        if path is None or not path.poses:
            return _S.FAILURE
        return _status_of(path_length_m(path) < self.ports.number("proximity_threshold", 3.0))


CONDITIONS: dict[str, type[Leaf]] = {
    "ScriptCondition": _ScriptCondition,
    "GoalReached": _GoalReached,
    "GoalUpdated": _GoalUpdated,
    "GlobalUpdatedGoal": _GloballyUpdatedGoal,
    "GloballyUpdatedGoal": _GloballyUpdatedGoal,
    "InitialPoseReceived": _InitialPoseReceived,
    "TransformAvailable": _TransformAvailable,
    "TimeExpired": _TimeExpired,
    "PathExpiringTimer": _PathExpiringTimer,
    "DistanceTraveled": _DistanceTraveled,
    "IsStuck": _IsStuck,
    "IsPathValid": _IsPathValid,
    "IsBatteryLow": _IsBatteryLow,
    "IsBatteryCharging": _IsBatteryCharging,
    "AreErrorCodesPresent": _ErrorCodes,
    "WouldAControllerRecoveryHelp": _ControllerRecovery,
    "WouldAPlannerRecoveryHelp": _PlannerRecovery,
    "WouldASmootherRecoveryHelp": _SmootherRecovery,
    "IsGoalNearby": _IsPoseNear,
}
"""By their names in XML."""
