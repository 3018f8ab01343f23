"""Choosing among the poses that a scan fits at, when it fits badly where it was expected.

How well a scan fits what was seen says little where most of what it sees is new: then a wrong pose
that lays new walls on old ones fits better than the right one. But it lays others into rooms that
were seen to be empty, and looks through walls. What lies in the unknown says nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.scan_matching.branch_and_bound import best_of_sectors
from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.scan_matching.scan_matcher import Match, Prior, refined
from gazelle.mapping.se2 import Poses, between, compose, transform_points
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.ray_kernels import BeamCounts, contradictions, count_beams
from gazelle.mapping.slam.slam_parameters import (
    FreeSpaceSettings,
    PoseSelectionSettings,
    SlamSettings,
)

__all__ = ["LocalMap", "SeenSpace", "local_map", "seen_space", "select_pose"]


@dataclass(frozen=True, slots=True, eq=False)
class SeenSpace:
    """Where beams ended and where they passed.

    Attributes:
        counts: of them.
        settings: side of a cell, and how exactly a beam ends.
    """

    counts: BeamCounts
    settings: FreeSpaceSettings

    def against(self, scan: Scan, points_m: NDArray[np.float64], pose: Poses) -> float:
        """Return the share of points that contradict what is known of space.

        Args:
            scan: of which the lidar's mounting counts.
            points_m: of it, in the robot's frame, (n, 2).
            pose: of the robot.
        """
        lidar = compose(pose, np.array(scan.T_base_laser))
        ends = transform_points(pose, points_m)
        count = contradictions(self.counts, lidar, ends, self.settings.margin_m)
        return float(count) / max(1, len(points_m))


def seen_space(
    frames: Sequence[Keyframe],
    poses: Poses,
    center_m: tuple[float, float],
    half_side_m: float,
    settings: FreeSpaceSettings,
) -> SeenSpace:
    """Return what scans say of a square.

    Args:
        frames: one at least; beams longer than the first one's limit end nowhere.
        poses: of the robot, (n, 3).
        center_m: middle of the square.
        half_side_m: of it.
        settings: side of a cell, and how exactly a beam ends.
    """
    side = max(3, int(2 * half_side_m / settings.cell_m))
    hits = np.zeros((side, side), np.int32)
    passes = np.zeros((side, side), np.int32)
    corner = center_m[0] - half_side_m, center_m[1] - half_side_m
    counts = BeamCounts(hits, passes, *corner, settings.cell_m)
    lidars = compose(poses, np.array([frame.scan.T_base_laser for frame in frames]))
    limit = frames[0].max_range_m
    for frame, lidar, yaw in zip(frames, lidars, poses[:, 2], strict=True):
        directions = yaw + frame.scan.bearings_rad
        count_beams(counts, lidar, directions, frame.ranges_m, limit)
    return SeenSpace(counts, settings)


class LocalMap(NamedTuple):
    """All that was seen around a pose.

    Attributes:
        field: of the surfaces.
        coarse: the same, with cells twice as large.
        space: where beams ended and where they passed.
        settings: numbers of the algorithms.
    """

    field: Field
    coarse: Field
    space: SeenSpace
    settings: SlamSettings


class _Weight(NamedTuple):
    found: Match
    worth: float


def local_map(
    keyframes: Keyframes,
    center: Poses,
    reach_m: float,
    settings: SlamSettings,
    last: int | None = None,
) -> LocalMap:
    """Return what the nearest scans, of any time or of the last ones, saw around a pose.

    The pose is (3,) in the map: x, y (m) and yaw (rad).
    """
    first = 0 if last is None else max(0, len(keyframes) - last)
    far = np.hypot(*(keyframes.poses[first:, :2] - center[:2]).T)
    near = (first + np.argsort(far)[: settings.pose_selection.nearest]).tolist()
    field = keyframes.field(near, center, reach_m)
    middle = float(center[0]), float(center[1])
    frames = [keyframes[i] for i in near]
    space = seen_space(frames, keyframes.poses[near], middle, reach_m, settings.free_space)
    return LocalMap(field, field.pooled(), space, settings)


def select_pose(
    around: LocalMap,
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
        expected: pose in the map by odometry, (3,): x, y (m) and yaw (rad).
        guesses: poses, (3,) each, that are considered besides those of the search.
        reach: half sides of the window, m and rad.
        is_lost: odometry says little of where the robot is.
    """
    told, points = around.settings.pose_selection, frame.points_m
    rough = best_of_sectors(
        around.coarse, points, expected,
        reach_m=reach[0], reach_rad=min(math.pi, reach[1]), sector_rad=told.sector_rad,
        least=told.least,
    )  # fmt: skip
    poses = [one.pose for one in rough] + guesses
    costs = told.lost_costs if is_lost else told.far_costs
    weights = [_weight(around, frame, expected, pose, reach, costs) for pose in poses]
    if not weights:
        # In empty space no scan looks like anything that is known.
        return None
    best = max(weights, key=lambda one: one.worth)
    if best.worth < told.least_worth:
        return None
    others = [one.worth for one in weights if _is_apart(one.found.pose, best.found.pose, told)]
    is_clear = best.worth > max(others, default=0.0) + told.clearly
    return replace(best.found, is_doubtful=not is_clear)


def _weight(
    around: LocalMap,
    frame: Keyframe,
    expected: Poses,
    pose: Poses,
    reach: tuple[float, float],
    costs: float,
) -> _Weight:
    settings, free = around.settings, Prior(pose, np.zeros((3, 3)))
    found = refined(around.field, frame.points_m, pose, free, settings.match)
    against = around.space.against(frame.scan, frame.points_m, found.pose)
    away = between(expected, found.pose)
    far = math.hypot(away[0], away[1]) / reach[0], abs(float(away[2])) / reach[1]
    # What fits best at the edge of the window fits better outside of it.
    is_near = max(far) < settings.pose_selection.most_edges
    cost = costs * (far[0] ** 2 + far[1] ** 2) if is_near else math.inf
    return _Weight(found, found.score - against - cost)


def _is_apart(one: Poses, other: Poses, settings: PoseSelectionSettings) -> bool:
    away = between(one, other)
    is_far = math.hypot(away[0], away[1]) > settings.apart_m
    return bool(is_far or abs(away[2]) > settings.apart_rad)
