"""Matching every kept scan with all its neighbours once more, earlier and later ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.matching.match import Match, Prior, match
from gazelle.mapping.pose_graph.edges import Edges
from gazelle.mapping.pose_graph.information import bounded, seen_from
from gazelle.mapping.pose_graph.optimise import optimise
from gazelle.mapping.poses import Poses, between, wrap_angle
from gazelle.mapping.slam.keyframes import Keyframes
from gazelle.mapping.slam.parameters import SlamParameters
from gazelle.mapping.slam.tracking import FEWEST_POINTS

__all__ = ["polished"]

_NEAR_M = 4.0
_NEAR_SCANS = 20
_TIED = 3
_REACH_M = 0.2
_REACH_RAD = 0.2
_EXPECTED = np.diag([0.15**-2, 0.15**-2, 0.1**-2])
_LEAST = 0.5
_GOOD = 0.8
_WIDE_M = 0.4
_WIDE_RAD = 0.5
_BETTER = 0.05
_STRAY_M = 0.15
_STRAY_RAD = 0.06
_STRAY_WEIGHT = 0.01
_APART = 2


def polished(keyframes: Keyframes, edges: Edges, parameters: SlamParameters) -> Poses:
    """Return better poses of all keyframes.

    While driving, a scan is matched with what was seen before. Here each is matched with the
    nearest ones of any time, and tied to some of them; then relations of the drive count less
    where they contradict.
    """
    poses = keyframes.poses.copy()
    near = [_neighbours(poses, i) for i in range(len(keyframes))]
    found = [_rematched(keyframes, poses, i, near[i]) for i in range(len(keyframes))]
    least = max(_LEAST, parameters.least_match)
    matched = {i: one for i, one in enumerate(found) if one and one.score > least}
    stray = {i for i, one in matched.items() if _is_far(between(poses[i], one.pose))}
    pairs = [(k, i) for i in matched for k in _spread(near[i], stray)]
    if not pairs:
        return poses
    ties = _ties(poses, matched, np.array(pairs, dtype=np.int64))
    edges = _weakened(edges, stray)
    everything = edges.joined(ties)
    robust = everything._replace(is_loop=np.ones(len(everything.tail), dtype=bool))
    for i in stray:
        poses[i] = matched[i].pose
    return optimise(poses, robust, iterations=20, huber=1.0)


def _ties(poses: Poses, matched: dict[int, Match], pairs: NDArray[np.int64]) -> Edges:
    """Return relations between neighbours and matched scans, (neighbour, scan) each."""
    tails, heads = pairs.T
    found = np.array([matched[i].pose for i in heads.tolist()])
    told = {i: bounded(one.information) for i, one in matched.items()}
    information = np.array([told[i] for i in heads.tolist()])
    relative = between(poses[tails], found)
    return Edges(tails, heads, relative, seen_from(poses[tails], information), tails >= 0)


def _rematched(keyframes: Keyframes, poses: Poses, index: int, near: list[int]) -> Match | None:
    frame = keyframes[index]
    if len(near) < _TIED or len(frame.points_m) < FEWEST_POINTS:
        return None
    pose = poses[index]
    field = keyframes.field(near, pose, frame.reach_m)
    coarse = field.pooled()
    found = match(
        field, frame.points_m, Prior(pose, _EXPECTED),
        reach_m=_REACH_M, reach_rad=_REACH_RAD, coarse=coarse,
    )  # fmt: skip
    if found.score > _GOOD:
        return found
    again = match(
        field, frame.points_m, Prior(pose, _EXPECTED / 16),
        reach_m=_WIDE_M, reach_rad=_WIDE_RAD, coarse=coarse,
    )  # fmt: skip
    return again if again.score > found.score + _BETTER else found


def _is_far(change: Poses) -> bool:
    return bool(np.hypot(change[0], change[1]) > _STRAY_M or abs(change[2]) > _STRAY_RAD)


def _weakened(edges: Edges, stray: set[int]) -> Edges:
    """Return edges of which those of strays, which were wrong at the time, hardly count."""
    lost = np.array(sorted(stray), dtype=np.int64)
    touched = np.isin(edges.tail, lost) | np.isin(edges.head, lost)
    weight = np.where(touched, _STRAY_WEIGHT, 1.0)
    return edges._replace(information=edges.information * weight[:, None, None])


def _neighbours(poses: Poses, index: int) -> list[int]:
    """Return the nearest keyframes, the nearest first."""
    far = np.hypot(*(poses[:, :2] - poses[index, :2]).T)
    turn = np.abs(wrap_angle(poses[:, 2] - poses[index, 2]))
    cost = far + 0.5 * turn
    cost[index] = np.inf
    order = np.argsort(cost)[:_NEAR_SCANS]
    return [int(k) for k in order if far[k] < _NEAR_M]


def _spread(near: list[int], stray: set[int]) -> list[int]:
    """Return those that a scan is tied to: the nearest of different times."""
    chosen: list[int] = []
    for k in near:
        if k not in stray and all(abs(k - other) > _APART for other in chosen):
            chosen.append(k)
        if len(chosen) == _TIED:
            break
    return chosen
