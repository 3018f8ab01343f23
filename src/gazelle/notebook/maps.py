"""Occupancy grids, costmaps, maps that SLAM made, and paths of robots on the ground."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.notebook.cameras import pixels_bundle
from gazelle.notebook.charts import COLOURS, plane_of, scale_bar, sheet_bundle
from gazelle.notebook.drawing import Dots, Raster, Sheet, Stroke
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.mapping.grids.occupancy_grid import OccupancyGrid
    from gazelle.mapping.slam.slam_engine import SlamResult
    from gazelle.navigation.costmap.cost_grid import CostGrid
    from gazelle.navigation.costmap.layered_costmap import LayeredCostmap
    from gazelle.navigation.planners.planner import Plan

__all__ = [
    "cost_grid_bundle",
    "grid_bundle",
    "layered_costmap_bundle",
    "path_bundle",
    "plan_bundle",
    "slam_bundle",
]

Cells = NDArray[np.int8]
Pixels = NDArray[np.uint8]
_MAX_CELLS = 960
_MAX_POSES = 2000
_LETHAL, _INSCRIBED, _NO_INFORMATION = 254, 253, 255


def grid_bundle(grid: OccupancyGrid) -> Bundle:
    """Return a map as map_saver would draw it, y upwards."""
    return pixels_bundle(_grid_pixels(grid.cells), _grid_text(grid), is_crisp=True)


def cost_grid_bundle(grid: CostGrid) -> Bundle:
    """Return costs as RViz colours them: from blue to red, lethal is magenta."""
    costs = grid.costs
    lethal = int((costs == _LETHAL).sum())
    caption = f"{_extent_text(costs.shape, grid.resolution_m)}, {lethal} lethal cells"
    return pixels_bundle(_cost_colours()[_worst(costs)[::-1]], caption, is_crisp=True)


def layered_costmap_bundle(costmap: LayeredCostmap) -> Bundle:
    """Return the costs of all layers together."""
    return cost_grid_bundle(costmap.grid)


def slam_bundle(result: SlamResult) -> Bundle:
    """Return a map with the way that the robot went."""
    grid, way = result.grid, np.asarray(result.trajectory)[:, :2]
    x, y, yaw = grid.origin
    if abs(yaw) > 1e-9:
        return grid_bundle(grid)
    size = np.array([grid.width, grid.height]) * grid.resolution_m
    corners = np.array([[x, y], [x + size[0], y + size[1]]])
    plane, width, height = plane_of(corners, size_px=520.0, margin=0.0)
    left, top = plane.place([[x, y + size[1]]])[0].tolist()
    box = (left, top, size[0] * plane.px_per_m, size[1] * plane.px_per_m)
    items: list[Any] = [Raster(_rgb(_grid_pixels(grid.cells)), box), *_way(plane, way)]
    words = f"{_grid_text(grid)}, {len(way)} poses, {result.loops} loops closed"
    return sheet_bundle(Sheet(width, height, tuple(items)), words)


def plan_bundle(plan: Plan) -> Bundle:
    """Return a planned path from above."""
    return path_bundle(plan.poses[:, :2], f"{plan.length_m:.2f} m, cost {plan.cost:.6g}")


def path_bundle(points_m: ArrayLike, caption: str = "") -> Bundle:
    """Return points (N, 2) of a path from above: green where it begins, red where it ends."""
    points = np.asarray(points_m, np.float64).reshape(-1, 2)
    plane, width, height = plane_of(points)
    items = [*_way(plane, points), *scale_bar(plane, width, height)]
    words = f"{len(points)} poses"
    return sheet_bundle(
        Sheet(width, height + 14.0, tuple(items)), f"{words}, {caption}" if caption else words
    )


def _way(plane: Any, points_m: NDArray[np.float64]) -> list[Any]:
    kept = points_m[_every(len(points_m))]
    if not len(kept):
        return []
    places = plane.place(kept)
    return [
        Stroke(places, COLOURS[0], 2.0),
        Dots(places[:1], COLOURS[2], 5.0),
        Dots(places[-1:], COLOURS[3], 5.0),
    ]


def _every(count: int) -> NDArray[np.int64]:
    """Return at most 2000 places in a list, first and last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, _MAX_POSES)).astype(np.int64))


def _grid_pixels(cells: Cells) -> Pixels:
    from gazelle.mapping.grids.pixels import MapMode, pixels_of_cells

    return pixels_of_cells(_worst(cells), MapMode.TRINARY)[..., 0]


def _worst(cells: NDArray[Any]) -> NDArray[Any]:
    """Return at most 960×960 cells: of a block the most occupied, so that thin walls stay."""
    size = math.ceil(max(cells.shape) / _MAX_CELLS)
    if size <= 1:
        return cells
    rows, columns = (length // size * size for length in cells.shape)
    if not rows or not columns:
        return cells[::size, ::size]
    blocks = cells[:rows, :columns].reshape(rows // size, size, columns // size, size)
    known = np.where(blocks == _NO_INFORMATION, 0, blocks) if cells.dtype == np.uint8 else blocks
    worst = known.max(axis=(1, 3))
    if cells.dtype == np.uint8:
        worst = np.where((blocks == _NO_INFORMATION).all(axis=(1, 3)), _NO_INFORMATION, worst)
    return np.asarray(worst, cells.dtype)


def _rgb(grey: Pixels) -> Pixels:
    return np.repeat(grey[..., None], 3, axis=2)


def _grid_text(grid: OccupancyGrid) -> str:
    cells = grid.cells
    known = float((cells >= 0).mean()) if cells.size else 0.0
    return f"{_extent_text(cells.shape, grid.resolution_m)}, {100 * known:.0f} % known"


def _extent_text(shape: tuple[int, ...], resolution_m: float) -> str:
    height, width = shape
    size = f"{width * resolution_m:.2f}×{height * resolution_m:.2f} m"
    return f"{width}×{height} cells of {resolution_m:g} m ({size})"


def _cost_colours() -> Pixels:
    """RViz's costmap palette."""
    table = np.empty((256, 3), np.uint8)
    level = np.arange(256)
    table[:, 0] = level
    table[:, 1] = 0
    table[:, 2] = 255 - level
    table[0] = (255, 255, 255)
    table[_INSCRIBED] = (0, 255, 255)
    table[_LETHAL] = (255, 0, 255)
    table[_NO_INFORMATION] = (112, 137, 134)
    return table
