"""``moveit_msgs/RobotState`` and ``RobotTrajectory`` of a robot's positions."""

from __future__ import annotations

from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import quat_xyzw_from_yaw, yaw_from_quat_xyzw
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import quat_xyzw_of, set_quat_xyzw
from gazelle.interfaces.stamps import set_stamp
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import JointKind, RobotJoint, RobotModel
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.error_codes import MoveGroupError

__all__ = [
    "joint_state_message",
    "joint_trajectory",
    "positions_of",
    "robot_state_message",
    "robot_trajectory",
]


_NANO = 1_000_000_000


def robot_trajectory(trajectory: Trajectory | None, *, frame: str) -> Any:
    """Return the message; an empty one for None.

    Args:
        trajectory: positions with times.
        frame: planning frame.
    """
    message: Any = message_type("moveit_msgs/msg/RobotTrajectory")()
    if trajectory is not None:
        message.joint_trajectory = joint_trajectory(trajectory)
    message.joint_trajectory.header.frame_id = frame
    return message


def joint_trajectory(trajectory: Trajectory) -> Any:
    """Return a ``JointTrajectory`` with positions, velocities and accelerations."""
    made: Any = message_type("trajectory_msgs/msg/JointTrajectory")(
        joint_names=list(trajectory.names)
    )
    point = message_type("trajectory_msgs/msg/JointTrajectoryPoint")
    rows = zip(
        trajectory.times_s.tolist(),
        trajectory.positions.tolist(),
        trajectory.velocities.tolist(),
        trajectory.accelerations.tolist(),
        strict=True,
    )
    for time_s, positions, velocities, accelerations in rows:
        row: Any = point(positions=positions, velocities=velocities, accelerations=accelerations)
        set_stamp(row.time_from_start, round(time_s * _NANO))
        made.points.append(row)
    return made


def positions_of(message: Any, model: RobotModel, base: FloatArray) -> FloatArray:
    """Return a robot's positions with those of a message in place of `base`'s.

    As in MoveIt, what a message does not tell stays, also where ``is_diff`` is false.

    Args:
        message: a ``RobotState``; its attached objects are not looked at.
        model: the robot.
        base: all positions, rad and m, (variables,); so are those that are returned.

    Raises:
        MoveGroupError: the message names joints that the robot has not, or too few positions.
    """
    joints = message.joint_state
    if len(joints.name) != len(joints.position):
        text = f"the robot state has {len(joints.name)} joint names and {len(joints.position)} "
        raise MoveGroupError(ErrorCode.INVALID_ROBOT_STATE, text + "positions")
    values = dict(zip(joints.name, map(float, joints.position), strict=True))
    several = message.multi_dof_joint_state
    by_name = {joint.name: joint for joint in model.joints}
    for name, transform in zip(several.joint_names, several.transforms, strict=False):
        if name in by_name:
            values.update(_several(by_name[name], transform))
        else:
            values[name] = 0.0
    unknown = [name for name in values if name not in model.variables]
    if unknown:
        hint = did_you_mean(unknown[0], model.variables)
        text = f"the robot state has joints that the robot has not: {', '.join(unknown)}; {hint}"
        raise MoveGroupError(ErrorCode.INVALID_ROBOT_STATE, text)
    return model.positions(values, base)


def robot_state_message(
    model: RobotModel, positions: FloatArray, *, frame: str, stamp_ns: int
) -> Any:
    """Return the message of a robot's positions, mimicking joints included.

    Args:
        model: the robot.
        positions: of all its variables, rad and m, (variables,).
        frame: planning frame.
        stamp_ns: when the robot is there.
    """
    message: Any = message_type("moveit_msgs/msg/RobotState")()
    message.joint_state = joint_state_message(model, positions, frame=frame, stamp_ns=stamp_ns)
    several = message.multi_dof_joint_state
    several.header = message.joint_state.header
    for joint in model.joints:
        if joint.kind in (JointKind.PLANAR, JointKind.FLOATING):
            several.joint_names.append(joint.name)
            several.transforms.append(_transform(joint, positions))
    return message


def joint_state_message(
    model: RobotModel, positions: FloatArray, *, frame: str, stamp_ns: int
) -> Any:
    """Return a ``JointState`` of all joints with one variable.

    Args:
        model: the robot.
        positions: of all its variables, rad and m, (variables,).
        frame: planning frame.
        stamp_ns: when the robot is there.
    """
    message: Any = message_type("sensor_msgs/msg/JointState")()
    message.header.frame_id = frame
    set_stamp(message.header.stamp, stamp_ns)
    single = [joint for joint in model.joints if len(joint.variables) == 1]
    message.name = [joint.name for joint in single]
    message.position = [float(positions[joint.first]) for joint in single]
    return message


def _several(joint: RobotJoint, transform: Any) -> dict[str, float]:
    shift, turn = transform.translation, transform.rotation
    if joint.kind is JointKind.PLANAR:
        yaw = yaw_from_quat_xyzw(quat_xyzw_of(turn))
        return dict(zip(joint.variables, (shift.x, shift.y, yaw), strict=True))
    values = (shift.x, shift.y, shift.z, turn.x, turn.y, turn.z, turn.w)
    return dict(zip(joint.variables, map(float, values), strict=False))


def _transform(joint: RobotJoint, positions: FloatArray) -> Any:
    values = positions[joint.first : joint.first + len(joint.variables)].tolist()
    message: Any = message_type("geometry_msgs/msg/Transform")()
    shift, turn = message.translation, message.rotation
    if joint.kind is JointKind.PLANAR:
        shift.x, shift.y = values[:2]
        set_quat_xyzw(turn, quat_xyzw_from_yaw(values[2]))
    else:
        shift.x, shift.y, shift.z, turn.x, turn.y, turn.z, turn.w = values
    return message
