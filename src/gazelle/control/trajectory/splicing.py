"""Puts a new trajectory into one that runs, as ROS 1 does it.

The part of the running trajectory before the new one's start is kept, a segment bridges from there
to the first waypoint that is still to come (``initJointTrajectory`` of ros_controllers,
http://wiki.ros.org/joint_trajectory_controller/UnderstandingTrajectoryReplacement).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array, Indices
from gazelle.control.trajectory.ros1_trajectory import Segment, SegmentTrajectory, Track
from gazelle.control.trajectory.splines import JointState
from gazelle.control.trajectory.tolerances import Tolerances
from gazelle.control.trajectory.waypoints import (
    ErrorCode,
    TrajectoryError,
    Waypoints,
    turns_to_nearest,
)

__all__ = ["Splice", "splice"]

_SECONDS = 1e-9


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
        columns = np.arange(len(waypoints.places))
        tracks.append(_track(waypoints.joints(columns), [], how, first, start_ns))
    else:
        for old in how.current.tracks:
            columns = np.flatnonzero(np.isin(waypoints.places, old.places))
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
    columns = np.flatnonzero(~np.isin(old.places, waypoints.places))
    if not len(columns):
        return []
    track = old.joints(columns)
    kept = track.segments[track.index_at(how.last_ns) :]
    active = track.index_at(how.next_ns) - track.index_at(how.last_ns)
    of_goal = how.tolerances is not None
    segments = [
        segment._replace(is_of_goal=of_goal and place >= active)
        for place, segment in enumerate(kept)
    ]
    return [Track(track.places, segments)]


def _kept(old: Track, waypoints: Waypoints, how: Splice, splice_ns: int) -> list[Segment]:
    """Return the segments that still run before the new trajectory begins."""
    columns = np.flatnonzero(np.isin(old.places, waypoints.places))
    track = old.joints(columns)
    kept = track.segments[track.index_at(how.last_ns) : track.index_at(splice_ns) + 1]
    return [segment._replace(is_of_goal=False) for segment in kept]


def _track(
    waypoints: Waypoints, kept: list[Segment], how: Splice, first: int, start_ns: int
) -> Track:
    places = waypoints.places
    splice_ns = max(start_ns, how.next_ns)
    last = _of(how.current.state_at(splice_ns), places)
    states = waypoints.states[first:]
    offset = turns_to_nearest(last.position, states[0].position, how.wraps[places])
    moved = [
        JointState(state.position + offset, state.velocity, state.acceleration) for state in states
    ]
    times_ns = [start_ns + time_ns for time_ns in waypoints.times_ns[first:]]
    tolerances = None if how.tolerances is None else how.tolerances.of_joints(places)
    segments = [Segment.between(splice_ns, last, times_ns[0], moved[0])]
    for place in range(len(moved) - 1):
        segment = Segment.between(
            times_ns[place], moved[place], times_ns[place + 1], moved[place + 1]
        )
        from_start_s = waypoints.times_ns[first + place] * _SECONDS
        segments.append(segment._replace(from_start_s=from_start_s))
    new = [
        segment._replace(is_of_goal=tolerances is not None, tolerances=tolerances)
        for segment in segments
    ]
    return Track(places, kept + new)


def _of(state: JointState, places: Indices) -> JointState:
    def some(values: Array | None) -> Array | None:
        return None if values is None else values[places]

    return JointState(state.position[places], some(state.velocity), some(state.acceleration))
