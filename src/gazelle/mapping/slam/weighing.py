"""Choosing among the poses that a scan fits at, when it fits badly where it was expected."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gazelle.mapping.matching.field import Field
from gazelle.mapping.matching.match import Match, Prior, refined
from gazelle.mapping.matching.wide import best_of_sectors
from gazelle.mapping.poses import Poses, between
from gazelle.mapping.slam.evidence import SeenSpace, seen_space
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes

__all__ = ["Surroundings", "surroundings", "weighed"]

_NEAREST = 80
_SECTOR_RAD = 0.3
_LEAST = 0.2
_LEAST_WORTH = 0.15
_CLEARLY = 0.15
_APART_M = 0.3
_APART_RAD = 0.15
# Of a pose at the edge of the window. Wheels slip seldom by so much within a step; what is new in
# a scan explains a bad fit more often.
_FAR_COSTS, _LOST_COSTS = 0.12, 0.05


class Surroundings(NamedTuple):
    """All that was seen around a pose.

    Attributes:
        field: of the surfaces.
        coarse: the same, with cells twice as large.
        space: where beams ended and where they passed.
    """

    field: Field
    coarse: Field
    space: SeenSpace


class _Weight(NamedTuple):
    found: Match
    worth: float


def surroundings(
    keyframes: Keyframes, center: Poses, reach_m: float, last: int | None = None
) -> Surroundings:
    """Return what the nearest scans, of any time or of the last ones, saw around a pose."""
    first = 0 if last is None else max(0, len(keyframes) - last)
    far = np.hypot(*(keyframes.poses[first:, :2] - center[:2]).T)
    near = (first + np.argsort(far)[:_NEAREST]).tolist()
    field = keyframes.field(near, center, reach_m)
    middle = float(center[0]), float(center[1])
    space = seen_space([keyframes[i] for i in near], keyframes.poses[near], middle, reach_m)
    return Surroundings(field, field.pooled(), space)


def weighed(
    around: Surroundings,
    frame: Keyframe,
    expected: Poses,
    guesses: list[Poses],
    reach: tuple[float, float],
    *,
    is_lost: bool = False,
) -> Match | None:
    """Return the pose for which most speaks, None when little speaks for any.

    What speaks for a pose is the mean likelihood of the points; what speaks against it is the
    share of them that contradict what is known of space.

    Args:
        around: what was seen.
        frame: the scan.
        expected: pose by odometry.
        guesses: poses that are considered besides those of the search.
        reach: half sides of the window, m and rad.
        is_lost: odometry says little of where the robot is.
    """
    points = frame.points_m
    rough = best_of_sectors(
        around.coarse, points, expected,
        reach_m=reach[0], reach_rad=min(math.pi, reach[1]), sector_rad=_SECTOR_RAD, least=_LEAST,
    )  # fmt: skip
    poses = [one.pose for one in rough] + guesses
    costs = _LOST_COSTS if is_lost else _FAR_COSTS
    weights = [_weight(around, frame, expected, pose, reach, costs) for pose in poses]
    if not weights:
        # In empty space no scan looks like anything that is known.
        return None
    best = max(weights, key=lambda one: one.worth)
    if best.worth < _LEAST_WORTH:
        return None
    others = [one.worth for one in weights if _is_apart(one.found.pose, best.found.pose)]
    is_clear = best.worth > max(others, default=0.0) + _CLEARLY
    return replace(best.found, is_doubtful=not is_clear)


def _weight(
    around: Surroundings,
    frame: Keyframe,
    expected: Poses,
    pose: Poses,
    reach: tuple[float, float],
    costs: float,
) -> _Weight:
    found = refined(around.field, frame.points_m, pose, Prior(pose, np.zeros((3, 3))))
    against = around.space.against(frame.scan, frame.points_m, found.pose)
    away = between(expected, found.pose)
    far = math.hypot(away[0], away[1]) / reach[0], abs(float(away[2])) / reach[1]
    # What fits best at the edge of the window fits better outside of it.
    cost = costs * (far[0] ** 2 + far[1] ** 2) if max(far) < 1.5 else math.inf
    return _Weight(found, found.score - against - cost)


def _is_apart(one: Poses, other: Poses) -> bool:
    away = between(one, other)
    return bool(math.hypot(away[0], away[1]) > _APART_M or abs(away[2]) > _APART_RAD)
