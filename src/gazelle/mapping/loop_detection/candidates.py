"""Which earlier keyframes may be where the robot is now."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.loop_detection.settings import PlaceSettings
from gazelle.mapping.loop_detection.shortest_path_kernels import shortest_ways
from gazelle.mapping.pose_graph.constraints import Edges, doubtful
from gazelle.mapping.se2 import Poses

__all__ = ["Place", "places_near"]


class Place(NamedTuple):
    """An earlier keyframe.

    Attributes:
        keyframe: its index.
        reach_m: how far it may be from where it seems to be.
        reach_rad: by how much its heading may be off.
    """

    keyframe: int
    reach_m: float
    reach_rad: float


def places_near(
    poses: Poses,
    edges: Edges,
    *,
    gap_m: float,
    reach_m: float,
    settings: PlaceSettings,
) -> list[Place]:
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
    return [Place(k, float(reach[k]), float(turn[k])) for k in nearest[: told.most_places]]


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
