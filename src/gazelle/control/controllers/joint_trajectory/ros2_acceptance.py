"""Which trajectories a ROS 2 controller takes (``validate_trajectory_msg``)."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controllers.joint_trajectory.ros2_setup import Ros2Setup
from gazelle.control.interface_values import Array
from gazelle.control.trajectory.errors import ErrorCode, TrajectoryError
from gazelle.control.trajectory.splines import JointState
from gazelle.control.trajectory.waypoints import Waypoints, check_joints, read_waypoints

__all__ = ["accepted"]

_SECONDS = 1e-9
_EPSILON = float(np.finfo(np.float32).eps)


def accepted(message: Any, setup: Ros2Setup, now_ns: int, position: Array) -> Waypoints:
    """Read a trajectory; joints it does not have stay where they are told to be.

    Args:
        message: trajectory_msgs/JointTrajectory.
        setup: of the controller.
        now_ns: time of the last update.
        position: (N,) measured, for joints that are not commanded.

    Raises:
        TrajectoryError: it cannot be followed.
    """
    names = setup.joints.names
    places = check_joints(message.joint_names, names, allow_partial=setup.allow_partial_joints_goal)
    if not len(message.points):
        raise TrajectoryError(ErrorCode.INVALID_GOAL, "Empty trajectory received.")
    waypoints = read_waypoints(message, places)
    _check_end(waypoints, setup, now_ns)
    for number, state in enumerate(waypoints.states):
        _check_fields(state, number, setup)
    if len(places) == len(names):
        return waypoints
    return _completed(waypoints, len(names), _staying(setup, position))


def _check_end(waypoints: Waypoints, setup: Ros2Setup, now_ns: int) -> None:
    last = waypoints.states[-1].velocity
    if last is not None and not setup.allow_nonzero_velocity_at_trajectory_end:
        moving = np.flatnonzero(np.abs(last) > _EPSILON)
        if len(moving):
            name = setup.joints.names[int(waypoints.places[moving[0]])]
            text = f"Velocity of last trajectory point of joint {name} is not zero: "
            raise TrajectoryError(ErrorCode.INVALID_GOAL, f"{text}{last[moving[0]]:.15f}")
    end_ns = waypoints.stamp_ns + waypoints.times_ns[-1]
    if waypoints.stamp_ns and end_ns < now_ns:
        text = f"Received trajectory with non-zero start time ({waypoints.stamp_ns * _SECONDS:f}) "
        text += f"that ends in the past ({end_ns * _SECONDS:f}); it is {now_ns * _SECONDS:f} now"
        raise TrajectoryError(ErrorCode.OLD_HEADER_TIMESTAMP, text)


def _check_fields(state: JointState, number: int, setup: Ros2Setup) -> None:
    text = ""
    if state.effort is not None and not setup.has_effort:
        text = "Trajectories with effort fields are only supported for controllers using the "
        text += "'effort' command interface."
    elif not len(state.position):
        if not setup.allow_integration_in_goal_trajectories:
            text = f"point #{number} has no positions (allow_integration_in_goal_trajectories is "
            text += "false)"
        elif state.velocity is None and state.acceleration is None:
            text = "The given trajectory has no position, velocity, or acceleration points."
    if text:
        raise TrajectoryError(ErrorCode.INVALID_GOAL, text)


def _staying(setup: Ros2Setup, position: Array) -> Array:
    """Return where joints are told to be, or are when they are told nothing."""
    commanded = setup.output.commanded().get("position")
    if commanded is None or len(commanded) != len(position):
        return position
    return np.where(np.isfinite(commanded), commanded, position)


def _completed(waypoints: Waypoints, n_joints: int, staying: Array) -> Waypoints:
    def filled(values: Array | None, rest: Array) -> Array | None:
        if values is None or not len(values):
            return values
        result = rest.copy()
        result[waypoints.places] = values
        return result

    zero = np.zeros(n_joints)
    states = []
    for state in waypoints.states:
        position = filled(state.position, staying)
        states.append(
            JointState(
                state.position if position is None else position,
                filled(state.velocity, zero),
                filled(state.acceleration, zero),
                filled(state.effort, zero),
            )
        )
    places = np.arange(n_joints, dtype=np.intp)
    return Waypoints(places, waypoints.times_ns, tuple(states), waypoints.stamp_ns)
