"""A costmap made of layers, of which only what changed is computed anew."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid
from gazelle.navigation.costmap.cost_grid import FREE, UNKNOWN, CostGrid, Window
from gazelle.navigation.costmap.costmap_parameters import CostmapOptions
from gazelle.navigation.costmap.footprint import Footprint
from gazelle.navigation.costmap.inflation_layer import InflationLayer
from gazelle.navigation.costmap.obstacle_layer import Observation, ObstacleLayer, copy_overlap
from gazelle.navigation.costmap.static_layer import StaticLayer
from gazelle.rich_display import shown_by

__all__ = ["Layer", "LayeredCostmap"]

Layer = StaticLayer | ObstacleLayer | InflationLayer
"""What a costmap can be made of."""

Pose = tuple[float, float, float]
_Kind = TypeVar("_Kind", StaticLayer, ObstacleLayer, InflationLayer)


@shown_by("maps:layered_costmap_bundle")
@dataclass(eq=False)
class LayeredCostmap:
    """Layers and what they amount to. Not safe for several threads at once.

    Attributes:
        options: the costmap's parameters.
        layers: in the order in which they write.
        footprint: outline of the robot, padded; may be replaced.
        grid: the costs; replaced by a new one when size or place change.
    """

    options: CostmapOptions
    layers: Sequence[Layer]
    footprint: Footprint

    def __post_init__(self) -> None:
        """Begin with the size that the options say."""
        o = self.options
        width, height = (max(round(side / o.resolution), 1) for side in (o.width, o.height))
        self.grid = self._empty((height, width), o.resolution, (o.origin_x, o.origin_y))
        self._all = True

    def set_static_map(self, grid: OccupancyGrid) -> None:
        """Give a map to the static layers; a costmap that does not roll takes its size."""
        for layer in self._of(StaticLayer):
            if layer.set_map(grid) and not self.options.rolling_window:
                self._resize(layer)

    def update_static_map(self, column: int, row: int, cells: NDArray[np.int8]) -> None:
        """Give a changed part of the map, (rows, columns), to the static layers that listen."""
        for layer in self._of(StaticLayer):
            if layer.options.subscribe_to_updates:
                layer.update_map(column, row, cells)

    def observe(
        self,
        source: str,
        observation: Observation,
        layer: str | None = None,
        *,
        heard_ns: int | None = None,
    ) -> None:
        """Give what a sensor saw to the layers that have it as a source.

        Args:
            source: name of the sensor.
            observation: what it saw.
            layer: give it to this one only.
            heard_ns: when it came, by which sensors are silent; when it was seen if None.

        Raises:
            KeyError: no layer has such a source.
        """
        found = [
            item
            for item in self._of(ObstacleLayer)
            if source in item.sources and layer in (None, item.name)
        ]
        if not found:
            raise KeyError(f"no layer of the costmap has a source '{source}'")
        for item in found:
            item.observe(
                source, observation, observation.stamp_ns if heard_ns is None else heard_ns
            )

    def update(
        self, pose: Pose, now_ns: int, T_map_global: Pose = (0.0, 0.0, 0.0)
    ) -> Window | None:
        """Take in what was seen since the last call.

        Args:
            pose: the robot in the costmap's frame.
            now_ns: the time, by which observations expire.
            T_map_global: the costmap's frame in the map's, where they differ.

        Returns:
            The cells that may have changed; None when there are none.
        """
        if self.options.rolling_window:
            self._follow(pose)
        window = self._changes(pose, now_ns, T_map_global)
        window = window.within(self.grid.width, self.grid.height)
        if window.empty:
            return None
        self.grid.costs[window.cells] = self._default
        for layer in self._enabled():
            layer.write(self.grid, window)
        return window

    def stale(self, now_ns: int) -> list[str]:
        """Return, in words, what keeps the costmap from being current."""
        found = []
        for layer in self._enabled():
            if isinstance(layer, ObstacleLayer):
                found += layer.stale(now_ns)
            elif isinstance(layer, StaticLayer) and layer.map is None:
                found.append(f"the layer {layer.name} has no map yet")
        return found

    def clear(
        self, names: Iterable[str] | None, centre: Pose, size_m: float, *, inside: bool = False
    ) -> None:
        """Forget what obstacle layers saw, as ``clear_costmap_recovery`` does.

        Args:
            names: of layers, also with a namespace before; None for all obstacle layers.
            centre: of the square.
            size_m: side of the square, m.
            inside: forget what is in the square; otherwise what is outside of it.
        """
        half = size_m / 2
        x0, y0 = self.grid.world_to_cell(centre[0] - half, centre[1] - half)
        x1, y1 = self.grid.world_to_cell(centre[0] + half, centre[1] + half)
        wanted = None if names is None else {name.rpartition("/")[2] for name in names}
        for layer in self._of(ObstacleLayer):
            if wanted is None or layer.name in wanted:
                layer.match(self.grid)
                layer.clear(Window(x0, y0, x1 + 1, y1 + 1), inside=inside)

    def reset(self) -> None:
        """Forget everything that sensors saw; maps stay."""
        for layer in self._of(ObstacleLayer):
            layer.reset()
        self.grid.costs[...] = self._default
        self._all = True

    def _changes(self, pose: Pose, now_ns: int, T_map_global: Pose) -> Window:
        window, self._all = (self.grid.whole if self._all else Window(0, 0, 0, 0)), False
        rolling = self.options.rolling_window
        for layer in self._enabled():
            if isinstance(layer, StaticLayer):
                layer.T_map_global = T_map_global
                window = window.union(layer.changes(self.grid, pose, self.footprint, rolling))
            elif isinstance(layer, ObstacleLayer):
                window = window.union(layer.changes(self.grid, pose, self.footprint, now_ns))
            elif layer.prepare(self.grid.resolution_m, self.footprint):
                window = self.grid.whole
            else:
                window = window.grown(layer.reach)
        return window

    def _follow(self, pose: Pose) -> None:
        """Move the window so that the robot is in its middle, by whole cells."""
        grid, cell = self.grid, self.grid.resolution_m
        wanted = (pose[0] - grid.width * cell / 2, pose[1] - grid.height * cell / 2)
        dx, dy = (int((wanted[k] - grid.origin[k]) / cell) for k in (0, 1))
        if dx == 0 and dy == 0:
            return
        origin = (grid.origin[0] + dx * cell, grid.origin[1] + dy * cell)
        fresh = self._empty(grid.costs.shape, cell, origin)
        copy_overlap(grid, fresh)
        self.grid, self._all = fresh, True

    def _resize(self, layer: StaticLayer) -> None:
        own, grid = layer.map, self.grid
        assert own is not None
        if (own.costs.shape, own.resolution_m, own.origin) != (
            grid.costs.shape,
            grid.resolution_m,
            grid.origin,
        ):
            self.grid = self._empty(own.costs.shape, own.resolution_m, own.origin)
        self._all = True

    def _empty(
        self, shape: tuple[int, ...], resolution_m: float, origin: tuple[float, float]
    ) -> CostGrid:
        return CostGrid(np.full(shape, self._default, np.uint8), resolution_m, origin)

    def _enabled(self) -> list[Layer]:
        return [layer for layer in self.layers if layer.options.enabled]

    def _of(self, kind: type[_Kind]) -> list[_Kind]:
        return [layer for layer in self.layers if isinstance(layer, kind)]

    @property
    def _default(self) -> int:
        return UNKNOWN if self.options.track_unknown_space else FREE
