"""A map as localisation looks at it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid

__all__ = ["LikelihoodMap", "MapFrame"]


class MapFrame(NamedTuple):
    """Where the cells of a map are, as kernels take it.

    Attributes:
        x_m, y_m: of cell (0, 0).
        cell_m: side of a cell.
        per_m: cells per metre.
    """

    x_m: float
    y_m: float
    cell_m: float
    per_m: float


@dataclass(frozen=True, eq=False)
class LikelihoodMap:
    """Free cells and distances to walls.

    Attributes:
        blocked: (height, width) int8, 1 for occupied cells, 2 for unknown ones, 0 for free ones.
        distances_m: (height, width) float32, to the nearest occupied cell, at most `reach_m`.
        free: columns and rows of free cells, (n, 2).
        resolution_m: side of a cell.
        origin: of cell (0, 0), m.
        reach_m: longest distance that is told apart.
    """

    blocked: NDArray[np.int8]
    distances_m: NDArray[np.float32]
    free: NDArray[np.int64]
    resolution_m: float
    origin: tuple[float, float]
    reach_m: float

    @cached_property
    def frame(self) -> MapFrame:
        """Where its cells are."""
        x, y = self.origin
        return MapFrame(float(x), float(y), float(self.resolution_m), 1.0 / self.resolution_m)

    @classmethod
    def of_grid(cls, grid: OccupancyGrid, reach_m: float) -> LikelihoodMap:
        """Look at a map; occupied is 100, free is 0, everything else unknown, as in amcl.

        A map whose frame is turned is looked at without the turn, as amcl does.
        """
        from gazelle.navigation.costmap.costmap_kernels import squared_distances

        occupied = grid.cells == 100
        reach = int(np.ceil(reach_m / grid.resolution_m))
        squares = squared_distances(occupied, reach)
        distances = np.sqrt(np.minimum(squares, reach * reach)) * grid.resolution_m
        blocked = np.where(occupied, 1, np.where(grid.cells == 0, 0, 2)).astype(np.int8)
        rows, columns = np.nonzero(grid.cells == 0)
        return cls(
            blocked,
            np.minimum(distances, reach_m).astype(np.float32),
            np.column_stack([columns, rows]),
            grid.resolution_m,
            (grid.origin[0], grid.origin[1]),
            reach_m,
        )

    def problem_at(self, x_m: float, y_m: float) -> str:
        """Return why a robot cannot be at a place, empty when it can."""
        x, y = self.origin
        height, width = self.blocked.shape
        column = int(np.floor((x_m - x) / self.resolution_m))
        row = int(np.floor((y_m - y) / self.resolution_m))
        if not (0 <= column < width and 0 <= row < height):
            right, top = x + width * self.resolution_m, y + height * self.resolution_m
            return f"off the map, which is from ({x:.2f}, {y:.2f}) to ({right:.2f}, {top:.2f})"
        kind = int(self.blocked[row, column])
        return ("", "in a wall of the map", "where the map is unknown")[kind]

    def random_poses(self, count: int, random: np.random.Generator) -> NDArray[np.float64]:
        """Return poses anywhere on free ground, (count, 3).

        Raises:
            ValueError: the map has no free cell.
        """
        if not len(self.free):
            raise ValueError("the map has no free cell, so there is no place for a robot")
        cells = self.free[random.integers(len(self.free), size=count)]
        inside = random.random((count, 2))
        places = (cells + inside) * self.resolution_m + self.origin
        return np.column_stack([places, random.uniform(-np.pi, np.pi, count)])
