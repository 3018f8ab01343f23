"""Matching every kept scan with all its neighbours once more, earlier and later ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.pose_graph.constraints import Edges, bounded, seen_from
from gazelle.mapping.pose_graph.optimizer import optimise
from gazelle.mapping.scan_matching.scan_matcher import Match, Prior, match
from gazelle.mapping.se2 import Poses, between, wrap_angle
from gazelle.mapping.slam.keyframes import Keyframes
from gazelle.mapping.slam.slam_parameters import (
    GlobalRefinementSettings,
    SlamParameters,
    SlamSettings,
)

__all__ = ["refined_globally"]


def refined_globally(keyframes: Keyframes, edges: Edges, parameters: SlamParameters) -> Poses:
    """Return better poses (n, 3) of all keyframes: x, y (m) and yaw (rad) in the map.

    While driving, a scan is matched with what was seen before. Here each is matched with the
    nearest ones of any time, and tied to some of them; then relations of the drive count less
    where they contradict.
    """
    told, poses = parameters.settings.global_refinement, keyframes.poses.copy()
    near = [_neighbours(poses, i, told) for i in range(len(keyframes))]
    found = [
        _rematched(keyframes, poses, i, near[i], parameters.settings) for i in range(len(keyframes))
    ]
    least = max(told.least, parameters.least_match)
    matched = {i: one for i, one in enumerate(found) if one and one.score > least}
    outliers = {i for i, one in matched.items() if _is_far(between(poses[i], one.pose), told)}
    pairs = [(k, i) for i in matched for k in _spread(near[i], outliers, told)]
    if not pairs:
        return poses
    constraints = _constraints(poses, matched, np.array(pairs, dtype=np.int64))
    edges = _weakened(edges, outliers, told.stray_weight)
    everything = edges.joined(constraints)
    robust = everything._replace(is_loop=np.ones(len(everything.tail), dtype=bool))
    for i in outliers:
        poses[i] = matched[i].pose
    return optimise(
        poses,
        robust,
        iterations=told.iterations,
        huber=told.huber,
        settings=parameters.settings.graph,
    )


def _constraints(poses: Poses, matched: dict[int, Match], pairs: NDArray[np.int64]) -> Edges:
    """Return relations between neighbours and matched scans, (neighbour, scan) each."""
    tails, heads = pairs.T
    found = np.array([matched[i].pose for i in heads.tolist()])
    told = {i: bounded(one.information) for i, one in matched.items()}
    information = np.array([told[i] for i in heads.tolist()])
    relative = between(poses[tails], found)
    return Edges(tails, heads, relative, seen_from(poses[tails], information), tails >= 0)


def _rematched(
    keyframes: Keyframes, poses: Poses, index: int, near: list[int], settings: SlamSettings
) -> Match | None:
    told, frame = settings.global_refinement, keyframes[index]
    if len(near) < told.tied or len(frame.points_m) < settings.tracking.fewest_points:
        return None
    expected = np.diag([told.sigma_m**-2, told.sigma_m**-2, told.sigma_rad**-2])
    pose = poses[index]
    field = keyframes.field(near, pose, frame.reach_m)
    coarse = field.pooled()
    found = match(
        field, frame.points_m, Prior(pose, expected), reach_m=told.reach_m,
        reach_rad=told.reach_rad, coarse=coarse, settings=settings.match,
    )  # fmt: skip
    if found.score > told.good:
        return found
    again = match(
        field, frame.points_m, Prior(pose, expected / 16), reach_m=told.wide_m,
        reach_rad=told.wide_rad, coarse=coarse, settings=settings.match,
    )  # fmt: skip
    return again if again.score > found.score + told.better else found


def _is_far(change: Poses, settings: GlobalRefinementSettings) -> bool:
    is_off = np.hypot(change[0], change[1]) > settings.stray_m
    return bool(is_off or abs(change[2]) > settings.stray_rad)


def _weakened(edges: Edges, outliers: set[int], share: float) -> Edges:
    """Return edges of which those of strays, which were wrong at the time, hardly count."""
    lost = np.array(sorted(outliers), dtype=np.int64)
    touched = np.isin(edges.tail, lost) | np.isin(edges.head, lost)
    weight = np.where(touched, share, 1.0)
    return edges._replace(information=edges.information * weight[:, None, None])


def _neighbours(poses: Poses, index: int, settings: GlobalRefinementSettings) -> list[int]:
    """Return the nearest keyframes, the nearest first."""
    far = np.hypot(*(poses[:, :2] - poses[index, :2]).T)
    turn = np.abs(wrap_angle(poses[:, 2] - poses[index, 2]))
    cost = far + settings.m_per_rad * turn
    cost[index] = np.inf
    order = np.argsort(cost)[: settings.near_scans]
    return [int(k) for k in order if far[k] < settings.near_m]


def _spread(near: list[int], outliers: set[int], settings: GlobalRefinementSettings) -> list[int]:
    """Return those that a scan is tied to: the nearest of different times."""
    chosen: list[int] = []
    for k in near:
        if k not in outliers and all(abs(k - other) > settings.apart for other in chosen):
            chosen.append(k)
        if len(chosen) == settings.tied:
            break
    return chosen
