"""Frontiers: where what is free meets what is unknown (Yamauchi 1997)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import binary_dilation, label

from gazelle.mapping.grids import OccupancyGrid

__all__ = ["Frontier", "are_inside", "find_frontiers", "perimeter_m"]


def are_inside(points: ArrayLike, corners: ArrayLike) -> NDArray[np.bool_]:
    """Return which points lie in a polygon, by the number of edges to their right (even-odd).

    Args:
        points: (n, 2), m.
        corners: (m, 2), m, in order; the last one is joined to the first. With fewer than three
            nothing lies inside.
    """
    x, y = np.asarray(points, float).reshape(-1, 2).T
    inside = np.zeros(len(x), np.bool_)
    around = np.asarray(corners, float).reshape(-1, 2)
    for (ax, ay), (bx, by) in zip(around, np.roll(around, 1, axis=0), strict=True):
        if ay != by:
            crosses = (ay > y) != (by > y)
            inside ^= crosses & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    return inside


def perimeter_m(corners: ArrayLike) -> float:
    """Return the length of a polygon's outline; (m, 2) corners, m."""
    around = np.asarray(corners, float).reshape(-1, 2)
    return float(np.hypot(*(around - np.roll(around, 1, axis=0)).T).sum())


_AROUND = np.ones((3, 3), dtype=bool)

_BESIDE = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]], dtype=bool)


class Frontier(NamedTuple):
    """One connected piece of the border of the unknown.

    Attributes:
        size_m: length of the piece: its cells times their side.
        centroid_m: mean of its cells, (x, y); it need not be free itself.
        nearest_m: its cell nearest to the robot, (x, y).
        distance_m: of that cell from the robot, in the air.
        cost: the lower, the better to go there next.
    """

    size_m: float
    centroid_m: tuple[float, float]
    nearest_m: tuple[float, float]
    distance_m: float
    cost: float


def find_frontiers(
    grid: OccupancyGrid,
    robot_m: tuple[float, float],
    *,
    least_size_m: float = 0.5,
    free_below: int = 50,
    potential_scale: float = 1e-3,
    gain_scale: float = 1.0,
) -> list[Frontier]:
    """Return the frontiers that the robot can reach over free cells, the best first.

    Args:
        grid: of a map or a global costmap.
        robot_m: where the robot is, (x, y), in the grid's frame.
        least_size_m: smaller pieces are left out.
        free_below: cells of this occupancy are no longer free.
        potential_scale: weight of the distance in cells, as explore_lite's.
        gain_scale: weight of the size in cells.
    """
    free = (grid.cells >= 0) & (grid.cells < free_below)
    reached = _reached(grid, free, robot_m)
    edge = (grid.cells < 0) & binary_dilation(reached, _BESIDE)
    pieces, count = label(edge, structure=_AROUND)
    rows, columns = np.nonzero(edge)
    names = pieces[rows, columns]
    found = []
    for name in range(1, count + 1):
        own = names == name
        x, y = grid.cell_to_world(columns[own], rows[own])
        size_m = len(x) * grid.resolution_m
        if size_m >= least_size_m:
            far = np.hypot(x - robot_m[0], y - robot_m[1])
            at = int(far.argmin())
            cells = far[at] / grid.resolution_m
            cost = potential_scale * cells * grid.resolution_m - gain_scale * size_m
            center = float(x.mean()), float(y.mean())
            nearest = float(x[at]), float(y[at])
            found.append(Frontier(size_m, center, nearest, float(far[at]), float(cost)))
    return sorted(found, key=lambda one: one.cost)


def _reached(
    grid: OccupancyGrid, free: NDArray[np.bool_], robot_m: tuple[float, float]
) -> NDArray[np.bool_]:
    """Return the free cells that hang together with the robot's, or with those nearest to it."""
    parts, count = label(free, structure=_BESIDE)
    if not count:
        return np.zeros_like(free)
    column, row = (int(value) for value in grid.world_to_cell(*robot_m))
    rows, columns = np.nonzero(free)
    at = int(((rows - row) ** 2 + (columns - column) ** 2).argmin())
    return np.asarray(parts == parts[rows[at], columns[at]])
