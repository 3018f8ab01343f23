"""Leaves of BehaviorTree.CPP, and Nav2's conditions."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from gazelle.nodes.nav2.behavior_trees.ros_interface import (
    distance_m,
    goals_of,
    path_length_m,
    plane_pose,
)
from gazelle.nodes.nav2.behavior_trees.script import evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import Leaf, Status

__all__ = ["CONDITIONS"]

_S = Status
_FRAMES = ("global_frame", "robot_base_frame")


def _status_of(value: bool) -> Status:
    return _S.SUCCESS if value else _S.FAILURE


class _AlwaysSuccess(Leaf):
    """Success."""

    def tick(self) -> Status:
        return _S.SUCCESS


class _AlwaysFailure(Leaf):
    """Failure."""

    def tick(self) -> Status:
        return _S.FAILURE


class _SetBlackboard(Leaf):
    """Sets a key."""

    INPUTS = ("value",)
    OUTPUTS = ("output_key",)

    def tick(self) -> Status:
        key = str(self.ports.text("output_key") or "").strip("{}")
        self.ports.blackboard.set(key, self.ports.get("value"))
        return _S.SUCCESS


class _UnsetBlackboard(Leaf):
    """Forgets a key."""

    INPUTS = ("key",)

    def tick(self) -> Status:
        self.ports.blackboard.unset(str(self.ports.text("key") or "").strip("{}"))
        return _S.SUCCESS


class _Script(Leaf):
    """Runs a script."""

    INPUTS = ("code",)

    def tick(self) -> Status:
        evaluate(self.ports.get("code"), self.ports.blackboard)
        return _S.SUCCESS


class _ScriptCondition(Leaf):
    """Success when a script's value is true."""

    INPUTS = ("code",)

    def tick(self) -> Status:
        return _status_of(bool(evaluate(self.ports.get("code"), self.ports.blackboard)))


class _Sleep(Leaf):
    """Waits milliseconds."""

    INPUTS = ("msec",)

    def begin(self) -> None:
        self.since_ns: int | None = None

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        now_ns = self.ros.now_ns()
        self.since_ns = now_ns if self.since_ns is None else self.since_ns
        if (now_ns - self.since_ns) / 1e6 < self.ports.number("msec"):
            return _S.RUNNING
        self.begin()
        return _S.SUCCESS


class _GoalReached(Leaf):
    """The robot is at the goal (25 cm, as Nav2's parameter goal_reached_tol)."""

    INPUTS = ("goal", *_FRAMES)

    def tick(self) -> Status:
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in _FRAMES))
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

    INPUTS = ("distance", *_FRAMES)

    def begin(self) -> None:
        self.start: Any = None

    def tick(self) -> Status:
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in _FRAMES))
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


class _RemovePassedGoals(Leaf):
    """Leaves out the goals that the robot has passed."""

    INPUTS = ("input_goals", "radius", *_FRAMES)
    OUTPUTS = ("output_goals",)

    def tick(self) -> Status:
        given = self.ports.get("input_goals")
        goals = goals_of(given)
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in _FRAMES))
        if pose is None:
            return _S.FAILURE
        radius = self.ports.number("radius", 0.5)
        while len(goals) > 1:
            at = plane_pose(goals[0].pose)
            if math.hypot(at.x_m - pose.x_m, at.y_m - pose.y_m) > radius:
                break
            goals.pop(0)
        if hasattr(given, "goals"):
            given.goals = goals
            goals = given
        self.ports.set("output_goals", goals)
        return _S.SUCCESS


class _TruncatePath(Leaf):
    """Cuts the end of a path off."""

    INPUTS = ("input_path", "distance")
    OUTPUTS = ("output_path",)

    def tick(self) -> Status:
        path = self.ports.get("input_path")
        poses, left = list(path.poses), self.ports.number("distance", 1.0)
        while len(poses) > 1 and left > 0:
            left -= distance_m(poses[-1].pose, poses[-2].pose)
            poses.pop()
        self.ports.set("output_path", type(path)(header=path.header, poses=poses))
        return _S.SUCCESS


class _TruncatePathLocal(Leaf):
    """Keeps what of a path is near the robot."""

    INPUTS: ClassVar[tuple[str, ...]] = (
        "input_path", "distance_forward", "distance_backward", "robot_frame",
        "transform_tolerance", "pose", "angular_distance_weight", "max_robot_pose_search_dist",
    )  # fmt: skip
    OUTPUTS = ("output_path",)

    def tick(self) -> Status:
        path = self.ports.get("input_path")
        pose = self.ros.pose(path.header.frame_id, str(self.ports.get("robot_frame", "")))
        if pose is None or not path.poses:
            return _S.FAILURE
        at = [plane_pose(one.pose) for one in path.poses]
        away = [math.hypot(p.x_m - pose.x_m, p.y_m - pose.y_m) for p in at]
        middle = away.index(min(away))
        first = self._walk(at, middle, -1, self.ports.number("distance_backward", 4.0))
        last = self._walk(at, middle, 1, self.ports.number("distance_forward", 8.0))
        kept = list(path.poses[first : last + 1])
        self.ports.set("output_path", type(path)(header=path.header, poses=kept))
        return _S.SUCCESS

    @staticmethod
    def _walk(at: list[Any], place: int, step: int, left: float) -> int:
        while 0 <= place + step < len(at):
            one, other = at[place], at[place + step]
            left -= math.hypot(other.x_m - one.x_m, other.y_m - one.y_m)
            if left < 0:
                break
            place += step
        return place


class _Selector(Leaf):
    """The name that a topic told last, else the default."""

    OUTPUT = "selected_planner"
    TOPIC = "planner_selector"

    def tick(self) -> Status:
        topic = str(self.ports.get("topic_name", self.TOPIC))
        said = self.ros.latest(topic, "std_msgs/msg/String", latched=True)
        default = next((p for p in self.INPUTS if p.startswith("default_")), "")
        name = said.data if said is not None else str(self.ports.get(default, ""))
        if not name:
            return _S.FAILURE
        self.ports.set(self.OUTPUT, name)
        return _S.SUCCESS


def _selector(word: str) -> type[Leaf]:
    attributes = {
        "INPUTS": (f"default_{word}", "topic_name"),
        "OUTPUTS": (f"selected_{word}",),
        "OUTPUT": f"selected_{word}",
        "TOPIC": f"{word}_selector",
        "__doc__": _Selector.__doc__,
    }
    return type(f"_{word}_selector", (_Selector,), attributes)


CONDITIONS: dict[str, type[Leaf]] = {
    "AlwaysSuccess": _AlwaysSuccess,
    "AlwaysFailure": _AlwaysFailure,
    "SetBlackboard": _SetBlackboard,
    "UnsetBlackboard": _UnsetBlackboard,
    "Script": _Script,
    "ScriptCondition": _ScriptCondition,
    "Sleep": _Sleep,
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
    "RemovePassedGoals": _RemovePassedGoals,
    "TruncatePath": _TruncatePath,
    "TruncatePathLocal": _TruncatePathLocal,
    "PlannerSelector": _selector("planner"),
    "ControllerSelector": _selector("controller"),
    "SmootherSelector": _selector("smoother"),
    "GoalCheckerSelector": _selector("goal_checker"),
    "ProgressCheckerSelector": _selector("progress_checker"),
}
"""Leaves that need no action, by their names in XML."""
