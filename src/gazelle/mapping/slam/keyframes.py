"""The scans that are kept, and fields made of some of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.scan_matching.likelihood_field import Field, field_of
from gazelle.mapping.scan_matching.matching_kernels import placed
from gazelle.mapping.scan_matching.surface_points import dense_surface, even_points
from gazelle.mapping.se2 import Poses
from gazelle.mapping.slam.slam_parameters import SlamParameters

__all__ = ["Keyframe", "Keyframes", "keyframe_of"]


_Number = TypeVar("_Number", bound=np.generic)


@dataclass(frozen=True, slots=True, eq=False)
class Keyframe:
    """A scan that is kept.

    Attributes:
        scan: as it came.
        points_m: what is matched, in the robot's frame, (n, 2).
        surface_m: what is matched with, in the robot's frame, (m, 2).
        ranges_m: (beams,) float32, of all beams, NaN for those that met nothing.
        way_m: how far the robot had driven.
        max_range_m: beams that are longer are not used.
    """

    scan: Scan
    points_m: NDArray[np.float64]
    surface_m: NDArray[np.float64]
    ranges_m: NDArray[np.float32]
    way_m: float
    max_range_m: float

    @property
    def reach_m(self) -> float:
        """Distance of the farthest point."""
        return float(np.sqrt((self.points_m**2).sum(axis=1).max(initial=0.0)))


def keyframe_of(scan: Scan, parameters: SlamParameters, way_m: float) -> Keyframe:
    """Return what matching needs of a scan."""
    told = parameters.settings.keyframes
    limit_m = min(parameters.max_range_m, scan.range_max_m)
    # Walls go on behind the end of sight, where earlier scans did not see them: to match what lies
    # there would pull every scan back to the last ones.
    sure_m = limit_m - min(told.unseen_m, told.unseen_share * limit_m)
    hits, met = scan.hits(parameters.max_range_m), scan.points(parameters.max_range_m)
    sure = met[scan.ranges_m[hits] <= sure_m]
    points = even_points(sure, parameters.cell_m, told.most_points)
    surface = dense_surface(
        met, np.flatnonzero(hits), parameters.cell_m, parameters.settings.surface
    )
    ranges = np.where(scan.hits(), scan.ranges_m, np.nan).astype(np.float32)
    return Keyframe(scan, points, surface, ranges, way_m, parameters.max_range_m)


class Keyframes:
    """All kept scans with where they are.

    Attributes:
        tears: indices of those whose relation to the one before may be wrong.
    """

    def __init__(self, parameters: SlamParameters) -> None:
        """Start empty."""
        self._parameters = parameters
        self.tears: set[int] = set()
        self._frames: list[Keyframe] = []
        self._poses = np.zeros((256, 3))
        self._ways_m = np.zeros(256)
        self._surfaces_m = np.zeros((1 << 16, 2))
        self._starts = np.zeros(257, np.int64)

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, index: int) -> Keyframe:
        return self._frames[index]

    @property
    def poses(self) -> Poses:
        """Poses in the map's frame, (n, 3); assign to move all."""
        return self._poses[: len(self._frames)]

    @poses.setter
    def poses(self, poses: Poses) -> None:
        self._poses[: len(self._frames)] = poses

    @property
    def ways_m(self) -> NDArray[np.float64]:
        """How far the robot had driven at each, (n,)."""
        return self._ways_m[: len(self._frames)]

    def append(self, frame: Keyframe, pose: ArrayLike) -> int:
        """Keep one more; return its index."""
        index = len(self._frames)
        begin = self._starts[index]
        end = begin + len(frame.surface_m)
        self._poses = _with_room(self._poses, index + 1)
        self._ways_m = _with_room(self._ways_m, index + 1)
        self._starts = _with_room(self._starts, index + 2)
        self._surfaces_m = _with_room(self._surfaces_m, end)
        self._poses[index], self._ways_m[index] = pose, frame.way_m
        self._surfaces_m[begin:end], self._starts[index + 1] = frame.surface_m, end
        self._frames.append(frame)
        return index

    def surface(self, indices: Iterable[int]) -> NDArray[np.float64]:
        """Return the surfaces of some in the map's frame, (m, 2)."""
        chosen = np.array(list(indices), dtype=np.int64)
        points: NDArray[np.float64] = placed(self._surfaces_m, self._starts, self._poses, chosen)
        return points

    def field(self, indices: Iterable[int], center: ArrayLike, reach_m: float) -> Field:
        """Return the field of some around a pose, so far that what is `reach_m` away is in it."""
        x, y = np.asarray(center, dtype=float)[:2]
        half = reach_m + self._parameters.settings.keyframes.margin_m
        return field_of(
            self.surface(indices),
            (float(x), float(y)),
            half,
            cell_m=self._parameters.cell_m,
            sigma_m=self._parameters.sigma_m,
            settings=self._parameters.settings.field,
        )


def _with_room(array: NDArray[_Number], wanted: int) -> NDArray[_Number]:
    """Return an array, twice as long if it is too short."""
    while len(array) < wanted:
        array = np.concatenate([array, np.zeros_like(array)])
    return array
