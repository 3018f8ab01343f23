"""Polynomials between two waypoints, of the order that the waypoints' fields ask for.

Formulas: Hermite interpolation in the form of ``trajectory_interface::QuinticSplineSegment``
(ROS 1) and ``Trajectory::interpolate_between_points`` (ROS 2), which are the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.control.interface_values import Array

__all__ = ["JointState", "PieceSampler", "quintic", "stacked"]

_ORDER = 6


@dataclass(frozen=True, slots=True)
class JointState:
    """A waypoint of some joints: what a spline begins or ends with.

    Attributes:
        position: (N,), rad or m.
        velocity: (N,) per second, None when the waypoint has none.
        acceleration: (N,) per second squared, None when the waypoint has none.
        effort: (N,), N·m or N, None when the waypoint has none.
    """

    position: Array
    velocity: Array | None = None
    acceleration: Array | None = None
    effort: Array | None = None


def quintic(start: JointState, end: JointState, duration_s: float) -> Array:
    """Return the coefficients (6, N) of the polynomial from one waypoint to another.

    It is linear when one of them has no velocities, cubic when one has no accelerations, quintic
    otherwise. Without duration it has the start's value and slope.
    """
    coefficients = np.zeros((_ORDER, len(start.position)))
    p0, p1, T = start.position, end.position, duration_s
    coefficients[0] = p0
    if start.velocity is None or end.velocity is None:
        if T != 0.0:
            coefficients[1] = (p1 - p0) / T
        return coefficients
    v0, v1 = start.velocity, end.velocity
    coefficients[1] = v0
    if start.acceleration is None or end.acceleration is None:
        if T != 0.0:
            coefficients[2] = (3.0 * (p1 - p0) - (2.0 * v0 + v1) * T) / T**2
            coefficients[3] = (2.0 * (p0 - p1) + (v0 + v1) * T) / T**3
        return coefficients
    a0, a1 = start.acceleration, end.acceleration
    coefficients[2] = 0.5 * a0
    if T != 0.0:
        way, T2 = p1 - p0, T * T
        coefficients[3] = (20 * way - (3 * a0 - a1) * T2 - (12 * v0 + 8 * v1) * T) / (2 * T**3)
        coefficients[4] = (-30 * way + (3 * a0 - 2 * a1) * T2 + (16 * v0 + 14 * v1) * T) / (
            2 * T**4
        )
        coefficients[5] = (12 * way - (a0 - a1) * T2 - 6 * (v0 + v1) * T) / (2 * T**5)
    return coefficients


def stacked(coefficients: Array) -> Array:
    """Return the coefficients (6, 3 N) of positions, velocities and accelerations side by side."""
    n = coefficients.shape[1]
    both = np.zeros((_ORDER, 3 * n))
    powers = np.arange(1.0, _ORDER)[:, None]
    both[:, :n] = coefficients
    both[:-1, n : 2 * n] = coefficients[1:] * powers
    both[:-1, 2 * n :] = both[1:, n : 2 * n] * powers
    return both


class PieceSampler:
    """Evaluates stacked polynomials without allocating anything.

    Attributes:
        state: (3, N), position, velocity and acceleration of the last `sample`.
    """

    def __init__(self, n_joints: int) -> None:
        self.state: Array = np.zeros((3, n_joints))
        self._flat = self.state.reshape(-1)
        self._powers = np.ones(_ORDER)

    def sample(self, pieces: Array, time_s: float) -> None:
        """Evaluate one segment (6, 3 N) at a time since its start."""
        square = time_s * time_s
        cube = square * time_s
        self._powers[1:] = (time_s, square, cube, square * square, square * cube)
        np.dot(self._powers, pieces, out=self._flat)
