# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled inner loop of judging a pose by what beams went through."""

from __future__ import annotations

import math

from gazelle.compiling import njit

__all__ = ["contradictions"]


@njit(cache=True, nogil=True)
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
