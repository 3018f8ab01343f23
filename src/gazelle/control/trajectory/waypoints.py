"""Reads trajectory_msgs/JointTrajectory into arrays in the controller's order of joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array, Indices
from gazelle.control.trajectory.splines import JointState
from gazelle.interfaces.stamps import ns_of

__all__ = [
    "ErrorCode",
    "TrajectoryError",
    "Waypoints",
    "check_joints",
    "read_waypoints",
    "shortest_way",
    "turns_to_nearest",
    "wrap_in_place",
]


class ErrorCode(IntEnum):
    """Values of ``error_code`` in a result of FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


class TrajectoryError(ValueError):
    """A trajectory cannot be executed; the message says why.

    Attributes:
        code: what the action's result has to say.
    """

    def __init__(self, code: ErrorCode, text: str) -> None:
        super().__init__(text)
        self.code = code


_TURN = 2.0 * math.pi

_SINGULAR_RAD = 1e-9


def shortest_way(start_rad: Array, end_rad: Array) -> Array:
    """Return the ways from angles (N,) to others in (-π, π] (``shortest_angular_distance``)."""
    way: Array = end_rad - start_rad
    wrap_in_place(way, np.ones(way.shape, dtype=np.bool_))
    return way


def wrap_in_place(way: Array, is_angle: NDArray[np.bool_]) -> None:
    """Bring those differences, (N,), rad, that are angles, (N,), into (-π, π]."""
    far = is_angle & (np.abs(way) > math.pi)
    if far.any():
        way[far] = math.pi - np.mod(math.pi - way[far], _TURN)


def turns_to_nearest(from_rad: Array, to_rad: Array, wraps: NDArray[np.bool_]) -> Array:
    """Return what to add to `to_rad` so that joints that wrap take the shorter way; whole turns.

    It and all arguments are (N,).

    A way of half a turn keeps its sign, as ``wraparoundJointOffset`` of
    joint_trajectory_controller has it.
    """
    way = shortest_way(from_rad, to_rad)
    half = np.abs(np.abs(way) - math.pi) < _SINGULAR_RAD
    way[half] = np.where(to_rad > from_rad, np.abs(way), -np.abs(way))[half]
    offsets: Array = np.where(wraps, from_rad + way - to_rad, 0.0)
    return offsets


_NANO = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Waypoints:
    """A trajectory of some of a controller's joints.

    Attributes:
        indices: (M,) indices of the joints in the controller, rising.
        times_ns: when each waypoint is to be reached, since the start.
        states: the waypoints, columns in the order of `indices`.
        stamp_ns: when it starts; 0 means now.
    """

    indices: Indices
    times_ns: tuple[int, ...]
    states: tuple[JointState, ...]
    stamp_ns: int

    def joints(self, columns: Indices) -> Waypoints:
        """Return the trajectory of m of its joints, given by column (m,)."""
        states = tuple(_columns(state, columns) for state in self.states)
        return Waypoints(self.indices[columns], self.times_ns, states, self.stamp_ns)


def check_joints(names: Sequence[str], joints: Sequence[str], *, allow_partial: bool) -> Indices:
    """Return the indices, (n,), of a message's n joints in the controller.

    Raises:
        TrajectoryError: joints are missing, unknown or there twice.
    """
    text = ""
    unknown = [name for name in names if name not in joints]
    missing = [name for name in joints if name not in names]
    if unknown:
        text = f"; '{unknown[0]}' is none of {', '.join(joints)}"
    elif not names:
        text = "; there are no joint names"
    elif len(set(names)) < len(names):
        text = "; a joint is there twice"
    elif missing and not allow_partial:
        text = f"; '{missing[0]}' is missing (allow_partial_joints_goal is false)"
    if text:
        text = f"Joints on incoming goal don't match the controller joints{text}"
        raise TrajectoryError(ErrorCode.INVALID_JOINTS, text)
    return np.array([joints.index(name) for name in names], dtype=np.intp)


def read_waypoints(trajectory: Any, indices: Indices) -> Waypoints:
    """Read a trajectory message whose joints were checked.

    Args:
        trajectory: trajectory_msgs/JointTrajectory with ROS 2's fields.
        indices: (n,), those of its n joints in the controller.

    Raises:
        TrajectoryError: a field has not one value for each joint, a value is not finite, or the
            points do not follow each other in time.
    """
    order = np.argsort(indices)
    states = tuple(
        _state(point, number, order, len(indices)) for number, point in enumerate(trajectory.points)
    )
    times_ns = tuple(ns_of(point.time_from_start) for point in trajectory.points)
    for number, (before, after) in enumerate(pairwise(times_ns)):
        if after <= before:
            text = "Trajectory message contains waypoints that are not strictly increasing in time."
            text += f" Time between points {number} and {number + 1} is not strictly increasing, it"
            text += f" is {before / _NANO:f} and {after / _NANO:f} respectively"
            raise TrajectoryError(ErrorCode.INVALID_GOAL, text)
    return Waypoints(indices[order], times_ns, states, ns_of(trajectory.header.stamp))


def _state(point: Any, number: int, order: Indices, n_joints: int) -> JointState:
    fields: list[Array | None] = []
    for name in ("positions", "velocities", "accelerations", "effort"):
        values = np.asarray(getattr(point, name), dtype=np.float64)
        if len(values) not in (0, n_joints):
            text = "Size mismatch in trajectory point position, velocity or acceleration data. "
            text += f"Mismatch between joint_names size ({n_joints}) and {name} ({len(values)}) "
            raise TrajectoryError(ErrorCode.INVALID_GOAL, f"{text}at point #{number}.")
        if not np.isfinite(values).all():
            text = f"{name} of point #{number} are not finite numbers: {values.tolist()}"
            raise TrajectoryError(ErrorCode.INVALID_GOAL, text)
        fields.append(values[order] if len(values) else None)
    position = fields[0] if fields[0] is not None else np.empty(0)
    return JointState(position, *fields[1:])


def _columns(state: JointState, columns: Indices) -> JointState:
    return JointState(
        state.position[columns] if len(state.position) else state.position,
        *(
            None if values is None else values[columns]
            for values in (state.velocity, state.acceleration, state.effort)
        ),
    )
