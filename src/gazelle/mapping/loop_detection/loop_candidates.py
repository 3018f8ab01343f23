"""Looking whether the robot is where it has been before: which keyframes, how they match."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.loop_detection.hypotheses import Hypothesis, ambiguous
from gazelle.mapping.loop_detection.settings import CandidateSettings, RecognitionSettings
from gazelle.mapping.loop_detection.shortest_path_kernels import shortest_ways
from gazelle.mapping.pose_graph.constraints import Edges, doubtful, seen_from
from gazelle.mapping.scan_matching.branch_and_bound import WideSearch
from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.scan_matching.scan_matcher import Prior, refined
from gazelle.mapping.scan_matching.surface_points import even_points
from gazelle.mapping.se2 import Poses, between, transform_points

if TYPE_CHECKING:
    from gazelle.mapping.slam.keyframes import Keyframes
    from gazelle.mapping.slam.slam_parameters import SlamParameters

__all__ = ["LoopCandidate", "loop_candidates", "recognise"]


class LoopCandidate(NamedTuple):
    """An earlier keyframe.

    Attributes:
        keyframe: its index.
        reach_m: how far it may be from where it seems to be.
        reach_rad: by how much its heading may be off.
    """

    keyframe: int
    reach_m: float
    reach_rad: float


def loop_candidates(
    poses: Poses,
    edges: Edges,
    *,
    gap_m: float,
    reach_m: float,
    settings: CandidateSettings,
) -> list[LoopCandidate]:
    """Return the places to look at for the last pose, the likeliest first.

    How far a place may be off grows with the shortest way through the graph, so that it is small
    for parts of the map that loops already tie together.

    Args:
        poses: of all keyframes, (n, 3).
        edges: between them.
        gap_m: shorter ways are no loops.
        reach_m: the largest window.
        settings: how far places may be off, and how many are looked at.
    """
    told = settings
    last = len(poses) - 1
    far = np.hypot(*(poses[:, :2] - poses[last, :2]).T)
    ways = _ways(edges, len(poses), told.loop_length_m)
    doubts_m, doubts_rad = (_doubts(edges, len(poses), axis, told.no_doubt) for axis in (0, 2))
    reach = told.sigmas * (told.drift_m + told.drift_m_per_m * ways) + told.doubts * doubts_m
    reach = np.clip(reach, told.least_reach_m, reach_m)
    turn = told.drift_rad + told.drift_rad_per_m * np.minimum(ways, told.most_way_m)
    turn = np.minimum(turn + told.doubts * doubts_rad, np.pi)
    wanted = np.flatnonzero((far < told.nearest_m + reach) & (ways > gap_m))
    if not len(wanted):
        return []
    passes = np.split(wanted, np.flatnonzero(np.diff(wanted) > told.same_pass) + 1)
    nearest = [int(one[far[one].argmin()]) for one in passes]
    nearest.sort(key=lambda k: far[k] - reach[k])
    return [LoopCandidate(k, float(reach[k]), float(turn[k])) for k in nearest[: told.most_places]]


def _ways(edges: Edges, count: int, loop_m: float) -> NDArray[np.float64]:
    """Return the shortest ways through the graph to the last pose, metres."""
    lengths = np.hypot(edges.relative[:, 0], edges.relative[:, 1]) + 1e-3
    return _shortest(edges, np.where(edges.is_loop, loop_m, lengths), count)


def _doubts(edges: Edges, count: int, axis: int, least: float) -> NDArray[np.float64]:
    """Return the deviation, m or rad, of doubtful relations on the surest way to the last pose."""
    is_doubt = doubtful(edges.information) & ~edges.is_loop
    variance = 1.0 / edges.information[:, axis, axis]
    squared = _shortest(edges, np.where(is_doubt, variance, 1e-6), count)
    return np.sqrt(np.where(squared < least, 0.0, squared))


def _shortest(edges: Edges, lengths: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    # One layout, whatever these are parts of: another one would be compiled for anew.
    tails, heads = np.ascontiguousarray(edges.tail), np.ascontiguousarray(edges.head)
    ways: NDArray[np.float64] = shortest_ways(tails, heads, lengths, count, count - 1)
    return ways


def recognise(
    keyframes: Keyframes, place: LoopCandidate, parameters: SlamParameters
) -> Hypothesis | None:
    """Return where the last keyframe is seen from a place, None when it does not look like it.

    What the last few keyframes see together is matched with what those around the place saw: single
    scans of a building resemble each other too often.
    """
    settings = parameters.settings
    told, head = settings.recognition, len(keyframes) - 1
    if keyframes.tears.intersection(range(head - told.fewest_scans, head + 1)):
        return None
    points = _patch(keyframes, head, told)
    if len(points) < told.fewest_points:
        return None
    pose = keyframes.poses[head]
    reach = float(np.sqrt((points**2).sum(axis=1).max())) + place.reach_m
    near = _around(keyframes, place, head, told)
    field = keyframes.field(near, pose, reach)
    rough = _nearest_match(field.pooled(), points, pose, place, parameters)
    if rough is None:
        return None
    found = refined(field, points, rough, Prior(rough, np.zeros((3, 3))), settings.match)
    if found.score < parameters.least_loop:
        return None
    tail = place.keyframe
    relative = between(keyframes.poses[tail], found.pose)
    shifts_m = max(told.least_doubt_m, place.reach_m)
    information = ambiguous(field, points, found, shifts_m, settings.ambiguity)
    information = seen_from(keyframes.poses[tail], information)
    return Hypothesis(tail, head, relative, information, found.score, place.reach_m)


def _nearest_match(
    field: Field,
    points: NDArray[np.float64],
    pose: Poses,
    place: LoopCandidate,
    parameters: SlamParameters,
) -> Poses | None:
    """Return the match that needs the smallest window, unless one farther away is much better.

    Corridors look alike wherever one stands in them; then the robot is where it thinks it is.
    """
    told, least = parameters.settings.recognition, parameters.least_loop
    best: Poses | None = None
    reach, done = told.first_reach_m, None
    search = WideSearch.around(field, points, pose, place.reach_rad)
    while True:
        reach = min(reach, place.reach_m)
        found = search.best(reach, least=least, done_m=done)
        if found is not None:
            best, least = found.pose, found.value + told.much_better
        if reach >= place.reach_m or least >= 1.0:
            return best
        reach, done = 2.0 * reach, reach


def _patch(keyframes: Keyframes, head: int, settings: RecognitionSettings) -> NDArray[np.float64]:
    """Return what the last keyframes see, in the frame of the last one."""
    near = _along(keyframes, head, -1, settings.patch_m, settings)[: settings.patch_scans]
    seen = between(keyframes.poses[head], keyframes.poses[near])
    parts = [
        transform_points(pose, keyframes[i].points_m) for i, pose in zip(near, seen, strict=True)
    ]
    return even_points(np.concatenate(parts), settings.patch_cell_m, settings.patch_points)


def _around(
    keyframes: Keyframes, place: LoopCandidate, head: int, settings: RecognitionSettings
) -> list[int]:
    """Return the keyframes around a place that are not of the present.

    They reach as far as the patch does wherever it may be in the window: where they see less, it
    would be drawn to where they see more.
    """
    reach = settings.place_m + min(place.reach_m, settings.place_m)
    both = {
        i
        for way in (-1, 1)
        for i in _along(keyframes, place.keyframe, way, reach, settings)[: settings.place_scans]
    }
    present = keyframes[head].way_m - settings.patch_m
    return sorted(i for i in both if keyframes[i].way_m < present)


def _along(
    keyframes: Keyframes, start: int, step: int, reach_m: float, settings: RecognitionSettings
) -> list[int]:
    """Return keyframes from one on, forwards or back, some way apart, as far as all is sure."""
    chosen, index, count = [start], start + step, len(keyframes)
    while 0 <= index < count and abs(keyframes[index].way_m - keyframes[start].way_m) < reach_m:
        if max(index, index - step) in keyframes.tears:
            break
        if abs(keyframes[index].way_m - keyframes[chosen[-1]].way_m) >= settings.apart_m:
            chosen.append(index)
        index += step
    return chosen
