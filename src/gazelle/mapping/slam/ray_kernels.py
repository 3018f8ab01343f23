# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled loops along beams: drawing maps, and what contradicts a pose."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.kernels import kernel

__all__ = ["BeamCounts", "contradictions", "count_beams"]


@kernel
def contradictions(counts, lidar, points, margin):
    """Count beams that end where others passed, or pass where others ended.

    Args:
        counts: `ray_kernels.BeamCounts`.
        lidar: (x, y), where the beams begin.
        points: (n, 2), where they end.
        margin: a beam passes so much before its end, metres.
    """
    hits, passes, x0, y0, cell = counts.hits, counts.passes, counts.x_m, counts.y_m, counts.cell_m
    height, width = hits.shape
    against = 0
    for i in range(points.shape[0]):
        dx, dy = points[i, 0] - lidar[0], points[i, 1] - lidar[1]
        length = math.hypot(dx, dy)
        column = math.floor((points[i, 0] - x0) / cell)
        row = math.floor((points[i, 1] - y0) / cell)
        if 1 <= column < width - 1 and 1 <= row < height - 1:
            passed, ended = 0, 0
            for a in range(row - 1, row + 2):
                for b in range(column - 1, column + 2):
                    ended += hits[a, b]
                    passed += passes[a, b] > 0
            if ended == 0 and passed == 9:
                against += 1
                continue
        before = length - margin
        at = margin
        while at < before:
            column = math.floor((lidar[0] + dx / length * at - x0) / cell)
            row = math.floor((lidar[1] + dy / length * at - y0) / cell)
            is_inside = 0 <= column < width and 0 <= row < height
            ended = hits[row, column] if is_inside else 0
            # Where most beams ended is a wall, not somebody who stood there.
            if ended > 2 and 2 * ended > passes[row, column]:
                against += 1
                break
            at += cell
    return against


class BeamCounts(NamedTuple):
    """How many beams met the cells of a grid.

    Attributes:
        hits: int32 (height, width), how many ended in each.
        passes: int32 (height, width), how many reached it.
        x_m, y_m: lower left corner.
        cell_m: side of a cell.
    """

    hits: NDArray[np.int32]
    passes: NDArray[np.int32]
    x_m: float
    y_m: float
    cell_m: float


@kernel
def count_beams(counts, lidar, directions, ranges, limit):
    """Count for every cell the beams that ended in it, and those that reached it.

    Args:
        counts: `BeamCounts`, raised.
        lidar: (x, y, yaw), of which the place counts.
        directions: of the beams in the map, radians.
        ranges: of the beams, NaN for those that say nothing.
        limit: beams that are longer count up to here and end nowhere.
    """
    hits, passes, x0, y0, cell = counts.hits, counts.passes, counts.x_m, counts.y_m, counts.cell_m
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
