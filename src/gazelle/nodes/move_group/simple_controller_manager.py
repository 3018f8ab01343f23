"""Controllers as ``moveit_simple_controller_manager`` knows them: their choice and their goals.

ROS 2 has ``moveit_controllers.yaml`` with ``controller_names`` and a branch for each, ROS 1
``controllers.yaml`` with a ``controller_list``. Both say the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import combinations
from typing import Any

from gazelle.description.moveit import ControllerEntry, MoveItConfig
from gazelle.diagnostics import did_you_mean
from gazelle.graph.actions import ClientGoal
from gazelle.interfaces import action_type, message_type
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError

__all__ = [
    "FAKE_TYPES",
    "ControllerKind",
    "ControllerSpec",
    "GoalEnd",
    "choose_controllers",
    "controller_goal",
    "controller_specs",
    "fake_action",
    "goal_end",
    "part_of",
]


FAKE_TYPES = ("interpolate", "via points", "last point")
"""Types of ``moveit_fake_controller_manager``."""
_MANAGER = "moveit_simple_controller_manager"

_DEFAULT_NAMESPACES = {
    "FollowJointTrajectory": "follow_joint_trajectory",
    "GripperCommand": "gripper_cmd",
    "ParallelGripperCommand": "gripper_cmd",
}

_CODES = (
    *("INVALID_GOAL", "INVALID_JOINTS", "OLD_HEADER_TIMESTAMP"),
    *("PATH_TOLERANCE_VIOLATED", "GOAL_TOLERANCE_VIOLATED"),
)


class ControllerKind(Enum):
    """The actions that trajectories are sent by."""

    FOLLOW_JOINT_TRAJECTORY = "FollowJointTrajectory"
    GRIPPER_COMMAND = "GripperCommand"
    PARALLEL_GRIPPER_COMMAND = "ParallelGripperCommand"

    @property
    def action_type(self) -> str:
        """The action's type."""
        return f"control_msgs/{self.value}"


@dataclass(frozen=True, slots=True)
class ControllerSpec:
    """One controller that parts of trajectories are sent to.

    Attributes:
        name: as MoveIt calls it.
        action: name of its action, relative to the node's namespace.
        joints: what it moves.
        is_default: chosen before others that could do the same.
        command_joint: of a gripper, the joint whose position is sent.
        max_effort: of a gripper, N or N·m; where it is 0 the trajectory may say one.
        is_parallel: a gripper's two joints are sent as the sum of their positions.
        allow_failure: an aborted goal counts as done, as a gripper on an object has it.
        duration_scaling, goal_margin_s: of this controller alone, None for the general ones.
    """

    name: str
    kind: ControllerKind
    action: str
    joints: tuple[str, ...]
    is_default: bool = False
    command_joint: str = ""
    max_effort: float = 0.0
    is_parallel: bool = False
    allow_failure: bool = False
    duration_scaling: float | None = None
    goal_margin_s: float | None = None


@dataclass(frozen=True, slots=True)
class GoalEnd:
    """How a controller's goal ended.

    Attributes:
        is_good: it counts as done.
        why: what the controller says, empty when it is done.
    """

    is_good: bool
    why: str = ""


def controller_specs(config: MoveItConfig) -> tuple[ControllerSpec, ...]:
    """Return the controllers that trajectories can be sent to.

    Raises:
        MoveGroupError: one of them has a type that MoveIt does not know.
    """
    return tuple(_spec(entry, _row(config.parameters, entry.name)) for entry in config.controllers)


def fake_action(name: str) -> str:
    """Return the action of a fake controller, below the node."""
    return f"~{name}/follow_joint_trajectory"


def choose_controllers(
    specs: Sequence[ControllerSpec], joints: Iterable[str], names: Sequence[str] = ()
) -> tuple[ControllerSpec, ...]:
    """Return the fewest controllers that move all joints and no joint twice.

    Among equally many the ones marked default come first, then those with fewer other joints.

    Args:
        specs: the controllers there are.
        joints: what must be moved.
        names: only these may be used; all when empty.

    Raises:
        MoveGroupError: there is no such set, or a name is not known.
    """
    known = {spec.name: spec for spec in specs}
    for name in names:
        if name not in known:
            hint = did_you_mean(name, known)
            text = f"Controller '{name}' is not known. Known controllers: {_listed(known)}; {hint}"
            raise MoveGroupError(ErrorCode.CONTROL_FAILED, text)
    wanted = frozenset(joints)
    usable = [spec for spec in specs if not names or spec.name in names]
    usable = [spec for spec in usable if wanted.intersection(spec.joints)]
    for count in range(1, len(usable) + 1):
        fitting = [one for one in combinations(usable, count) if _fits(one, wanted)]
        if fitting:
            return min(fitting, key=_rank)
    raise MoveGroupError(ErrorCode.CONTROL_FAILED, _nobody(wanted, specs))


def part_of(trajectory: Any, spec: ControllerSpec) -> Any:
    """Return the ``JointTrajectory`` of a controller's own joints, in the trajectory's order."""
    indices = [i for i, name in enumerate(trajectory.joint_names) if name in spec.joints]
    part = message_type("trajectory_msgs/msg/JointTrajectory")(
        joint_names=[trajectory.joint_names[i] for i in indices]
    )
    part.header = trajectory.header
    for point in trajectory.points:
        row = message_type("trajectory_msgs/msg/JointTrajectoryPoint")()
        row.time_from_start = point.time_from_start
        for field in ("positions", "velocities", "accelerations", "effort"):
            values = getattr(point, field)
            if len(values):
                setattr(row, field, [float(values[i]) for i in indices])
        part.points.append(row)
    return part


def controller_goal(part: Any, spec: ControllerSpec) -> Any:
    """Return a goal, in ROS 2's form, which clients turn into their own.

    Raises:
        MoveGroupError: a gripper's trajectory does not say where it shall go.
    """
    if spec.kind is ControllerKind.FOLLOW_JOINT_TRAJECTORY:
        return action_type(spec.kind.action_type).Goal(trajectory=part)
    indices = _gripper_indices(part, spec)
    last = part.points[-1] if part.points else None
    if last is None or len(last.positions) <= max(indices):
        text = f"controller '{spec.name}' needs a point with a position of '{spec.command_joint}'"
        raise MoveGroupError(ErrorCode.CONTROL_FAILED, text)
    position = sum(float(last.positions[i]) for i in indices)
    efforts = [float(last.effort[i]) for i in indices if i < len(last.effort)]
    effort = efforts[-1] if efforts else spec.max_effort
    if spec.kind is ControllerKind.GRIPPER_COMMAND:
        return {"command": {"position": position, "max_effort": effort}}
    command: dict[str, Any] = {"name": [spec.joints[0]], "position": [position]}
    if effort:
        command["effort"] = [effort]
    return {"command": command}


def goal_end(goal: ClientGoal, spec: ControllerSpec) -> GoalEnd:
    """Return what a goal that is over means for the trajectory."""
    status = goal.status.name
    if status == "SUCCEEDED" or (spec.allow_failure and status == "ABORTED"):
        return GoalEnd(is_good=True)
    return GoalEnd(is_good=False, why=f"controller '{spec.name}' {_failure_text(goal, status)}")


def _fits(chosen: tuple[ControllerSpec, ...], wanted: frozenset[str]) -> bool:
    moved = [joint for spec in chosen for joint in spec.joints]
    return len(set(moved)) == len(moved) and wanted.issubset(moved)


def _rank(chosen: tuple[ControllerSpec, ...]) -> tuple[int, int]:
    return (-sum(spec.is_default for spec in chosen), sum(len(spec.joints) for spec in chosen))


def _nobody(wanted: frozenset[str], specs: Sequence[ControllerSpec]) -> str:
    rows = "".join(
        f"\n  controller '{spec.name}' controls joints: {' '.join(spec.joints)}" for spec in specs
    )
    served = {joint for spec in specs for joint in spec.joints}
    missing = ", ".join(sorted(wanted - served))
    about = f"; no controller has {missing}" if missing else ""
    return (
        "Unable to identify any set of controllers that can actuate the specified joints: "
        f"[ {' '.join(sorted(wanted))} ]{about}\nKnown controllers and their joints:"
        f"{rows or ' none'}"
    )


def _row(tree: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """Return what the parameters say of a controller, where ROS 1 or ROS 2 has it."""
    for branch in (tree, tree.get(_MANAGER)):
        if not isinstance(branch, Mapping):
            continue
        listed = branch.get("controller_list")
        for row in listed if isinstance(listed, list) else []:
            if isinstance(row, Mapping) and str(row.get("name", "")).strip("/") == name:
                return row
        found = branch.get(name)
        if isinstance(found, Mapping) and "controller_names" in branch:
            return found
    return {}


def _spec(entry: ControllerEntry, row: Mapping[str, Any]) -> ControllerSpec:
    if entry.type in FAKE_TYPES:
        follows = ControllerKind.FOLLOW_JOINT_TRAJECTORY
        return ControllerSpec(
            entry.name, follows, fake_action(entry.name), entry.joints, is_default=entry.default
        )
    kind = next((one for one in ControllerKind if one.value == entry.type), None)
    if kind is None:
        hint = did_you_mean(entry.type, [one.value for one in ControllerKind])
        text = f"Unknown controller type: '{entry.type}' of controller '{entry.name}'; {hint}"
        raise MoveGroupError(ErrorCode.CONTROL_FAILED, text)
    action = entry.action_ns.strip("/") or _DEFAULT_NAMESPACES[entry.type]
    first = entry.joints[0] if entry.joints else ""
    return ControllerSpec(
        name=entry.name,
        kind=kind,
        action=f"{entry.name}/{action}",
        joints=entry.joints,
        is_default=entry.default,
        command_joint=str(row.get("command_joint", first)),
        max_effort=_number(row.get("max_effort")) or 0.0,
        is_parallel=row.get("parallel") is True,
        allow_failure=row.get("allow_failure") is True,
        duration_scaling=_number(row.get("allowed_execution_duration_scaling")),
        goal_margin_s=_number(row.get("allowed_goal_duration_margin")),
    )


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) else None


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"'{name}'" for name in names) or "none"


def _failure_text(goal: ClientGoal, status: str) -> str:
    if status in {"REJECTED", "RECALLED"}:
        return f"rejected the goal{_suffix(goal.text)}"
    if status in {"UNKNOWN", "LOST"}:
        return f"is gone{_suffix(goal.text)}"
    result = goal.result
    code = getattr(result, "error_code", None)
    if code is not None:
        name = _code_name(result, int(code))
        return (
            f"failed with error {name}{_suffix(getattr(result, 'error_string', '') or goal.text)}"
        )
    if getattr(result, "stalled", False):
        text = f"stalled at {result.position:.4g}" if hasattr(result, "position") else "stalled"
        return f"{text}; allow_failure: true takes that as done, as with something in the gripper"
    return f"ended with {status}{_suffix(goal.text)}"


def _code_name(result: Any, code: int) -> str:
    return next((name for name in _CODES if getattr(result, name, None) == code), str(code))


def _suffix(text: str) -> str:
    return f": {text}" if text else ""


def _gripper_indices(part: Any, spec: ControllerSpec) -> list[int]:
    wanted = spec.joints if spec.is_parallel else (spec.command_joint,)
    found = [i for i, name in enumerate(part.joint_names) if name in wanted]
    return found or [0]
