"""Times for a path: as fast as the limits allow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace, Validity
from gazelle.motion.planning.path_validation import FINE_STEP, first_fault, first_faulty_motion
from gazelle.motion.planning.problem import Path
from gazelle.motion.timing.jerk_limited_profile import Smoothed, seven_phases
from gazelle.motion.timing.limits import Limits, limits_of
from gazelle.motion.timing.totg_path import Arc, Line, corner_arc, distinct, pieces
from gazelle.motion.timing.totg_velocity_profile import Span, fastest
from gazelle.motion.timing.trajectory import States, Trajectory, states_at, times_of

__all__ = ["Method", "method_of", "parameterise"]

Method = Literal["totg", "jerk"]

_HALVINGS = 5
_MIN_PERIOD_S = 0.01


def parameterise(
    path: Path | FloatArray,
    space: JointSpace,
    *,
    velocity_scaling: float = 1.0,
    acceleration_scaling: float = 1.0,
    method: Method = "totg",
    resample_dt_s: float = 0.1,
    path_tolerance: float = 0.1,
    validity: Validity | None = None,
) -> Trajectory:
    """Return the fastest motion along a path, from rest to rest, within the limits of a space.

    Corners are rounded by arcs that miss them by no more than `path_tolerance`, as MoveIt's
    TimeOptimalTrajectoryGeneration does.

    Args:
        path: straight motions between waypoints, (k, n) as an array.
        space: limits of velocity, acceleration and jerk.
        velocity_scaling: MoveIt's max_velocity_scaling_factor.
        acceleration_scaling: MoveIt's max_acceleration_scaling_factor.
        method: ``"totg"``, or ``"jerk"`` to keep to limits of jerk too.
        resample_dt_s: time between samples; MoveIt's resample_dt.
        path_tolerance: rad or m; 0 stops at every corner. MoveIt's path_tolerance.
        validity: where it is given, a corner is rounded only as far as that is allowed, and
            samples come closer together where the straight motion between two of them is not.

    Raises:
        ValueError: the path, a limit, the tolerance or the period makes no sense.
    """
    if path_tolerance < 0.0 or not resample_dt_s > 0.0:
        raise ValueError(
            f"path_tolerance is {path_tolerance:g} and resample_dt {resample_dt_s:g}; a tolerance "
            "is not below zero and a period above it"
        )
    limits = limits_of(space, velocity_scaling, acceleration_scaling, jerk=method == "jerk")
    waypoints = distinct(_waypoints(path, space))
    if len(waypoints) == 1:
        return _at_rest(space, waypoints, limits)
    corners = _corner_tolerances(space, waypoints, path_tolerance, validity)
    timed = [_Timed(waypoints, corners, limits, method)]
    if method == "jerk" and any(corners):
        stopping = _Timed(waypoints, [0.0] * len(corners), limits, method)
        timed.append(stopping)
        timed.sort(key=lambda item: item.duration_s)
    for item in timed:
        trajectory = item.sampled(space, resample_dt_s, limits.notes)
        period = resample_dt_s
        while validity is not None and _fault(space, validity, trajectory.positions):
            period /= 2.0
            if period < _MIN_PERIOD_S:
                break
            trajectory = item.sampled(space, period, limits.notes)
        else:
            return trajectory
    return _Timed(waypoints, [0.0] * len(corners), limits, method).sampled(
        space, resample_dt_s, limits.notes
    )


def method_of(adapters: Sequence[str]) -> tuple[Method, tuple[str, ...]]:
    """Return the method that MoveIt's planning adapters ask for, and what is done otherwise.

    Args:
        adapters: names such as ``default_planner_request_adapters/AddTimeParameterization``.
    """
    names = [name.rsplit("/", 1)[-1] for name in adapters]
    method: Method = "jerk" if "AddRuckigTrajectorySmoothing" in names else "totg"
    parabolic = {"AddTimeParameterization", "AddIterativeSplineParameterization"}
    notes = tuple(
        f"{name} is done by time-optimal parameterisation, which is faster and keeps the same "
        "limits"
        for name in names
        if name in parabolic
    )
    return method, notes


class _Timed:
    """A path with times, not yet sampled."""

    def __init__(
        self, waypoints: FloatArray, corners: Sequence[float], limits: Limits, method: Method
    ) -> None:
        self._limits = limits
        self._parts: list[tuple[float, Line | Smoothed | list[Span]]] = []
        for piece in pieces(waypoints, corners):
            part: Line | Smoothed | list[Span]
            if method == "jerk" and len(piece) == 1 and isinstance(piece[0], Line):
                part = piece[0]
                duration = seven_phases(part, limits, np.zeros(1))[1]
            else:
                spans = fastest(piece, limits.velocity, limits.acceleration)
                part = Smoothed(spans, limits) if method == "jerk" else spans
                duration = (
                    part.duration_s
                    if isinstance(part, Smoothed)
                    else sum(span.duration_s for span in spans)
                )
            self._parts.append((duration, part))

    @property
    def duration_s(self) -> float:
        return sum(duration for duration, _ in self._parts)

    def sampled(self, space: JointSpace, period_s: float, notes: tuple[str, ...]) -> Trajectory:
        # Stops get samples of their own, so that no straight motion between samples cuts a corner.
        stops = np.cumsum([duration for duration, _ in self._parts])
        times = times_of(stops, period_s)
        found: list[States] = []
        begin = 0.0
        for index, (duration, part) in enumerate(self._parts):
            is_last = index == len(self._parts) - 1
            rows = (times >= begin) & ((times < begin + duration) | is_last)
            if rows.any():
                found.append(self._states(part, times[rows] - begin))
            begin += duration
        positions, velocities, accelerations = (
            np.concatenate([getattr(item, name) for item in found])
            for name in ("positions", "velocities", "accelerations")
        )
        velocities[-1] = 0.0
        return Trajectory(space.names, times, positions, velocities, accelerations, notes)

    def _states(self, part: Line | Smoothed | list[Span], times_s: FloatArray) -> States:
        if isinstance(part, Line):
            return seven_phases(part, self._limits, times_s)[0]
        return part.at(times_s) if isinstance(part, Smoothed) else states_at(part, times_s)


def _waypoints(path: Path | FloatArray, space: JointSpace) -> FloatArray:
    rows = path.waypoints if isinstance(path, Path) else np.asarray(path, dtype=np.float64)
    if rows.ndim != 2 or not len(rows) or rows.shape[1] != space.size:
        raise ValueError(f"a path of shape {rows.shape} for {space.size} joints")
    if not np.isfinite(rows).all():
        row = int(np.flatnonzero(~np.isfinite(rows).all(axis=1))[0])
        raise ValueError(f"waypoint {row} of the path has numbers that are not finite")
    return rows


def _fault(space: JointSpace, validity: Validity, positions: FloatArray) -> str:
    """Return what is wrong with the samples from where they are within the limits."""
    begin = 0
    while begin < len(positions) - 1 and space.outside(positions[begin], tolerance=1e-3):
        begin += 1
    return first_fault(space, validity, positions[begin:])


def _at_rest(space: JointSpace, waypoints: FloatArray, limits: Limits) -> Trajectory:
    still = np.zeros_like(waypoints)
    return Trajectory(space.names, np.zeros(1), waypoints, still, still.copy(), limits.notes)


def _corner_tolerances(
    space: JointSpace, waypoints: FloatArray, tolerance: float, validity: Validity | None
) -> list[float]:
    """Return how far each corner may be missed without touching anything."""
    tolerances = []
    for index in range(1, len(waypoints) - 1):
        own = tolerance
        for _ in range(_HALVINGS):
            arc = corner_arc(waypoints[index - 1], waypoints[index], waypoints[index + 1], own)
            if arc is None or validity is None or _arc_is_valid(space, validity, arc):
                break
            own /= 2.0
        else:
            own = 0.0
        tolerances.append(own)
    return tolerances


def _arc_is_valid(space: JointSpace, validity: Validity, arc: Arc) -> bool:
    count = max(2, math.ceil(arc.length / FINE_STEP))
    states = arc.states(np.linspace(0.0, arc.length, count + 1))[0]
    return first_faulty_motion(space, validity, states) is None
