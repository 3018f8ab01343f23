"""Search of wide windows by branch and bound, for places seen before."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.matching import kernels
from gazelle.mapping.matching.field import Field
from gazelle.mapping.poses import Poses

__all__ = ["WideMatch", "best_of_sectors", "wide_search"]

_DEEPEST = 7


class WideMatch(NamedTuple):
    """The best pose of a window.

    Attributes:
        pose: to a cell.
        value: mean value of the points there.
    """

    pose: Poses
    value: float


def wide_search(
    field: Field,
    points_m: NDArray[np.float64],
    center: Poses,
    *,
    reach_m: float,
    reach_rad: float,
    least: float,
) -> WideMatch | None:
    """Return the best pose within a window, to a cell, None when its mean value is too low.

    Args:
        field: what is matched with; its cells are the steps of the search.
        points_m: in the robot's frame, (n, 2).
        center: of the window.
        reach_m: half side of the window.
        reach_rad: the same for turns.
        least: mean value that must be exceeded.
    """
    found = _searched(field, points_m, center, reach_m, reach_rad, least, sectors=1)
    return found[0] if found else None


def best_of_sectors(
    field: Field,
    points_m: NDArray[np.float64],
    center: Poses,
    *,
    reach_m: float,
    reach_rad: float,
    sector_rad: float,
    least: float,
) -> list[WideMatch]:
    """Return the best pose of every sector of turns, to a cell, as far as they exceed a value.

    Args:
        field: what is matched with; its cells are the steps of the search.
        points_m: in the robot's frame, (n, 2).
        center: of the window.
        reach_m: half side of the window.
        reach_rad: the same for turns.
        sector_rad: width of a sector, about.
        least: mean value that must be exceeded.
    """
    sectors = max(1, round(2 * reach_rad / sector_rad))
    return _searched(field, points_m, center, reach_m, reach_rad, least, sectors=sectors)


def _searched(
    field: Field,
    points_m: NDArray[np.float64],
    center: Poses,
    reach_m: float,
    reach_rad: float,
    least: float,
    *,
    sectors: int,
) -> list[WideMatch]:
    if not len(points_m):
        return []
    reach = max(1, math.ceil(reach_m / field.cell_m))
    depth = min(_DEEPEST, max(1, int(math.log2(reach)) + 1))
    turns = _turns(points_m, field.cell_m, reach_rad)
    levels = _levels(field.values, depth)
    starts = np.arange(-reach, reach + 1, 1 << (depth - 1))
    offsets = np.stack(np.meshgrid(starts, starts), axis=-1).reshape(-1, 2).astype(np.int64)
    found: list[WideMatch] = []
    for part in np.array_split(turns, sectors):
        cells = _cells(field, points_m, center, part)
        turn, columns, rows, value = kernels.bound_search(levels, cells, offsets, reach, least)
        if turn >= 0:
            x, y = center[0] + columns * field.cell_m, center[1] + rows * field.cell_m
            found.append(WideMatch(np.array([x, y, center[2] + part[turn]]), float(value)))
    return found


def _turns(points_m: NDArray[np.float64], cell_m: float, reach_rad: float) -> NDArray[np.float64]:
    """Return turns that move the farthest point by about a cell each (Olson 2009)."""
    farthest = float(np.sqrt((points_m**2).sum(axis=1).max()))
    step = max(0.01, cell_m / max(farthest, cell_m))
    count = math.ceil(reach_rad / step)
    return np.asarray(np.arange(-count, count + 1) * step, dtype=np.float64)


def _cells(
    field: Field, points_m: NDArray[np.float64], center: Poses, turns: NDArray[np.float64]
) -> NDArray[np.int64]:
    yaw = center[2] + turns[:, None]
    cos, sin = np.cos(yaw), np.sin(yaw)
    x = cos * points_m[:, 0] - sin * points_m[:, 1] + center[0] - field.x_m
    y = sin * points_m[:, 0] + cos * points_m[:, 1] + center[1] - field.y_m
    return np.floor(np.stack([x, y], axis=-1) / field.cell_m).astype(np.int64)


def _levels(values: NDArray[np.float32], depth: int) -> NDArray[np.float32]:
    levels = np.empty((depth, *values.shape), np.float32)
    levels[0] = values
    for h in range(1, depth):
        levels[h] = kernels.sliding(levels[h - 1], 1 << (h - 1))
    return levels
