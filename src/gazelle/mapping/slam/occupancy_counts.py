"""Drawing scans into a grid: how often beams ended in a cell and how often they passed it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.se2 import Poses, compose
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.ray_kernels import BeamCounts, count_beams
from gazelle.mapping.slam.slam_parameters import OccupancySettings

__all__ = ["MapDrawer", "draw"]

_USUAL = OccupancySettings()

_OCCUPIED = 0.25


def draw(
    keyframes: Keyframes,
    resolution_m: float = 0.05,
    occupied_share: float = _OCCUPIED,
    settings: OccupancySettings = _USUAL,
) -> OccupancyGrid:
    """Draw all kept scans, see `MapDrawer`."""
    return MapDrawer(resolution_m, occupied_share, settings).draw(keyframes)


class MapDrawer:
    """Draws maps of a growing set of scans, only what is new since the last time.

    A cell is occupied when more than a share of the beams that reached it ended in it (0.25, as
    gmapping's ``occ_thresh``), free when fewer did, unknown when none reached it. So are cells
    in which hardly any beams ended next to one in which many did: they lie behind a wall.
    """

    def __init__(
        self,
        resolution_m: float = 0.05,
        occupied_share: float = _OCCUPIED,
        settings: OccupancySettings = _USUAL,
    ) -> None:
        """Begin with an empty map.

        Args:
            resolution_m: side of a cell.
            occupied_share: of beams that end in a cell.
            settings: when the map grows and is drawn anew.
        """
        self._settings = settings
        self._resolution_m = resolution_m
        self._share = occupied_share
        self._hits: NDArray[np.int32] = np.zeros((0, 0), np.int32)
        self._passes: NDArray[np.int32] = np.zeros((0, 0), np.int32)
        self._corner = (0.0, 0.0)
        self._drawn: Poses = np.empty((0, 3))

    def draw(self, keyframes: Keyframes) -> OccupancyGrid:
        """Return the map of all keyframes."""
        # The other thread may keep more meanwhile.
        poses = keyframes.poses.copy()
        count = len(poses)
        if self._has_moved(poses):
            self._drawn = np.empty((0, 3))
        frames = [keyframes[i] for i in range(len(self._drawn), count)]
        new = poses[len(self._drawn) :]
        if frames:
            self._make_room(frames, new, fresh=not len(self._drawn))
            for frame, pose in zip(frames, new, strict=True):
                self._count(frame, pose)
        self._drawn = poses
        return self._grid()

    def _has_moved(self, poses: Poses) -> bool:
        if len(poses) < len(self._drawn):
            return True
        change = np.abs(poses[: len(self._drawn)] - self._drawn)
        limit = self._settings.moved_cells * self._resolution_m
        turned = np.minimum(change[:, 2], 2 * np.pi - change[:, 2])
        return bool((change[:, :2] > limit).any() or (turned > self._settings.moved_rad).any())

    def _make_room(self, frames: list[Keyframe], poses: Poses, *, fresh: bool) -> None:
        reach = np.array([frame.reach_m for frame in frames])[:, None]
        reach = reach + self._settings.margin_m
        low, high = (poses[:, :2] - reach).min(axis=0), (poses[:, :2] + reach).max(axis=0)
        cell = self._resolution_m
        if fresh:
            self._allot(low, high)
            return
        height, width = self._hits.shape
        old = np.array(self._corner)
        end = old + np.array([width, height]) * cell
        if (low >= old).all() and (high <= end).all():
            return
        hits, passes = self._hits, self._passes
        more = self._settings.grow_m
        grow = np.where(low < old, more, 0.0), np.where(high > end, more, 0.0)
        self._allot(np.minimum(low - grow[0], old), np.maximum(high + grow[1], end))
        column, row = np.round((old - self._corner) / cell).astype(int)
        self._hits[row : row + height, column : column + width] = hits
        self._passes[row : row + height, column : column + width] = passes

    def _allot(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
        cell = self._resolution_m
        x, y = (math.floor(value / cell) * cell for value in low)
        width, height = (math.ceil((b - a) / cell) for a, b in zip((x, y), high, strict=True))
        self._corner = (x, y)
        self._hits = np.zeros((max(1, height), max(1, width)), np.int32)
        self._passes = np.zeros_like(self._hits)

    def _count(self, frame: Keyframe, pose: Poses) -> None:
        scan = frame.scan
        counts = BeamCounts(self._hits, self._passes, *self._corner, self._resolution_m)
        lidar = compose(pose, np.array(scan.T_base_laser))
        directions = pose[2] + scan.bearings_rad
        # The same limit as of matching: what is farther errs too much by the lidar's angle.
        limit = frame.max_range_m
        count_beams(counts, lidar, directions, frame.ranges_m, limit)

    def _grid(self) -> OccupancyGrid:
        reached = np.maximum(self._passes, 1)
        occupied = self._hits > self._share * reached
        cells = np.where(occupied, 100, 0).astype(np.int8)
        cells[self._passes == 0] = -1
        cells[self._tails(occupied)] = -1
        return OccupancyGrid(*_cropped(cells, self._corner, self._resolution_m))

    def _tails(self, occupied: NDArray[np.bool_]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return occupied cells, rows and columns, that only the lidar's noise reached.

        Nothing passes through a wall, so that a single beam would fill the cell behind it.
        """
        rows, columns = np.nonzero(occupied)
        padded = np.pad(self._hits, 1)
        around = [padded[rows + i, columns + j] for i in range(3) for j in range(3)]
        most = np.max(around, axis=0, initial=0)
        tail = self._hits[rows, columns] < self._settings.tail * most
        return rows[tail], columns[tail]


def _cropped(
    cells: NDArray[np.int8], corner: tuple[float, float], resolution_m: float
) -> tuple[NDArray[np.int8], float, tuple[float, float, float]]:
    """Leave unknown margins out, a cell each side apart."""
    rows, columns = (
        np.flatnonzero((cells >= 0).any(axis=1)),
        np.flatnonzero((cells >= 0).any(axis=0)),
    )
    if not len(rows):
        return np.full((1, 1), -1, np.int8), resolution_m, (*corner, 0.0)
    top, left = max(0, rows[0] - 1), max(0, columns[0] - 1)
    part = np.ascontiguousarray(cells[top : rows[-1] + 2, left : columns[-1] + 2])
    x, y = corner[0] + left * resolution_m, corner[1] + top * resolution_m
    return part, resolution_m, (float(x), float(y), 0.0)
