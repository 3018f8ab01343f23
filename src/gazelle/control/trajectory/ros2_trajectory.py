"""ROS 2's trajectories: one list of waypoints, replaced as a whole by a new one or a stop.

Behaviour: ``joint_trajectory_controller::Trajectory`` of ros2_controllers.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array
from gazelle.control.trajectory.splines import JointState, PieceSampler, quintic, stacked
from gazelle.control.trajectory.waypoints import Waypoints, turns_to_nearest

__all__ = ["Interpolation", "PointTrajectory", "decelerating", "holding"]


_NANO = 1_000_000_000


def holding(point: JointState) -> Waypoints:
    """Return the waypoint to stay at from now on."""
    indices = np.arange(len(point.position), dtype=np.intp)
    return Waypoints(indices, (0,), (point,), 0)


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
    indices = np.arange(len(position), dtype=np.intp)
    return Waypoints(indices, tuple(k * period_ns for k in range(count)), states, 0)


_SECONDS = 1e-9


class Interpolation(Enum):
    """Values of the parameter ``interpolation_method``."""

    NONE = "none"
    SPLINES = "splines"


@dataclass(slots=True)
class PointTrajectory:
    """Waypoints of all joints of a controller, and what was before them.

    It begins with the first `sample` unless its stamp says when; from the state at that moment a
    spline leads to the first waypoint. After the last waypoint its state is repeated, with its
    velocities.

    Attributes:
        waypoints: of all joints.
        interpolation: between waypoints.
        is_begun: whether `begin` was called.
        start_ns: when it starts, known once it is begun.
        state: (3, N), position, velocity and acceleration of the last `sample`.
        effort: (N,) of the last `sample`, zeros without efforts.
        has_effort: whether a waypoint has efforts.
    """

    waypoints: Waypoints
    interpolation: Interpolation = Interpolation.SPLINES
    is_begun: bool = False
    start_ns: int = 0
    state: Array = field(init=False)
    effort: Array = field(init=False)
    has_effort: bool = field(init=False)
    _times_ns: list[int] = field(init=False, default_factory=list)
    _points: list[JointState] = field(init=False, default_factory=list)
    _pieces: list[Array] = field(init=False, default_factory=list)
    _sampler: PieceSampler = field(init=False)
    _is_at_end: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        n = len(self.waypoints.indices)
        self._sampler = PieceSampler(n)
        self.state = self._sampler.state
        self.effort = np.zeros(n)
        self.has_effort = any(state.effort is not None for state in self.waypoints.states)

    def begin(self, time_ns: int, before: JointState, wraps: NDArray[np.bool_]) -> None:
        """Fix the start, from the state before the first waypoint.

        Args:
            time_ns: now.
            before: where the joints are, or what they were last told.
            wraps: (N,) which joints take the shorter way round; `before` is moved by whole turns.
        """
        self.is_begun = True
        self.start_ns = self.waypoints.stamp_ns or time_ns
        first = self.waypoints.states[0]
        before = _with_orders_of(before, first)
        if len(first.position):
            moved = before.position - turns_to_nearest(before.position, first.position, wraps)
            before = replace(before, position=moved)
        self._times_ns = [time_ns, *(self.start_ns + t for t in self.waypoints.times_ns)]
        self._points = [before]
        for state, start_ns, end_ns in zip(
            self.waypoints.states, self._times_ns, self._times_ns[1:], strict=False
        ):
            duration_s = (end_ns - start_ns) * _SECONDS
            self._points.append(_deduced(self._points[-1], state, duration_s))
        self._pieces = [
            stacked(quintic(start, end, max(end_ns - start_ns, 0) * _SECONDS))
            for start, end, start_ns, end_ns in zip(
                self._points,
                self._points[1:],
                self._times_ns,
                self._times_ns[1:],
                strict=False,
            )
        ]

    @property
    def end_ns(self) -> int:
        """When the last waypoint is to be reached; known once it is begun."""
        return self._times_ns[-1]

    @property
    def last_point(self) -> JointState:
        """The last waypoint, with a position in any case; known once it is begun."""
        return self._points[-1]

    def segment_at(self, time_ns: int) -> int:
        """Return how many waypoints were reached; all of them at the end."""
        return max(bisect_right(self._times_ns, time_ns, lo=1) - 1, 0)

    def sample(self, time_ns: int) -> bool:
        """Put the state at a time into `state` and `effort`.

        Returns:
            False when nothing changed since the last call, because the last waypoint is reached.
        """
        index = self.segment_at(time_ns)
        if index == len(self._pieces):
            if self._is_at_end:
                return False
            self._is_at_end = True
            self._take(self._points[-1])
            return True
        self._is_at_end = False
        if self.interpolation is Interpolation.NONE:
            self._take(self._points[0 if index == 0 else index + 1])
            return True
        since_s = (time_ns - self._times_ns[index]) * _SECONDS
        self._sampler.sample(self._pieces[index], max(since_s, 0.0))
        if self.has_effort:
            self._take_effort(index, since_s)
        return True

    def state_at(self, time_ns: int) -> JointState | None:
        """Return the state at a time, None outside the trajectory; the last sample stays."""
        if not self.is_begun or not self._times_ns[0] <= time_ns < self._times_ns[-1]:
            return None
        other = PointTrajectory(self.waypoints, self.interpolation, True, self.start_ns)
        other._times_ns, other._points, other._pieces = self._times_ns, self._points, self._pieces
        other.sample(time_ns)
        position, velocity, acceleration = other.state
        return JointState(position, velocity, acceleration, other.effort)

    def _take(self, point: JointState) -> None:
        self.state[0] = point.position
        self.state[1] = 0.0 if point.velocity is None else point.velocity
        self.state[2] = 0.0 if point.acceleration is None else point.acceleration
        self.effort[:] = 0.0 if point.effort is None else point.effort

    def _take_effort(self, index: int, since_s: float) -> None:
        start, end = self._points[index], self._points[index + 1]
        duration_s = (self._times_ns[index + 1] - self._times_ns[index]) * _SECONDS
        begin = np.zeros_like(self.effort) if start.effort is None else start.effort
        finish = np.zeros_like(self.effort) if end.effort is None else end.effort
        self.effort[:] = begin + (finish - begin) * (since_s / duration_s)


def _with_orders_of(before: JointState, first: JointState) -> JointState:
    """Return the state with zeros for what only the first waypoint has.

    Otherwise the way to it would be a spline of lower order than the rest.
    """
    zero = np.zeros(len(before.position))
    if before.velocity is None and first.velocity is not None:
        before = replace(before, velocity=zero)
    if before.acceleration is None and first.acceleration is not None:
        before = replace(before, acceleration=zero)
    return before


def _deduced(before: JointState, point: JointState, duration_s: float) -> JointState:
    """Return a waypoint with positions integrated by the trapezoidal rule when it has none."""
    if len(point.position):
        return point
    zero = np.zeros(len(before.position))
    slope = zero if before.velocity is None else before.velocity
    velocity = point.velocity
    if velocity is None:
        old = zero if before.acceleration is None else before.acceleration
        new = zero if point.acceleration is None else point.acceleration
        velocity = slope + (old + new) * (0.5 * duration_s)
    position = before.position + (slope + velocity) * (0.5 * duration_s)
    return replace(point, position=position, velocity=velocity)
