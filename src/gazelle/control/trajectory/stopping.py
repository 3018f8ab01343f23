"""Trajectories of ROS 2 that stop: at once, or with the decelerations a user allows."""

from __future__ import annotations

import math

import numpy as np

from gazelle.control.interface_values import Array
from gazelle.control.trajectory.splines import JointState
from gazelle.control.trajectory.waypoints import Waypoints

__all__ = ["decelerating", "holding"]

_NANO = 1_000_000_000


def holding(point: JointState) -> Waypoints:
    """Return the waypoint to stay at from now on."""
    places = np.arange(len(point.position), dtype=np.intp)
    return Waypoints(places, (0,), (point,), 0)


def decelerating(
    position: Array, velocity: Array, deceleration: Array, period_ns: int
) -> Waypoints:
    """Return the way until all joints stand, each with constant deceleration.

    One waypoint for each control period, as ``decelerate_to_hold_position`` of ros2_controllers
    has it.

    Args:
        position: (N,) now.
        velocity: (N,) now.
        deceleration: (N,) positive, per second squared.
        period_ns: of control.
    """
    direction = np.where(velocity >= 0.0, 1.0, -1.0)
    stop_s = np.abs(velocity) / deceleration
    stop_place = position + direction * velocity**2 / (2.0 * deceleration)
    count = math.ceil(float(stop_s.max()) * _NANO / period_ns) + 1
    times_s = np.arange(count)[:, None] * (period_ns / _NANO)
    moves = times_s < stop_s
    slowing = direction * deceleration
    positions = position + velocity * times_s - 0.5 * slowing * times_s**2
    states = tuple(
        JointState(p, v, a)
        for p, v, a in zip(
            np.where(moves, positions, stop_place),
            np.where(moves, velocity - slowing * times_s, 0.0),
            np.where(moves, -slowing, 0.0),
            strict=True,
        )
    )
    places = np.arange(len(position), dtype=np.intp)
    return Waypoints(places, tuple(k * period_ns for k in range(count)), states, 0)
