"""A grid of costs, and what the costs mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.rich_display import shown_by

__all__ = [
    "FREE",
    "INSCRIBED",
    "LETHAL",
    "UNKNOWN",
    "CostCells",
    "CostGrid",
    "Window",
    "occupancy_of_costs",
]

FREE = 0
"""Nothing here."""
INSCRIBED = 253
"""A robot whose centre is here touches something, whichever way it looks."""
LETHAL = 254
"""An obstacle."""
UNKNOWN = 255
"""Nobody knows."""


class Window(NamedTuple):
    """A rectangle of cells; the upper ends are not in it."""

    x0: int
    y0: int
    x1: int
    y1: int

    @property
    def empty(self) -> bool:
        """Whether no cell is in it."""
        return self.x0 >= self.x1 or self.y0 >= self.y1

    @property
    def cells(self) -> tuple[slice, slice]:
        """Index of the cells in an array of (height, width)."""
        return slice(self.y0, self.y1), slice(self.x0, self.x1)

    def union(self, other: Window) -> Window:
        """Return the smallest window around both."""
        if self.empty or other.empty:
            return other if self.empty else self
        return Window(
            min(self.x0, other.x0),
            min(self.y0, other.y0),
            max(self.x1, other.x1),
            max(self.y1, other.y1),
        )

    def grown(self, cells: int) -> Window:
        """Return the window with a margin."""
        if self.empty:
            return self
        return Window(self.x0 - cells, self.y0 - cells, self.x1 + cells, self.y1 + cells)

    def within(self, width: int, height: int) -> Window:
        """Return what of the window lies in a grid."""
        return Window(
            min(max(self.x0, 0), width),
            min(max(self.y0, 0), height),
            min(max(self.x1, 0), width),
            min(max(self.y1, 0), height),
        )


class CostCells(NamedTuple):
    """A grid of costs as kernels take it.

    Attributes:
        costs: uint8, (height, width), row 0 has the lowest y.
        x_m, y_m: of the lower left corner.
        per_m: cells per metre.
    """

    costs: NDArray[np.uint8]
    x_m: float
    y_m: float
    per_m: float


@shown_by("maps:cost_grid_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class CostGrid:
    """Costs of square cells; the array may change, its place does not.

    Attributes:
        costs: uint8, (height, width), row 0 has the lowest y.
        resolution_m: side of a cell, m.
        origin: x and y of the lower left corner, m.
    """

    costs: NDArray[np.uint8]
    resolution_m: float
    origin: tuple[float, float] = (0.0, 0.0)

    @property
    def width(self) -> int:
        """Cells along x."""
        return int(self.costs.shape[1])

    @property
    def height(self) -> int:
        """Cells along y."""
        return int(self.costs.shape[0])

    @property
    def cells(self) -> CostCells:
        """What kernels take of it."""
        x, y = self.origin
        return CostCells(self.costs, float(x), float(y), 1.0 / self.resolution_m)

    @property
    def whole(self) -> Window:
        """The window of all cells."""
        return Window(0, 0, self.width, self.height)

    def world_to_cell(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Return column and row of the cell of a point, which may lie outside the grid."""
        return (
            int(np.floor((x_m - self.origin[0]) / self.resolution_m)),
            int(np.floor((y_m - self.origin[1]) / self.resolution_m)),
        )

    def cells_of(self, points_m: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return columns and rows, (n, 2), of the cells of points, (n, 2)."""
        cells = np.floor((points_m - np.array(self.origin)) / self.resolution_m)
        return np.asarray(cells, np.int64)

    def cell_to_world(
        self, column: ArrayLike, row: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return x and y (m) of centres of cells, in the shape of `column`."""
        return (
            self.origin[0] + (np.asarray(column, float) + 0.5) * self.resolution_m,
            self.origin[1] + (np.asarray(row, float) + 0.5) * self.resolution_m,
        )

    def contains(self, column: int, row: int) -> bool:
        """Return whether a cell is in the grid."""
        return 0 <= column < self.width and 0 <= row < self.height

    def cost_at(self, x_m: float, y_m: float) -> int:
        """Return the cost of a point, `UNKNOWN` outside the grid."""
        column, row = self.world_to_cell(x_m, y_m)
        return int(self.costs[row, column]) if self.contains(column, row) else UNKNOWN


def occupancy_of_costs(costs: NDArray[np.uint8]) -> NDArray[np.int8]:
    """Return costs of any shape as ``nav_msgs/OccupancyGrid`` shows them: −1, 0 … 99, 100.

    The table is that of ``Costmap2DPublisher``.
    """
    table = np.zeros(256, np.int8)
    steps = np.arange(1, INSCRIBED)
    table[1:INSCRIBED] = 1 + (97 * (steps - 1)) // 251
    table[[INSCRIBED, LETHAL, UNKNOWN]] = 99, 100, -1
    return table[costs]
