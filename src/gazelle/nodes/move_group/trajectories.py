"""``moveit_msgs/RobotTrajectory`` of planned trajectories."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp
from gazelle.motion.timing import Trajectory

__all__ = ["joint_trajectory", "robot_trajectory"]

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
