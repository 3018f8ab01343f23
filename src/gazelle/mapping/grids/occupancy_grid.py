"""One grid of cells that are free, occupied or unknown."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.rich_display import shown_by

__all__ = ["OccupancyGrid"]


@shown_by("maps:grid_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class OccupancyGrid:
    """What ``nav_msgs/OccupancyGrid`` carries, without stamp and frame.

    Attributes:
        cells: int8, (height, width); row 0 has the lowest y; −1 unknown, 0 free … 100 occupied.
        resolution_m: side of a cell, m.
        origin: x, y (m) and yaw (rad) of the lower left corner of cell (0, 0) in the map's frame.
    """

    cells: NDArray[np.int8]
    resolution_m: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Check what the arithmetic below relies on."""
        if self.cells.ndim != 2 or self.cells.dtype != np.int8:
            raise ValueError(f"cells are int8 (height, width), not {self.cells.dtype} "
                             f"{self.cells.shape}")  # fmt: skip
        if not (math.isfinite(self.resolution_m) and self.resolution_m > 0):
            raise ValueError(f"resolution_m is {self.resolution_m}, it must be above 0")
        if len(self.origin) != 3 or not all(map(math.isfinite, self.origin)):
            raise ValueError(f"origin is {self.origin}, it must be finite x, y and yaw")

    @property
    def width(self) -> int:
        """Cells along x."""
        return int(self.cells.shape[1])

    @property
    def height(self) -> int:
        """Cells along y."""
        return int(self.cells.shape[0])

    def world_to_cell(
        self, x_m: ArrayLike, y_m: ArrayLike
    ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return column and row of the cells that points lie in; they may be outside the grid.

        Both are int64 of the shape of the points.

        Args:
            x_m: one or many x in the map's frame, m.
            y_m: as many y, m.
        """
        ox, oy, yaw = self.origin
        dx, dy = np.asarray(x_m, float) - ox, np.asarray(y_m, float) - oy
        c, s = math.cos(yaw), math.sin(yaw)
        column = np.floor((c * dx + s * dy) / self.resolution_m)
        row = np.floor((c * dy - s * dx) / self.resolution_m)
        return column.astype(np.int64), row.astype(np.int64)

    def cell_to_world(
        self, column: ArrayLike, row: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return x and y (m), in the shape of `column`, of centres of cells in the map's frame."""
        ox, oy, yaw = self.origin
        u = (np.asarray(column, float) + 0.5) * self.resolution_m
        v = (np.asarray(row, float) + 0.5) * self.resolution_m
        c, s = math.cos(yaw), math.sin(yaw)
        return ox + c * u - s * v, oy + s * u + c * v

    def contains(self, column: ArrayLike, row: ArrayLike) -> NDArray[np.bool_]:
        """Return which cells are in the grid, in the shape of `column`."""
        i, j = np.asarray(column), np.asarray(row)
        return (i >= 0) & (j >= 0) & (i < self.width) & (j < self.height)
