"""The goal that a controller's action gets of a trajectory, and what its end means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from gazelle.graph.actions import ClientGoal
from gazelle.interfaces import action_type, message_type
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.simple_controller_manager import ControllerKind, ControllerSpec

__all__ = ["GoalEnd", "controller_goal", "goal_end", "part_of"]

_CODES = (
    *("INVALID_GOAL", "INVALID_JOINTS", "OLD_HEADER_TIMESTAMP"),
    *("PATH_TOLERANCE_VIOLATED", "GOAL_TOLERANCE_VIOLATED"),
)


@dataclass(frozen=True, slots=True)
class GoalEnd:
    """How a controller's goal ended.

    Attributes:
        is_good: it counts as done.
        why: what the controller says, empty when it is done.
    """

    is_good: bool
    why: str = ""


def part_of(trajectory: Any, spec: ControllerSpec) -> Any:
    """Return the ``JointTrajectory`` of a controller's own joints, in the trajectory's order."""
    places = [i for i, name in enumerate(trajectory.joint_names) if name in spec.joints]
    part = message_type("trajectory_msgs/msg/JointTrajectory")(
        joint_names=[trajectory.joint_names[i] for i in places]
    )
    part.header = trajectory.header
    for point in trajectory.points:
        row = message_type("trajectory_msgs/msg/JointTrajectoryPoint")()
        row.time_from_start = point.time_from_start
        for field in ("positions", "velocities", "accelerations", "effort"):
            values = getattr(point, field)
            if len(values):
                setattr(row, field, [float(values[i]) for i in places])
        part.points.append(row)
    return part


def controller_goal(part: Any, spec: ControllerSpec) -> Any:
    """Return a goal, in ROS 2's form, which clients turn into their own.

    Raises:
        MoveGroupError: a gripper's trajectory does not say where it shall go.
    """
    if spec.kind is ControllerKind.FOLLOW_JOINT_TRAJECTORY:
        return action_type(spec.kind.action_type).Goal(trajectory=part)
    places = _gripper_places(part, spec)
    last = part.points[-1] if part.points else None
    if last is None or len(last.positions) <= max(places):
        text = f"controller '{spec.name}' needs a point with a position of '{spec.command_joint}'"
        raise MoveGroupError(ErrorCode.CONTROL_FAILED, text)
    position = sum(float(last.positions[i]) for i in places)
    efforts = [float(last.effort[i]) for i in places if i < len(last.effort)]
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
    return GoalEnd(is_good=False, why=f"controller '{spec.name}' {_story(goal, status)}")


def _story(goal: ClientGoal, status: str) -> str:
    if status in {"REJECTED", "RECALLED"}:
        return f"rejected the goal{_said(goal.text)}"
    if status in {"UNKNOWN", "LOST"}:
        return f"is gone{_said(goal.text)}"
    result = goal.result
    code = getattr(result, "error_code", None)
    if code is not None:
        name = _code_name(result, int(code))
        return f"failed with error {name}{_said(getattr(result, 'error_string', '') or goal.text)}"
    if getattr(result, "stalled", False):
        text = f"stalled at {result.position:.4g}" if hasattr(result, "position") else "stalled"
        return f"{text}; allow_failure: true takes that as done, as with something in the gripper"
    return f"ended with {status}{_said(goal.text)}"


def _code_name(result: Any, code: int) -> str:
    return next((name for name in _CODES if getattr(result, name, None) == code), str(code))


def _said(text: str) -> str:
    return f": {text}" if text else ""


def _gripper_places(part: Any, spec: ControllerSpec) -> list[int]:
    wanted = spec.joints if spec.is_parallel else (spec.command_joint,)
    found = [i for i, name in enumerate(part.joint_names) if name in wanted]
    return found or [0]
