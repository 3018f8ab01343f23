"""ROS 1's trajectories: segments that begin and end at their own times, spliced when replaced.

Behaviour: ``joint_trajectory_controller`` of ros_controllers (``initJointTrajectory``,
``TrajectoryInterface``, ``HoldTrajectoryBuilder``, ``StopTrajectoryBuilder``).

The part of the running trajectory before the new one's start is kept, a segment bridges from there
to the first waypoint that is still to come
(http://wiki.ros.org/joint_trajectory_controller/UnderstandingTrajectoryReplacement).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array, Indices
from gazelle.control.trajectory.splines import JointState, PieceSampler, quintic, stacked
from gazelle.control.trajectory.tolerances import Tolerances
from gazelle.control.trajectory.waypoints import (
    ErrorCode,
    TrajectoryError,
    Waypoints,
    turns_to_nearest,
)

__all__ = ["Segment", "SegmentTrajectory", "Splice", "Track", "hold", "ramp_down", "splice"]


_SECONDS = 1e-9


class Segment(NamedTuple):
    """One polynomial of a track.

    Attributes:
        start_ns: when it begins.
        end_ns: when it ends.
        duration_s: how long it lasts.
        coefficients: (6, 3 M), see `stacked`.
        from_start_s: ``time_from_start`` of the waypoint it begins with.
        is_of_goal: whether the goal that is executed owns it, so tolerances are checked.
        tolerances: those to check, None for none.
    """

    start_ns: int
    end_ns: int
    duration_s: float
    coefficients: Array
    from_start_s: float = 0.0
    is_of_goal: bool = False
    tolerances: Tolerances | None = None

    @classmethod
    def between(cls, start_ns: int, start: JointState, end_ns: int, end: JointState) -> Segment:
        """Return the segment from one waypoint to another."""
        duration_s = (end_ns - start_ns) * _SECONDS
        return cls(start_ns, end_ns, duration_s, stacked(quintic(start, end, duration_s)))


@dataclass(slots=True)
class Track:
    """The segments of joints that move together.

    Attributes:
        indices: (M,) indices of the joints in the controller.
        segments: in order of time; the last one holds for ever.
        cursor: which segment the last `sample` was in.
        state: (3, M) of the last `sample`.
    """

    indices: Indices
    segments: list[Segment]
    cursor: int = 0
    state: Array = field(init=False)
    _starts_ns: list[int] = field(init=False)
    _sampler: PieceSampler = field(init=False)
    _rest: float = field(init=False, default=-1.0)

    def __post_init__(self) -> None:
        self._starts_ns = [segment.start_ns for segment in self.segments]
        self._sampler = PieceSampler(len(self.indices))
        self.state = self._sampler.state

    def index_at(self, time_ns: int) -> int:
        """Return which segment is active at a time; 0 before the first one."""
        return max(bisect_right(self._starts_ns, time_ns) - 1, 0)

    def sample(self, time_ns: int) -> bool:
        """Put the state at a time into `state`; outside a segment joints rest at its ends.

        Returns:
            False when nothing changed since the last call, because the joints rest.
        """
        starts, cursor = self._starts_ns, self.cursor
        if time_ns < starts[cursor] or (cursor + 1 < len(starts) and starts[cursor + 1] <= time_ns):
            self.cursor = cursor = self.index_at(time_ns)
            self._rest = -1.0
        segment = self.segments[cursor]
        time_s = (time_ns - segment.start_ns) * _SECONDS
        inside_s = min(max(time_s, 0.0), segment.duration_s)
        if inside_s == time_s:
            self._rest = -1.0
        elif inside_s == self._rest:
            return False
        self._sampler.sample(segment.coefficients, inside_s)
        if inside_s != time_s:
            self.state[1:] = 0.0
            self._rest = inside_s
        return True

    def state_at(self, time_ns: int) -> JointState:
        """Return the state at a time; the last sample stays."""
        segment = self.segments[self.index_at(time_ns)]
        time_s = (time_ns - segment.start_ns) * _SECONDS
        inside_s = min(max(time_s, 0.0), segment.duration_s)
        sampler = PieceSampler(len(self.indices))
        sampler.sample(segment.coefficients, inside_s)
        if inside_s != time_s:
            sampler.state[1:] = 0.0
        return JointState(*sampler.state)

    def joints(self, columns: Indices) -> Track:
        """Return the track of m of its joints, given by column (m,)."""
        wanted = np.concatenate([columns + k * len(self.indices) for k in range(3)])
        segments = [
            segment._replace(
                coefficients=segment.coefficients[:, wanted],
                tolerances=segment.tolerances and segment.tolerances.of_joints(columns),
            )
            for segment in self.segments
        ]
        return Track(self.indices[columns], segments)


@dataclass(slots=True)
class SegmentTrajectory:
    """What all joints of a controller are to do.

    Attributes:
        tracks: each joint is in one of them.
        state: (3, N), position, velocity and acceleration of the last `sample`.
    """

    tracks: list[Track]
    state: Array = field(init=False)

    def __post_init__(self) -> None:
        if len(self.tracks) == 1:
            self.state = self.tracks[0].state
        else:
            self.state = np.zeros((3, sum(len(track.indices) for track in self.tracks)))

    def sample(self, time_ns: int) -> bool:
        """Put the state at a time into `state`; False when nothing changed since the last call."""
        if len(self.tracks) == 1:
            return self.tracks[0].sample(time_ns)
        changed = False
        for track in self.tracks:
            if track.sample(time_ns):
                self.state[:, track.indices] = track.state
                changed = True
        return changed

    def state_at(self, time_ns: int) -> JointState:
        """Return the state at a time; the last sample stays."""
        both = np.zeros_like(self.state)
        for track in self.tracks:
            state = track.state_at(time_ns)
            both[0, track.indices] = state.position
            both[1, track.indices] = state.velocity
            both[2, track.indices] = state.acceleration
        return JointState(*both)

    @property
    def start_ns(self) -> int:
        """Time from which on all joints have something to do."""
        return max(track.segments[0].start_ns for track in self.tracks)

    def track_of(self, joint: int) -> tuple[Track, int]:
        """Return the track of a joint and its column there."""
        return next(found for found in self._columns() if found[0].indices[found[1]] == joint)

    def _columns(self) -> Iterator[tuple[Track, int]]:
        for track in self.tracks:
            for column in range(len(track.indices)):
                yield track, column


def hold(position: Array, time_ns: int, *, is_of_goal: bool = False) -> SegmentTrajectory:
    """Return a trajectory that stays at a place (N,), rad or m."""
    zero = np.zeros(len(position))
    state = JointState(position, zero, zero)
    return _one(Segment.between(time_ns, state, time_ns, state), is_of_goal)


def ramp_down(
    position: Array,
    velocity: Array,
    time_ns: int,
    duration_ns: int,
    *,
    is_of_goal: bool = False,
) -> SegmentTrajectory:
    """Return a trajectory that stops within some time (``stop_trajectory_duration``).

    It begins at positions (N,), rad or m, with velocities (N,), rad/s or m/s.

    It is the first half of the quintic that would come back with the opposite velocity.
    """
    zero = np.zeros(len(position))
    start = JointState(position, velocity, zero)
    back = JointState(position, -velocity, zero)
    twice = Segment.between(time_ns, start, time_ns + 2 * duration_ns, back)
    sampler = PieceSampler(len(position))
    sampler.sample(twice.coefficients, duration_ns * _SECONDS)
    end = JointState(*sampler.state)
    return _one(Segment.between(time_ns, start, time_ns + duration_ns, end), is_of_goal)


def _one(segment: Segment, is_of_goal: bool) -> SegmentTrajectory:
    n = segment.coefficients.shape[1] // 3
    track = Track(np.arange(n, dtype=np.intp), [segment._replace(is_of_goal=is_of_goal)])
    return SegmentTrajectory([track])


@dataclass(frozen=True, slots=True)
class Splice:
    """How to put waypoints into a running trajectory.

    Attributes:
        current: the running trajectory.
        last_ns: time of the last update.
        next_ns: time of the next update; earlier waypoints are dropped.
        wraps: (N,) which joints take the shorter way round.
        tolerances: of all joints when a goal is executed, None for a topic's trajectory.
    """

    current: SegmentTrajectory
    last_ns: int
    next_ns: int
    wraps: NDArray[np.bool_]
    tolerances: Tolerances | None = None


def splice(waypoints: Waypoints, how: Splice) -> tuple[SegmentTrajectory, str]:
    """Return the trajectory to follow from now on, and a remark on dropped points.

    Raises:
        TrajectoryError: all waypoints lie in the past, or one has no positions.
    """
    start_ns = waypoints.stamp_ns or how.next_ns
    first, remark = _first_to_come(waypoints, start_ns, how.next_ns)
    if any(len(state.position) == 0 for state in waypoints.states[first:]):
        text = "Quintic spline segment can't be constructed: Endpoint positions can't be empty."
        raise TrajectoryError(ErrorCode.INVALID_GOAL, text)
    splice_ns = max(start_ns, how.next_ns)
    tracks = [track for old in how.current.tracks for track in _untouched(old, waypoints, how)]
    if splice_ns == how.next_ns:
        columns = np.arange(len(waypoints.indices))
        tracks.append(_track(waypoints.joints(columns), [], how, first, start_ns))
    else:
        for old in how.current.tracks:
            columns = np.flatnonzero(np.isin(waypoints.indices, old.indices))
            if len(columns):
                some = waypoints.joints(columns)
                tracks.append(_track(some, _kept(old, some, how, splice_ns), how, first, start_ns))
    return SegmentTrajectory(tracks), remark


def _first_to_come(waypoints: Waypoints, start_ns: int, next_ns: int) -> tuple[int, str]:
    times_ns = waypoints.times_ns
    dropped = sum(start_ns + time_ns <= next_ns for time_ns in times_ns)
    if dropped == len(times_ns):
        late_s = (next_ns - start_ns - times_ns[-1]) * _SECONDS
        text = f"Dropping all {dropped} trajectory point(s), as they occur before the current time."
        text += f"\nLast point is {late_s:f}s in the past."
        raise TrajectoryError(ErrorCode.INVALID_GOAL, text)
    if dropped == 0 or (dropped == 1 and times_ns[0] == 0 and waypoints.stamp_ns == 0):
        return dropped, ""
    left_s = (start_ns + times_ns[dropped] - next_ns) * _SECONDS
    text = f"Dropping first {dropped} trajectory point(s) out of {len(times_ns)}, as they occur "
    text += f"before the current time.\nFirst valid point will be reached in {left_s:.3f}s."
    return dropped, text


def _untouched(old: Track, waypoints: Waypoints, how: Splice) -> list[Track]:
    """Return what joints do that the new trajectory does not speak of: as before."""
    columns = np.flatnonzero(~np.isin(old.indices, waypoints.indices))
    if not len(columns):
        return []
    track = old.joints(columns)
    kept = track.segments[track.index_at(how.last_ns) :]
    active = track.index_at(how.next_ns) - track.index_at(how.last_ns)
    of_goal = how.tolerances is not None
    segments = [
        segment._replace(is_of_goal=of_goal and index >= active)
        for index, segment in enumerate(kept)
    ]
    return [Track(track.indices, segments)]


def _kept(old: Track, waypoints: Waypoints, how: Splice, splice_ns: int) -> list[Segment]:
    """Return the segments that still run before the new trajectory begins."""
    columns = np.flatnonzero(np.isin(old.indices, waypoints.indices))
    track = old.joints(columns)
    kept = track.segments[track.index_at(how.last_ns) : track.index_at(splice_ns) + 1]
    return [segment._replace(is_of_goal=False) for segment in kept]


def _track(
    waypoints: Waypoints, kept: list[Segment], how: Splice, first: int, start_ns: int
) -> Track:
    indices = waypoints.indices
    splice_ns = max(start_ns, how.next_ns)
    last = _of(how.current.state_at(splice_ns), indices)
    states = waypoints.states[first:]
    offset = turns_to_nearest(last.position, states[0].position, how.wraps[indices])
    moved = [
        JointState(state.position + offset, state.velocity, state.acceleration) for state in states
    ]
    times_ns = [start_ns + time_ns for time_ns in waypoints.times_ns[first:]]
    tolerances = None if how.tolerances is None else how.tolerances.of_joints(indices)
    segments = [Segment.between(splice_ns, last, times_ns[0], moved[0])]
    for index in range(len(moved) - 1):
        segment = Segment.between(
            times_ns[index], moved[index], times_ns[index + 1], moved[index + 1]
        )
        from_start_s = waypoints.times_ns[first + index] * _SECONDS
        segments.append(segment._replace(from_start_s=from_start_s))
    new = [
        segment._replace(is_of_goal=tolerances is not None, tolerances=tolerances)
        for segment in segments
    ]
    return Track(indices, kept + new)


def _of(state: JointState, indices: Indices) -> JointState:
    def some(values: Array | None) -> Array | None:
        return None if values is None else values[indices]

    return JointState(state.position[indices], some(state.velocity), some(state.acceleration))
