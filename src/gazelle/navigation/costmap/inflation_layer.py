"""Costs near what is lethal."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import INSCRIBED, LETHAL, CostGrid, Window
from gazelle.navigation.costmap.costmap_parameters import InflationOptions
from gazelle.navigation.costmap.footprint import Footprint

__all__ = ["InflationLayer", "inflated", "inflation_costs"]


def inflation_costs(
    options: InflationOptions, inscribed_m: float, resolution_m: float
) -> NDArray[np.uint8]:
    """Return the cost by squared distance in cells, up to the radius, as (n,).

    The formula is that of ``InflationLayer::computeCost``: 253 within the inscribed radius, beyond
    it 252 · exp(−cost_scaling_factor · (distance − inscribed radius)).
    """
    reach = math.ceil(options.inflation_radius / resolution_m)
    distance_m = np.sqrt(np.arange(reach * reach + 1)) * resolution_m
    falling = (INSCRIBED - 1) * np.exp(-options.cost_scaling_factor * (distance_m - inscribed_m))
    costs = np.where(distance_m <= inscribed_m, INSCRIBED, np.minimum(falling, INSCRIBED - 1))
    costs[0] = LETHAL
    return costs.astype(np.uint8)


def inflated(grid: CostGrid, options: InflationOptions, footprint: Footprint) -> CostGrid:
    """Return a grid with costs raised near what is lethal; a convenience for whole maps."""
    layer = InflationLayer(options)
    copy = CostGrid(grid.costs.copy(), grid.resolution_m, grid.origin)
    layer.prepare(grid.resolution_m, footprint)
    layer.write(copy, grid.whole)
    return copy


@dataclass(eq=False)
class InflationLayer:
    """Inflation, by the options that hold when it writes.

    Attributes:
        options: its parameters.
        name: of the layer.
    """

    options: InflationOptions
    name: str = "inflation_layer"

    def __post_init__(self) -> None:
        """Begin without a table."""
        self._key: tuple[object, ...] = ()
        self._table = np.array([LETHAL], np.uint8)

    @property
    def reach(self) -> int:
        """How many cells away costs change."""
        return math.isqrt(len(self._table) - 1)

    def prepare(self, resolution_m: float, footprint: Footprint) -> bool:
        """Make the table of costs; tells whether everything has to be inflated anew."""
        key = (self.options, resolution_m, footprint.inscribed_m)
        if key == self._key:
            return False
        anew, self._key = bool(self._key), key
        self._table = inflation_costs(self.options, footprint.inscribed_m, resolution_m)
        return anew

    def write(self, master: CostGrid, window: Window) -> None:
        """Raise costs in a window."""
        from gazelle.navigation.costmap.costmap_kernels import inflate_window

        unknown, around = self.options.inflate_unknown, self.options.inflate_around_unknown
        inflate_window(master.costs, window, self._table, self.reach, unknown, around)
