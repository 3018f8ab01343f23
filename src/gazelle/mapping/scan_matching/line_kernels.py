# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled inner loops of matching points with lines.

Sums are float64 (n, 6): count, Σx, Σy, Σx², Σxy, Σy² of the points in a cell, seen from the middle
of the grid, so that squares stay small. A grid of int32 says which row is a cell's; row 0, of empty
cells, is zero. Walls fill few of the cells. Both are a `match_arguments.Lines`.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit
from gazelle.mapping.scan_matching.step_kernels import emptied, stepped

__all__ = ["accumulate", "refine_on_lines"]


@njit(cache=True, nogil=True)
def accumulate(lines, points):
    """Add points, (n, 2), to the sums of their cells; return how many rows are in use.

    Args:
        lines: its `places` zero at first, filled; its `sums`, (n + 1, 6), filled as far as used.
        points: (n, 2).
    """
    places, sums, x0, y0, cell = lines.places, lines.sums, lines.x_m, lines.y_m, lines.cell_m
    height, width = places.shape
    mx, my = x0 + 0.5 * width * cell, y0 + 0.5 * height * cell
    sums[0] = 0.0
    used = 1
    # Flat and unsigned: negative indices need not be looked for.
    flat = places.reshape(height * width)
    for i in range(points.shape[0]):
        gx, gy = (points[i, 0] - x0) / cell, (points[i, 1] - y0) / cell
        if 0 <= gx < width and 0 <= gy < height:
            place = np.uint64(int(gy) * width + int(gx))
            if flat[place] == 0:
                flat[place] = used
                sums[used] = 0.0
                used += 1
            x, y = points[i, 0] - mx, points[i, 1] - my
            cells = sums[np.uint64(flat[place])]
            cells[0] += 1.0
            cells[1] += x
            cells[2] += y
            cells[3] += x * x
            cells[4] += x * y
            cells[5] += y * y
    return used


@njit(cache=True, nogil=True)
def _line(places, sums, row, column, fewest, widest, out):
    """Fit a line to the points of 3 × 3 cells; out is its point and normal. Tells if it is one."""
    n = sx = sy = sxx = sxy = syy = 0.0
    for a in range(row - 1, row + 2):
        for b in range(column - 1, column + 2):
            cells = sums[places[a, b]]
            n += cells[0]
            sx += cells[1]
            sy += cells[2]
            sxx += cells[3]
            sxy += cells[4]
            syy += cells[5]
    if n < fewest:
        return False
    mx, my = sx / n, sy / n
    vxx, vxy, vyy = sxx / n - mx * mx, sxy / n - mx * my, syy / n - my * my
    middle, half = 0.5 * (vxx + vyy), 0.5 * (vxx - vyy)
    spread = math.sqrt(half * half + vxy * vxy)
    across, along = max(0.0, middle - spread), middle + spread
    if across > widest * widest or across > 0.15 * along:
        return False
    angle = 0.5 * math.atan2(2 * vxy, vxx - vyy)
    out[0], out[1], out[2], out[3] = mx, my, -math.sin(angle), math.cos(angle)
    return True


@njit(cache=True, nogil=True)
def refine_on_lines(walls, points, guess, prior, terms, iterations):
    """Minimise the distances of points from the lines around them, and from a prior.

    Args:
        walls: what lines they are, see the module.
        points: in the robot's frame, (n, 2).
        guess: pose to begin with.
        prior: what is expected, a `match.Prior`.
        terms: which points lie on which lines, a `match_arguments.LineTerms`.
        iterations: at most.

    Returns:
        The pose, the information of the distances, and how many points have lines.
    """
    places, sums, x0, y0, cell = walls.places, walls.sums, walls.x_m, walls.y_m, walls.cell_m
    height, width = places.shape
    middle_x, middle_y = x0 + 0.5 * width * cell, y0 + 0.5 * height * cell
    sigma, farthest, fewest, widest = (
        terms.sigma_m, terms.farthest_m, terms.fewest, terms.widest_m,
    )  # fmt: skip
    pose, slope, step = np.empty(3), np.empty(3), np.empty(3)
    data = np.empty((3, 3))
    for k in range(3):
        pose[k] = guess[k]
    # Points hardly move from one step to the next: their lines are those of the same cells.
    count = points.shape[0]
    known = np.empty(count, np.int64)
    are_lines = np.empty(count, np.bool_)
    lines = np.empty((count, 4))
    for i in range(count):
        known[i] = -1
    used = 0
    for _ in range(iterations):
        emptied(data, slope)
        used = 0
        c, s = math.cos(pose[2]), math.sin(pose[2])
        for i in range(count):
            rx = c * points[i, 0] - s * points[i, 1]
            ry = s * points[i, 0] + c * points[i, 1]
            x, y = rx + pose[0], ry + pose[1]
            column, row = math.floor((x - x0) / cell), math.floor((y - y0) / cell)
            if column < 1 or row < 1 or column >= width - 1 or row >= height - 1:
                continue
            line = lines[i]
            if known[i] != row * width + column:
                known[i] = row * width + column
                are_lines[i] = _line(places, sums, row, column, fewest, widest, line)
            if not are_lines[i]:
                continue
            nx, ny = line[2], line[3]
            off = nx * (x - middle_x - line[0]) + ny * (y - middle_y - line[1])
            if abs(off) > farthest:
                continue
            # Tukey's biweight.
            share = 1.0 - (off / farthest) ** 2
            weight = share * share / (sigma * sigma)
            nt = ny * rx - nx * ry
            used += 1
            data[0, 0] += weight * nx * nx
            data[0, 1] += weight * nx * ny
            data[0, 2] += weight * nx * nt
            data[1, 1] += weight * ny * ny
            data[1, 2] += weight * ny * nt
            data[2, 2] += weight * nt * nt
            slope[0] -= weight * nx * off
            slope[1] -= weight * ny * off
            slope[2] -= weight * nt * off
        stepped(data, slope, 1.0, prior.information, pose, prior.pose, 1e-6, step)
        for k in range(3):
            pose[k] += step[k]
        if abs(step[0]) < 1e-4 and abs(step[1]) < 1e-4 and abs(step[2]) < 1e-5:
            break
    return pose, data, used
