"""What speaks for a pose and what against it: surfaces that agree, and space known to be free.

How well a scan fits what was seen says little where most of what it sees is new: then a wrong pose
that lays new walls on old ones fits better than the right one. But it lays others into rooms that
were seen to be empty, and looks through walls. What lies in the unknown says nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import Poses, compose, transform_points
from gazelle.mapping.slam.free_space_kernels import contradictions
from gazelle.mapping.slam.keyframes import Keyframe
from gazelle.mapping.slam.ray_kernels import BeamCounts, count_beams
from gazelle.mapping.slam.settings import EvidenceSettings

__all__ = ["SeenSpace", "seen_space"]


@dataclass(frozen=True, slots=True, eq=False)
class SeenSpace:
    """Where beams ended and where they passed.

    Attributes:
        counts: of them.
        settings: side of a cell, and how exactly a beam ends.
    """

    counts: BeamCounts
    settings: EvidenceSettings

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
    settings: EvidenceSettings,
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
