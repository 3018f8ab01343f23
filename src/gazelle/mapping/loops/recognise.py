"""Looking whether the robot is where it has been before."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.loops.ambiguity import ambiguous
from gazelle.mapping.loops.hypotheses import Hypothesis
from gazelle.mapping.loops.places import Place
from gazelle.mapping.matching.field import Field
from gazelle.mapping.matching.match import Prior, refined
from gazelle.mapping.matching.surfaces import even_points
from gazelle.mapping.matching.wide import WideSearch
from gazelle.mapping.pose_graph.information import seen_from
from gazelle.mapping.poses import Poses, between, transform_points
from gazelle.mapping.slam.keyframes import Keyframes
from gazelle.mapping.slam.parameters import SlamParameters

__all__ = ["recognise"]

_PATCH_M = 5.0
_PATCH_SCANS = 10
_PATCH_CELL_M = 0.1
_PATCH_POINTS = 300
_PLACE_M = 6.0
_PLACE_SCANS = 24
_APART_M = 0.45
_FEWEST_POINTS = 40
_FEWEST_SCANS = 2
_FIRST_REACH_M = 0.25
_LEAST_DOUBT_M = 1.5
_MUCH_BETTER = 0.08


def recognise(keyframes: Keyframes, place: Place, parameters: SlamParameters) -> Hypothesis | None:
    """Return where the last keyframe is seen from a place, None when it does not look like it.

    What the last few keyframes see together is matched with what those around the place saw: single
    scans of a building resemble each other too often.
    """
    head = len(keyframes) - 1
    if keyframes.tears.intersection(range(head - _FEWEST_SCANS, head + 1)):
        return None
    points = _patch(keyframes, head)
    if len(points) < _FEWEST_POINTS:
        return None
    pose = keyframes.poses[head]
    reach = float(np.sqrt((points**2).sum(axis=1).max())) + place.reach_m
    near = _around(keyframes, place, head)
    field = keyframes.field(near, pose, reach)
    rough = _nearest_match(field.pooled(), points, pose, place, parameters.least_loop)
    if rough is None:
        return None
    found = refined(field, points, rough, Prior(rough, np.zeros((3, 3))))
    if found.score < parameters.least_loop:
        return None
    tail = place.keyframe
    relative = between(keyframes.poses[tail], found.pose)
    information = ambiguous(field, points, found, max(_LEAST_DOUBT_M, place.reach_m))
    information = seen_from(keyframes.poses[tail], information)
    return Hypothesis(tail, head, relative, information, found.score, place.reach_m)


def _nearest_match(
    field: Field, points: NDArray[np.float64], pose: Poses, place: Place, least: float
) -> Poses | None:
    """Return the match that needs the smallest window, unless one farther away is much better.

    Corridors look alike wherever one stands in them; then the robot is where it thinks it is.
    """
    best: Poses | None = None
    reach, done = _FIRST_REACH_M, None
    search = WideSearch.around(field, points, pose, place.reach_rad)
    while True:
        reach = min(reach, place.reach_m)
        found = search.best(reach, least=least, done_m=done)
        if found is not None:
            best, least = found.pose, found.value + _MUCH_BETTER
        if reach >= place.reach_m or least >= 1.0:
            return best
        reach, done = 2.0 * reach, reach


def _patch(keyframes: Keyframes, head: int) -> NDArray[np.float64]:
    """Return what the last keyframes see, in the frame of the last one."""
    near = _along(keyframes, head, -1, _PATCH_M)[:_PATCH_SCANS]
    seen = between(keyframes.poses[head], keyframes.poses[near])
    parts = [
        transform_points(pose, keyframes[i].points_m) for i, pose in zip(near, seen, strict=True)
    ]
    return even_points(np.concatenate(parts), _PATCH_CELL_M, _PATCH_POINTS)


def _around(keyframes: Keyframes, place: Place, head: int) -> list[int]:
    """Return the keyframes around a place that are not of the present.

    They reach as far as the patch does wherever it may be in the window: where they see less, it
    would be drawn to where they see more.
    """
    reach = _PLACE_M + min(place.reach_m, _PLACE_M)
    both = {
        i for way in (-1, 1) for i in _along(keyframes, place.keyframe, way, reach)[:_PLACE_SCANS]
    }
    present = keyframes[head].way_m - _PATCH_M
    return sorted(i for i in both if keyframes[i].way_m < present)


def _along(keyframes: Keyframes, start: int, step: int, reach_m: float) -> list[int]:
    """Return keyframes from one on, forwards or back, some way apart, as far as all is sure."""
    chosen, index, count = [start], start + step, len(keyframes)
    while 0 <= index < count and abs(keyframes[index].way_m - keyframes[start].way_m) < reach_m:
        if max(index, index - step) in keyframes.tears:
            break
        if abs(keyframes[index].way_m - keyframes[chosen[-1]].way_m) >= _APART_M:
            chosen.append(index)
        index += step
    return chosen
