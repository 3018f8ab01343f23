"""The scans that are kept, and fields made of some of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.mapping.matching.field import Field, field_of
from gazelle.mapping.matching.surfaces import dense_surface, even_points
from gazelle.mapping.poses import Poses, transform_points
from gazelle.mapping.scans import Scan
from gazelle.mapping.slam.parameters import SlamParameters

__all__ = ["Keyframe", "Keyframes", "keyframe_of"]

_MOST_POINTS = 360
_MARGIN_M = 2.0
_UNSEEN_M = 0.7
_UNSEEN_SHARE = 0.2


@dataclass(frozen=True, slots=True, eq=False)
class Keyframe:
    """A scan that is kept.

    Attributes:
        scan: as it came.
        points_m: what is matched, in the robot's frame, (n, 2).
        surface_m: what is matched with, in the robot's frame, (m, 2).
        way_m: how far the robot had driven.
        max_range_m: beams that are longer are not used.
    """

    scan: Scan
    points_m: NDArray[np.float64]
    surface_m: NDArray[np.float64]
    way_m: float
    max_range_m: float

    @property
    def reach_m(self) -> float:
        """Distance of the farthest point."""
        return float(np.sqrt((self.points_m**2).sum(axis=1).max(initial=0.0)))


def keyframe_of(scan: Scan, parameters: SlamParameters, way_m: float) -> Keyframe:
    """Return what matching needs of a scan."""
    limit_m = min(parameters.max_range_m, scan.range_max_m)
    # Walls go on behind the end of sight, where earlier scans did not see them: to match what lies
    # there would pull every scan back to the last ones.
    sure_m = limit_m - min(_UNSEEN_M, _UNSEEN_SHARE * limit_m)
    points = even_points(scan.points(sure_m), parameters.cell_m, _MOST_POINTS)
    surface = dense_surface(scan, parameters.max_range_m, parameters.cell_m)
    return Keyframe(scan, points, surface, way_m, parameters.max_range_m)


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
        return np.array([frame.way_m for frame in self._frames])

    def append(self, frame: Keyframe, pose: ArrayLike) -> int:
        """Keep one more; return its index."""
        if len(self._frames) == len(self._poses):
            self._poses = np.concatenate([self._poses, np.zeros_like(self._poses)])
        self._frames.append(frame)
        self._poses[len(self._frames) - 1] = pose
        return len(self._frames) - 1

    def surface(self, indices: Iterable[int]) -> NDArray[np.float64]:
        """Return the surfaces of some in the map's frame, (m, 2)."""
        parts = [transform_points(self._poses[i], self._frames[i].surface_m) for i in indices]
        return np.concatenate(parts) if parts else np.empty((0, 2))

    def field(self, indices: Iterable[int], center: ArrayLike, reach_m: float) -> Field:
        """Return the field of some around a pose, so far that what is `reach_m` away is in it."""
        x, y = np.asarray(center, dtype=float)[:2]
        half = reach_m + _MARGIN_M
        return field_of(
            self.surface(indices),
            (float(x), float(y)),
            half,
            cell_m=self._parameters.cell_m,
            sigma_m=self._parameters.sigma_m,
        )
