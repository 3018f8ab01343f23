"""Action nodes of BehaviorTree.CPP and Nav2: leaves that act, send goals and call services."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

from gazelle.nodes.nav2.behavior_trees.ros_interface import (
    Call,
    distance_m,
    goals_of,
    plane_pose,
)
from gazelle.nodes.nav2.behavior_trees.script import evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import FRAME_PORTS, Leaf, Ports, Status, TreeNode

__all__ = ["ACTIONS"]

_S = Status
_ERRORS = {"error_code_id": "error_code", "error_code": "error_code", "error_msg": "error_msg"}


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


class _RemovePassedGoals(Leaf):
    """Leaves out the goals that the robot has passed."""

    INPUTS = ("input_goals", "radius", *FRAME_PORTS)
    OUTPUTS = ("output_goals",)

    def tick(self) -> Status:
        given = self.ports.get("input_goals")
        goals = goals_of(given)
        pose = self.ros.pose(*(str(self.ports.get(name, "")) for name in FRAME_PORTS))
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


class _Action(Leaf):
    """Sends a goal and is running until its result.

    `GOAL` gives the goal's fields by ports: (port, kind, default). A goal whose inputs change
    while it runs is sent anew when the class says so.
    """

    KIND: ClassVar[str] = ""
    SERVER: ClassVar[str] = ""
    GOAL: ClassVar[Mapping[str, tuple[str, str, Any]]] = {}
    RESULT: ClassVar[Mapping[str, str]] = {}
    FOLLOWS: ClassVar[tuple[str, ...]] = ()
    COUNTS_AS_RECOVERY: ClassVar[bool] = False

    def begin(self) -> None:
        self.call: Call | None = None
        self.sent: tuple[Any, ...] = ()

    def halted(self) -> None:
        if self.call is not None and not self.call.is_done:
            self.call.cancel()
        self.begin()

    def tick(self) -> Status:
        changed = self.call is not None and self._followed() != self.sent
        if self.call is None or changed:
            self.sent = self._followed()
            if self.COUNTS_AS_RECOVERY and self.call is None:
                board = self.ports.blackboard.root
                board.set("number_recoveries", int(board.get("number_recoveries", 0)) + 1)
            server = str(self.ports.get("server_name", self.SERVER))
            self.call = self.ros.action(server, f"nav2_msgs/action/{self.KIND}", self.goal())
        if not self.call.is_done:
            return _S.RUNNING
        call = self.call
        self.begin()
        if call.result is not None:
            for port, field in {**self.RESULT, **_ERRORS}.items():
                if hasattr(call.result, field):
                    self.ports.set(port, getattr(call.result, field))
        if not call.succeeded and call.why:
            self.ros.log("debug", f"{self.name}: {call.why}")
        return _S.SUCCESS if call.succeeded else _S.FAILURE

    def goal(self) -> dict[str, Any]:
        """Return the goal's fields."""
        found: dict[str, Any] = {}
        for field, (port, kind, default) in self.GOAL.items():
            value = _read(self.ports, port, kind, default)
            if value is not None:
                found[field] = value
        return found

    def _followed(self) -> tuple[Any, ...]:
        # By identity: comparing paths of thousands of poses at each tick would cost.
        return tuple(id(self.ports.get(port, None)) for port in self.FOLLOWS)


class _ComputePath(_Action):
    """Asks for a path."""

    RESULT: ClassVar[Mapping[str, str]] = {"path": "path"}

    def goal(self) -> dict[str, Any]:
        found = super().goal()
        found["use_start"] = "start" in found
        return found


class _Relative(_Action):
    """Drives along a line; `SIGN` gives the direction of distance and speed."""

    SIGN = 1.0
    COUNTS_AS_RECOVERY = True

    def goal(self) -> dict[str, Any]:
        distance = abs(self.ports.number(self.INPUTS[0], 0.15))
        speed = abs(self.ports.number(self.INPUTS[1], 0.025))
        allowance = _seconds(self.ports.number("time_allowance", 10.0))
        # Nav2's BackUp takes both without a sign, too.
        return {"target": {"x": self.SIGN * distance}, "speed": self.SIGN * speed,
                "time_allowance": allowance}  # fmt: skip


class _Service(Leaf):
    """Calls a service and is running until its answer."""

    KIND: ClassVar[str] = ""
    SERVICE: ClassVar[str] = ""
    FIELDS: ClassVar[Mapping[str, tuple[str, str, Any]]] = {}
    INPUTS = ("service_name", "server_timeout")

    def begin(self) -> None:
        self.call: Call | None = None

    def halted(self) -> None:
        self.begin()

    def tick(self) -> Status:
        if self.call is None:
            request = self.ros.message(self.KIND)
            for field, (port, kind, default) in self.FIELDS.items():
                setattr(request, field, _read(self.ports, port, kind, default))
            name = str(self.ports.get("service_name", self.SERVICE))
            self.call = self.ros.service(name, self.KIND, request)
            board = self.ports.blackboard.root
            board.set("number_recoveries", int(board.get("number_recoveries", 0)) + 1)
        if not self.call.is_done:
            return _S.RUNNING
        call, self.call = self.call, None
        if not call.succeeded and call.why:
            self.ros.log("warn", f"{self.name}: {call.why}")
        return _S.SUCCESS if call.succeeded else _S.FAILURE


class _Cancel(Leaf):
    """Cancels all goals of an action."""

    KIND: ClassVar[str] = ""
    SERVER: ClassVar[str] = ""
    INPUTS = ("server_name", "server_timeout")

    def tick(self) -> Status:
        server = str(self.ports.get("server_name", self.SERVER))
        self.ros.cancel_all(server, f"nav2_msgs/action/{self.KIND}")
        return _S.SUCCESS


def _read(ports: Ports, port: str, kind: str, default: Any) -> Any:
    if kind == "seconds":
        return _seconds(ports.number(port, default))
    if kind == "number":
        return ports.number(port, default)
    if kind == "flag":
        return ports.flag(port, default)
    value = ports.get(port, default)
    if kind == "goals" and hasattr(value, "goals"):
        return list(value.goals)
    return value


def _seconds(value: float) -> dict[str, int]:
    # Cancelled and endless allowances are written as huge numbers.
    whole = int(min(max(value, 0.0), 2**31 - 1))
    return {"sec": whole, "nanosec": int((min(max(value, 0.0), 2**31 - 1) - whole) * 1e9)}


def _action(
    kind: str,
    server: str,
    goal: Mapping[str, tuple[str, str, Any]],
    *,
    base: type[_Action] = _Action,
    outputs: tuple[str, ...] = (),
    **attributes: Any,
) -> type[TreeNode]:
    """Return the class of one action; ports are the goal's and those of every action."""
    made: dict[str, Any] = {
        "KIND": kind,
        "SERVER": server,
        "GOAL": goal,
        "INPUTS": (*(port for port, _, _ in goal.values()), "server_name", "server_timeout"),
        "OUTPUTS": (*outputs, "error_code_id", "error_code", "error_msg"),
        "__doc__": base.__doc__,
    }
    return type(kind, (base,), made | attributes)


def _service(
    kind: str, name: str, fields: Mapping[str, tuple[str, str, Any]] | None = None
) -> type[TreeNode]:
    fields = fields or {}
    ports = ("service_name", "server_timeout", *(port for port, _, _ in fields.values()))
    made = {"KIND": kind, "SERVICE": name, "FIELDS": fields, "INPUTS": ports}
    return type("_service", (_Service,), {**made, "__doc__": _Service.__doc__})


def _cancel(kind: str, server: str) -> type[TreeNode]:
    made = {"KIND": kind, "SERVER": server, "__doc__": _Cancel.__doc__}
    return type("_cancel", (_Cancel,), made)


_TIME = ("time_allowance", "seconds", 10.0)
_START = ("start", "any", None)
_MOTION = ("time_allowance", "server_name", "server_timeout", "disable_collision_checks")
_SMOOTHED = {"smoothed_path": "path", "smoothing_duration": "smoothing_duration",
             "was_completed": "was_completed"}  # fmt: skip
_RESET = {"reset_distance": ("reset_distance", "number", 1.0)}

ACTIONS: dict[str, type[TreeNode]] = {
    "AlwaysSuccess": _AlwaysSuccess,
    "AlwaysFailure": _AlwaysFailure,
    "SetBlackboard": _SetBlackboard,
    "UnsetBlackboard": _UnsetBlackboard,
    "Script": _Script,
    "Sleep": _Sleep,
    "RemovePassedGoals": _RemovePassedGoals,
    "TruncatePath": _TruncatePath,
    "TruncatePathLocal": _TruncatePathLocal,
    "PlannerSelector": _selector("planner"),
    "ControllerSelector": _selector("controller"),
    "SmootherSelector": _selector("smoother"),
    "GoalCheckerSelector": _selector("goal_checker"),
    "ProgressCheckerSelector": _selector("progress_checker"),
    "ComputePathToPose": _action(
        "ComputePathToPose",
        "compute_path_to_pose",
        {"goal": ("goal", "any", None), "start": _START, "planner_id": ("planner_id", "text", "")},
        base=_ComputePath,
        outputs=("path",),
    ),
    "ComputePathThroughPoses": _action(
        "ComputePathThroughPoses",
        "compute_path_through_poses",
        {
            "goals": ("goals", "goals", None),
            "start": _START,
            "planner_id": ("planner_id", "text", ""),
        },
        base=_ComputePath,
        outputs=("path",),
    ),
    "FollowPath": _action(
        "FollowPath",
        "follow_path",
        {
            "path": ("path", "any", None),
            "controller_id": ("controller_id", "text", ""),
            "goal_checker_id": ("goal_checker_id", "text", ""),
            "progress_checker_id": ("progress_checker_id", "text", ""),
        },
        FOLLOWS=("path", "controller_id", "goal_checker_id"),
    ),
    "SmoothPath": _action(
        "SmoothPath",
        "smooth_path",
        {
            "path": ("unsmoothed_path", "any", None),
            "smoother_id": ("smoother_id", "text", ""),
            "max_smoothing_duration": ("max_smoothing_duration", "seconds", 3.0),
            "check_for_collisions": ("check_for_collisions", "flag", False),
        },
        outputs=tuple(_SMOOTHED),
        RESULT=_SMOOTHED,
    ),
    "Spin": _action(
        "Spin",
        "spin",
        {"target_yaw": ("spin_dist", "number", 1.57), "time_allowance": _TIME},
        COUNTS_AS_RECOVERY=True,
        INPUTS=("spin_dist", "is_recovery", *_MOTION),
    ),
    "BackUp": _action(
        "BackUp", "backup", {}, base=_Relative, INPUTS=("backup_dist", "backup_speed", *_MOTION)
    ),
    "DriveOnHeading": _action(
        "DriveOnHeading",
        "drive_on_heading",
        {},
        base=_Relative,
        INPUTS=("dist_to_travel", "speed", *_MOTION),
    ),
    "Wait": _action(
        "Wait", "wait", {"time": ("wait_duration", "seconds", 1.0)}, COUNTS_AS_RECOVERY=True
    ),
    "AssistedTeleop": _action(
        "AssistedTeleop",
        "assisted_teleop",
        {"time_allowance": _TIME},
        INPUTS=("time_allowance", "is_recovery", "server_name", "server_timeout"),
    ),
    "NavigateToPose": _action(
        "NavigateToPose",
        "navigate_to_pose",
        {"pose": ("goal", "any", None), "behavior_tree": ("behavior_tree", "text", "")},
    ),
    "NavigateThroughPoses": _action(
        "NavigateThroughPoses",
        "navigate_through_poses",
        {"poses": ("goals", "goals", None), "behavior_tree": ("behavior_tree", "text", "")},
    ),
    "ClearEntireCostmap": _service("nav2_msgs/srv/ClearEntireCostmap", ""),
    "ClearCostmapExceptRegion": _service("nav2_msgs/srv/ClearCostmapExceptRegion", "", _RESET),
    "ClearCostmapAroundRobot": _service("nav2_msgs/srv/ClearCostmapAroundRobot", "", _RESET),
    "ReinitializeGlobalLocalization": _service(
        "std_srvs/srv/Empty", "reinitialize_global_localization"
    ),
    "CancelControl": _cancel("FollowPath", "follow_path"),
    "ControllerCancel": _cancel("FollowPath", "follow_path"),
    "CancelBackUp": _cancel("BackUp", "backup"),
    "CancelSpin": _cancel("Spin", "spin"),
    "CancelWait": _cancel("Wait", "wait"),
    "CancelDriveOnHeading": _cancel("DriveOnHeading", "drive_on_heading"),
    "CancelAssistedTeleop": _cancel("AssistedTeleop", "assisted_teleop"),
}
"""By their names in XML."""
