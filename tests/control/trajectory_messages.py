"""Builds trajectory messages for tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gazelle.interfaces import message_type

__all__ = ["duration", "goal", "point", "trajectory"]

_NANO = 1_000_000_000


def duration(seconds: float, name: str = "builtin_interfaces/Duration") -> Any:
    """Return a duration or a time."""
    whole, rest = divmod(round(seconds * _NANO), _NANO)
    return message_type(name)(sec=whole, nanosec=rest)


def point(
    time_s: float,
    positions: Sequence[float] = (),
    velocities: Sequence[float] = (),
    accelerations: Sequence[float] = (),
    effort: Sequence[float] = (),
) -> Any:
    """Return a waypoint."""
    return message_type("trajectory_msgs/JointTrajectoryPoint")(
        positions=list(positions),
        velocities=list(velocities),
        accelerations=list(accelerations),
        effort=list(effort),
        time_from_start=duration(time_s),
    )


def trajectory(names: Sequence[str], *points: Any, stamp_s: float = 0.0) -> Any:
    """Return a trajectory."""
    message = message_type("trajectory_msgs/JointTrajectory")(
        joint_names=list(names), points=list(points)
    )
    message.header.stamp = duration(stamp_s, "builtin_interfaces/Time")
    return message


def goal(
    message: Any,
    *,
    path: Mapping[str, Sequence[float]] | None = None,
    end: Mapping[str, Sequence[float]] | None = None,
    goal_time_s: float = 0.0,
) -> Any:
    """Return a goal of FollowJointTrajectory; tolerances as {joint: (position, velocity, …)}."""
    request = message_type("control_msgs/FollowJointTrajectoryGoal")(trajectory=message)
    request.path_tolerance = _tolerances(path or {})
    request.goal_tolerance = _tolerances(end or {})
    request.goal_time_tolerance.sec, request.goal_time_tolerance.nanosec = divmod(
        round(goal_time_s * _NANO), _NANO
    )
    return request


def _tolerances(rows: Mapping[str, Sequence[float]]) -> list[Any]:
    words = ("position", "velocity", "acceleration")
    return [
        message_type("control_msgs/JointTolerance")(
            name=name, **dict(zip(words, values, strict=False))
        )
        for name, values in rows.items()
    ]
