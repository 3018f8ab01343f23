# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled searches of planners; see `gazelle.navigation.costmap.costmap_kernels`.

Cells are numbered along rows. `table` has the cost of entering a cell by its cost in the costmap;
what is not below `FORBIDDEN` is not entered.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = [
    "FORBIDDEN",
    "HIGH",
    "descend_cells",
    "descend_gradient",
    "navfn_potential",
    "smooth_path",
]

HIGH = 1e10
"""Potential of what was not reached."""
FORBIDDEN = 1e6
"""Cost of entering what must not be entered."""


@kernel
def navfn_potential(costs, table, start, stop, quadratic, threshold, increment):
    """Spread a potential from one cell until another one is reached; −1 for all cells.

    The update of a cell from its two lowest neighbours of four is a planar wave, by the quadratic
    approximation of NavFn (Brock and Khatib 1999; Konolige's navfn). Cells wait in two blocks, one
    for potentials below a threshold that grows, one for those above.
    """
    height, width = costs.shape
    n = height * width
    flat = costs.ravel()
    potential = np.empty(n, np.float32)
    pending = np.empty(n, np.bool_)
    for k in range(n):
        potential[k] = HIGH
        pending[k] = False
    current = np.empty(n, np.int32)
    following = np.empty(n, np.int32)
    later = np.empty(n, np.int32)
    potential[start] = 0.0
    m = 0
    for q in (start + 1, start - 1, start - width, start + width):
        if 0 <= q < n and table[flat[q]] < FORBIDDEN:
            current[m] = q
            pending[q] = True
            m += 1
    most = 0
    far = 0
    while m > 0:
        for k in range(m):
            pending[current[k]] = False
        most = 0
        for k in range(m):
            c = current[k]
            x = c % width
            y = c // width
            if x == 0 or y == 0 or x == width - 1 or y == height - 1:
                continue
            left = potential[c - 1]
            right = potential[c + 1]
            up = potential[c - width]
            down = potential[c + width]
            a = min(left, right)
            b = min(up, down)
            low = min(a, b)
            gap = abs(a - b)
            step = table[flat[c]]
            if step >= FORBIDDEN:
                continue
            if not quadratic or gap >= step:
                new = low + step
            else:
                d = gap / step
                new = low + step * (-0.2301 * d * d + 0.5307 * d + 0.7040)
            if new >= potential[c]:
                continue
            potential[c] = new
            near = new < threshold
            for side in range(4):
                q = c - 1 if side == 0 else c + 1
                if side == 2:
                    q = c - width
                elif side == 3:
                    q = c + width
                if pending[q]:
                    continue
                cost = table[flat[q]]
                if cost >= FORBIDDEN or potential[q] <= new + 0.70710677 * cost:
                    continue
                pending[q] = True
                if near:
                    following[most] = q
                    most += 1
                else:
                    later[far] = q
                    far += 1
        current, following = following, current
        m = most
        if m == 0:
            threshold += increment
            current, later = later, current
            m = far
            far = 0
        if stop >= 0 and potential[stop] < HIGH:
            break
    return potential


@kernel
def _lowest(potential, width, height, x, y):
    best = y * width + x
    for v in range(max(y - 1, 0), min(y + 2, height)):
        for u in range(max(x - 1, 0), min(x + 2, width)):
            if potential[v * width + u] < potential[best]:
                best = v * width + u
    return best


@kernel
def descend_cells(potential, width, start, goal):
    """Return cells from `start` down to `goal`, the lowest of eight neighbours each time."""
    height = potential.shape[0] // width
    # Each is lower than the one before, so none comes twice.
    cells = np.empty(potential.shape[0], np.int64)
    cells[0], count = start, 1
    while cells[count - 1] != goal:
        c = cells[count - 1]
        lower = _lowest(potential, width, height, c % width, c // width)
        if lower == c:
            return np.empty(0, np.int64)
        cells[count] = lower
        count += 1
    return cells[:count].copy()


@kernel
def _slope(potential, width, height, c):
    """Return the direction downwards at a cell, of length one or zero."""
    x = c % width
    y = c // width
    if x == 0 or y == 0 or x == width - 1 or y == height - 1:
        return 0.0, 0.0
    here = potential[c]
    dx = 0.0
    dy = 0.0
    if here >= HIGH:
        # Away from the obstacle that this cell is.
        if potential[c - 1] < HIGH:
            dx = -1.0
        elif potential[c + 1] < HIGH:
            dx = 1.0
        if potential[c - width] < HIGH:
            dy = -1.0
        elif potential[c + width] < HIGH:
            dy = 1.0
    else:
        if potential[c - 1] < HIGH:
            dx += potential[c - 1] - here
        if potential[c + 1] < HIGH:
            dx += here - potential[c + 1]
        if potential[c - width] < HIGH:
            dy += potential[c - width] - here
        if potential[c + width] < HIGH:
            dy += here - potential[c + width]
    length = math.hypot(dx, dy)
    if length == 0.0:
        return 0.0, 0.0
    return dx / length, dy / length


@kernel
def descend_gradient(potential, width, start, goal, step):
    """Return points (cells, with fractions; centres are whole numbers) down the gradient.

    Gradients of the four cells around a point are interpolated; near what was not reached the way
    goes from cell to cell. Empty when it does not arrive.
    """
    height = potential.shape[0] // width
    most = 16 * (width + height) + 1000
    points = np.empty((most, 2))
    gx = goal % width
    gy = goal // width
    x = float(start % width)
    y = float(start // width)
    last = HIGH * 10
    stuck = 0
    for k in range(most):
        points[k, 0] = x
        points[k, 1] = y
        if abs(x - gx) <= 1.0 and abs(y - gy) <= 1.0:
            # The first point stays, so that the way still ends where it is to end.
            last_k = max(k, 1) if start != goal else k
            points[last_k, 0] = gx
            points[last_k, 1] = gy
            return points[: last_k + 1].copy()
        cx = math.floor(x)
        cy = math.floor(y)
        here = round(y) * width + round(x)
        if potential[here] < last - 1e-3:
            last = potential[here]
            stuck = 0
        else:
            stuck += 1
        inside = 1 <= cx < width - 2 and 1 <= cy < height - 2
        smooth = inside and stuck < 8
        if smooth:
            for v in range(cy - 1, cy + 3):
                for u in range(cx - 1, cx + 3):
                    if potential[v * width + u] >= HIGH:
                        smooth = False
        if smooth:
            fx = x - cx
            fy = y - cy
            c = cy * width + cx
            ax, ay = _slope(potential, width, height, c)
            bx, by = _slope(potential, width, height, c + 1)
            ex, ey = _slope(potential, width, height, c + width)
            hx, hy = _slope(potential, width, height, c + width + 1)
            dx = (1 - fy) * ((1 - fx) * ax + fx * bx) + fy * ((1 - fx) * ex + fx * hx)
            dy = (1 - fy) * ((1 - fx) * ay + fx * by) + fy * ((1 - fx) * ey + fx * hy)
            length = math.hypot(dx, dy)
            if length > 1e-6:
                x += step * dx / length
                y += step * dy / length
                continue
        lower = _lowest(potential, width, height, round(x), round(y))
        if lower == here and stuck > 0 and abs(x - round(x)) + abs(y - round(y)) < 1e-9:
            return points[:0].copy()
        x = float(lower % width)
        y = float(lower // width)
    return points[:0].copy()


@kernel
def smooth_path(points, costs, table, keep, pull, rounds):
    """Pull the points of a path (cells, centres are whole numbers) straight, in place.

    A point moves towards where it was by `keep` and towards its neighbours' middle by `pull`; moves
    into what is forbidden or costs more are not made.
    """
    original = points.copy()
    for _round in range(rounds):
        moved = 0.0
        for k in range(1, points.shape[0] - 1):
            x = points[k, 0]
            y = points[k, 1]
            u = x + keep * (original[k, 0] - x)
            v = y + keep * (original[k, 1] - y)
            u += pull * (points[k - 1, 0] + points[k + 1, 0] - 2 * x)
            v += pull * (points[k - 1, 1] + points[k + 1, 1] - 2 * y)
            new = table[costs[round(v), round(u)]]
            old = table[costs[round(y), round(x)]]
            if new >= FORBIDDEN or new > max(old, 1.5):
                continue
            points[k, 0] = u
            points[k, 1] = v
            moved += abs(u - x) + abs(v - y)
        if moved < 1e-3 * points.shape[0]:
            break
