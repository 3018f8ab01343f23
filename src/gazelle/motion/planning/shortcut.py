"""Shortcuts: what a random search wandered about is cut away."""

from __future__ import annotations

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning.problem import Problem, Waypoints

__all__ = ["shortcut"]

_MAX_TRIES = 100
_PATIENCE = 12
_MIN_GAIN = 0.01


def shortcut(problem: Problem, path: Waypoints) -> Waypoints:
    """Return a path that is no longer than `path`, with the same ends (up to full turns).

    First whole waypoints are left out, then random pairs of points on the path are connected
    (Geraerts and Overmars, 2007), until tries no longer gain a hundredth.
    """
    path = _without_detours(problem, path)
    failures = 0
    for _ in range(_MAX_TRIES):
        if failures >= _PATIENCE or len(path) < 3 or problem.is_over():
            break
        shorter = _try(problem, path)
        failures = failures + 1 if shorter is None else 0
        path = shorter or path
    return path


def _without_detours(problem: Problem, path: Waypoints) -> Waypoints:
    """Go from each waypoint to the farthest one that can be reached directly."""
    kept, here = [path[0]], 0
    while here < len(path) - 1:
        following, waypoints = here + 1, [path[here + 1]]
        for other in _farthest_first(here, len(path)):
            if problem.is_over():
                break
            found = problem.connect(kept[-1], path[other])
            if found is not None and _length([kept[-1], *found]) <= _length(path[here : other + 1]):
                following, waypoints = other, found
                break
        turns = waypoints[-1] - path[following]
        path = path[: following + 1] + [q + turns for q in path[following + 1 :]]
        kept.extend(waypoints)
        here = following
    return kept


def _farthest_first(here: int, count: int) -> list[int]:
    """Return few candidates of many waypoints: the last, then halfway to it, and so on."""
    candidates = []
    gap = count - 1 - here
    while gap > 1:
        candidates.append(here + gap)
        gap //= 2
    return candidates


def _try(problem: Problem, path: Waypoints) -> Waypoints | None:
    """Connect two random points of a path; None where that is no gain or not allowed."""
    points = np.array(path)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    marks = np.concatenate([[0.0], np.cumsum(lengths)])
    low, high = np.sort(problem.rng.uniform(0.0, marks[-1], 2))
    first, last = (int(np.searchsorted(marks, mark, side="right")) - 1 for mark in (low, high))
    last = min(last, len(path) - 2)
    if first >= last:
        return None
    begin = _point(path, marks, lengths, first, low)
    end = _point(path, marks, lengths, last, high)
    if high - low - problem.space.distance(begin, end) < _MIN_GAIN * marks[-1]:
        return None
    waypoints = problem.connect(begin, end)
    if waypoints is None or _length([begin, *waypoints]) >= high - low:
        return None
    turns = waypoints[-1] - end
    return [*path[: first + 1], begin, *waypoints, *(q + turns for q in path[last + 1 :])]


def _point(
    path: Waypoints, marks: FloatArray, lengths: FloatArray, index: int, mark: float
) -> FloatArray:
    part = (mark - marks[index]) / lengths[index] if lengths[index] > 0.0 else 0.0
    return path[index] + (path[index + 1] - path[index]) * part


def _length(waypoints: Waypoints) -> float:
    return float(np.linalg.norm(np.diff(np.array(waypoints), axis=0), axis=1).sum())
