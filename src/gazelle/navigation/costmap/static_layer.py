"""The layer that is a map."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid
from gazelle.navigation.costmap.cost_grid import FREE, LETHAL, UNKNOWN, CostGrid, Window
from gazelle.navigation.costmap.costmap_parameters import StaticOptions
from gazelle.navigation.costmap.footprint import Footprint

__all__ = ["StaticLayer", "costs_of_map"]


def costs_of_map(grid: OccupancyGrid, options: StaticOptions) -> NDArray[np.uint8]:
    """Return the costs of a map's cells, (height, width), as ``StaticLayer::interpretValue``."""
    values = np.arange(256)
    lethal = max(options.lethal_cost_threshold, 1)
    if options.trinary_costmap:
        table = np.full(256, FREE, np.uint8)
    else:
        table = np.minimum(values * LETHAL // lethal, LETHAL).astype(np.uint8)
    table[values >= lethal] = LETHAL
    table[options.unknown_cost_value % 256] = UNKNOWN if options.track_unknown_space else FREE
    return table[grid.cells.view(np.uint8)]


@dataclass(eq=False)
class StaticLayer:
    """A map, kept as costs.

    Attributes:
        options: its parameters.
        name: of the layer.
        T_map_global: the costmap's frame in the map's, needed where they differ.
    """

    options: StaticOptions
    name: str = "static_layer"
    T_map_global: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Begin without a map."""
        self._map: CostGrid | None = None
        self._changed = Window(0, 0, 0, 0)
        self._footprint: NDArray[np.float64] | None = None

    @property
    def map(self) -> CostGrid | None:
        """The map's costs, None before there is one."""
        return self._map

    def set_map(self, grid: OccupancyGrid) -> bool:
        """Take a map; False when only the first one counts and there is one."""
        if self._map is not None and self.options.first_map_only:
            return False
        costs = costs_of_map(grid, self.options)
        self._map = CostGrid(costs, grid.resolution_m, (grid.origin[0], grid.origin[1]))
        self._changed = self._map.whole
        return True

    def update_map(self, column: int, row: int, cells: NDArray[np.int8]) -> None:
        """Take a part of the map, (rows, columns), as ``map_msgs/OccupancyGridUpdate`` has it."""
        if self._map is None:
            return
        window = Window(column, row, column + cells.shape[1], row + cells.shape[0])
        inside = window.within(self._map.width, self._map.height)
        part = cells[inside.y0 - row : inside.y1 - row, inside.x0 - column : inside.x1 - column]
        grid = OccupancyGrid(np.ascontiguousarray(part), self._map.resolution_m)
        self._map.costs[inside.cells] = costs_of_map(grid, self.options)
        self._changed = self._changed.union(inside)

    def changes(
        self,
        master: CostGrid,
        pose: tuple[float, float, float],
        footprint: Footprint,
        rolling: bool,
    ) -> Window:
        """Return what has to be written anew."""
        self._footprint = footprint.at(pose) if self.options.footprint_clearing_enabled else None
        if self._map is None:
            return Window(0, 0, 0, 0)
        changed, self._changed = self._changed, Window(0, 0, 0, 0)
        return master.whole if rolling else changed

    def write(self, master: CostGrid, window: Window) -> None:
        """Write the map's costs into a window."""
        if self._map is None:
            return
        own = self._aligned(master, window)
        target = master.costs[window.cells]
        if self.options.use_maximum:
            known = (own != UNKNOWN) & ((target == UNKNOWN) | (target < own))
            target[known] = own[known]
        else:
            target[...] = np.where(own == UNKNOWN, target, own) if own is not target else own
        if self._footprint is not None:
            _clear_polygon(master, self._footprint)

    def _aligned(self, master: CostGrid, window: Window) -> NDArray[np.uint8]:
        """Return the map's costs of the master's cells in a window."""
        layer = self._map
        assert layer is not None
        same = layer.resolution_m == master.resolution_m and layer.origin == master.origin
        if same and self.T_map_global == (0.0, 0.0, 0.0):
            return layer.costs[window.cells]
        columns, rows = np.arange(window.x0, window.x1), np.arange(window.y0, window.y1)
        x, y = master.cell_to_world(columns[None, :], rows[:, None])
        tx, ty, yaw = self.T_map_global
        c, s = math.cos(yaw), math.sin(yaw)
        u = np.floor((tx + c * x - s * y - layer.origin[0]) / layer.resolution_m).astype(np.int64)
        v = np.floor((ty + s * x + c * y - layer.origin[1]) / layer.resolution_m).astype(np.int64)
        inside = (u >= 0) & (v >= 0) & (u < layer.width) & (v < layer.height)
        held = layer.costs[v.clip(0, layer.height - 1), u.clip(0, layer.width - 1)]
        return np.where(inside, held, np.uint8(UNKNOWN))


def _clear_polygon(master: CostGrid, corners: NDArray[np.float64]) -> None:
    from gazelle.navigation.costmap.costmap_kernels import fill_polygon

    cells = (corners - np.array(master.origin)) / master.resolution_m
    fill_polygon(master.costs, cells, np.uint8(FREE), np.zeros(4, np.int64))
