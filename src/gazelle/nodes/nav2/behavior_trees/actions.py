"""Nav2's leaves that send goals and call services."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from gazelle.nodes.nav2.behavior_trees.ros_interface import Call
from gazelle.nodes.nav2.behavior_trees.tree_node import Leaf, Ports, Status, TreeNode

__all__ = ["ACTIONS"]

_S = Status
_ERRORS = {"error_code_id": "error_code", "error_code": "error_code", "error_msg": "error_msg"}


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
"""Leaves that ask others, by their names in XML."""
