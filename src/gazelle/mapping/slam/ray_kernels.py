# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, PLR0917
"""The compiled inner loop of drawing maps."""

from __future__ import annotations

import math

from gazelle.compiling import njit

__all__ = ["count_beams"]


@njit(cache=True, nogil=True)
def count_beams(hits, passes, x0, y0, cell, lidar, directions, ranges, limit):
    """Count for every cell the beams that ended in it, and those that reached it.

    Args:
        hits: int32 (height, width), raised.
        passes: the same.
        x0: lower left corner of the grid, metres.
        y0: the same.
        cell: side of a cell, metres.
        lidar: (x, y, yaw), of which the place counts.
        directions: of the beams in the map, radians.
        ranges: of the beams, NaN for those that say nothing.
        limit: beams that are longer count up to here and end nowhere.
    """
    height, width = hits.shape
    for i in range(ranges.shape[0]):
        length = ranges[i]
        if not length > 0.0:
            continue
        ends = length <= limit
        length = min(length, limit)
        dx, dy = math.cos(directions[i]), math.sin(directions[i])
        gx, gy = (lidar[0] - x0) / cell, (lidar[1] - y0) / cell
        column, row = math.floor(gx), math.floor(gy)
        last_column = math.floor(gx + dx * length / cell)
        last_row = math.floor(gy + dy * length / cell)
        step_x, step_y = (1 if dx > 0 else -1), (1 if dy > 0 else -1)
        # Amanatides and Woo (1987): every cell that the beam crosses.
        per_x = math.inf if dx == 0 else abs(1.0 / dx)
        per_y = math.inf if dy == 0 else abs(1.0 / dy)
        next_x = math.inf if dx == 0 else ((column + (step_x > 0)) - gx) / dx
        next_y = math.inf if dy == 0 else ((row + (step_y > 0)) - gy) / dy
        crossings = abs(last_column - column) + abs(last_row - row)
        for _ in range(crossings):
            if 0 <= column < width and 0 <= row < height:
                passes[row, column] += 1
            if next_x < next_y:
                next_x += per_x
                column += step_x
            else:
                next_y += per_y
                row += step_y
        if ends and 0 <= last_column < width and 0 <= last_row < height:
            passes[last_row, last_column] += 1
            hits[last_row, last_column] += 1
