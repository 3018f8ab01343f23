# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled loops of costmaps: rays, distances, outlines.

Kernels hold no Python object and release the interpreter lock.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = [
    "clear_rays",
    "fill_polygon",
    "inflate_window",
    "mark_points",
    "outline_cost",
    "squared_distances",
]

_FAR = 1 << 30


@kernel
def clear_rays(costs, ox, oy, ends, min_cells, max_cells, bounds):
    """Set cells on the way from a sensor to what it saw free; the last cell is not touched.

    Coordinates are in cells, with fractions. `bounds` is x0, y0, x1, y1 of what was touched so far
    and is extended.
    """
    height, width = costs.shape
    x0 = math.floor(ox)
    y0 = math.floor(oy)
    if x0 < 0 or y0 < 0 or x0 >= width or y0 >= height:
        return False
    for k in range(ends.shape[0]):
        ex = ends[k, 0]
        ey = ends[k, 1]
        dx = ex - ox
        dy = ey - oy
        share = 1.0
        if ex < 0:
            share = min(share, ox / -dx)
        if ey < 0:
            share = min(share, oy / -dy)
        if ex >= width:
            share = min(share, (width - 1e-6 - ox) / dx)
        if ey >= height:
            share = min(share, (height - 1e-6 - oy) / dy)
        length = math.hypot(dx, dy)
        if length * share > max_cells:
            share = max_cells / length
        x1 = min(max(math.floor(ox + share * dx), 0), width - 1)
        y1 = min(max(math.floor(oy + share * dy), 0), height - 1)
        ax = abs(x1 - x0)
        ay = abs(y1 - y0)
        sx = 1 if x1 > x0 else -1
        sy = 1 if y1 > y0 else -1
        steps = max(ax, ay)
        x = x0
        y = y0
        error = steps // 2
        near = min_cells * min_cells
        for step in range(steps + 1):
            # The cell in which the beam ended is the obstacle's.
            if step == steps and share >= 1.0:
                break
            if near == 0.0 or (x - x0) ** 2 + (y - y0) ** 2 >= near:
                costs[y, x] = 0
            if ax >= ay:
                x += sx
                error += ay
            else:
                y += sy
                error += ax
            if error >= steps:
                error -= steps
                if ax >= ay:
                    y += sy
                else:
                    x += sx
        bounds[0] = min(bounds[0], x0, x1)
        bounds[1] = min(bounds[1], y0, y1)
        bounds[2] = max(bounds[2], x0 + 1, x1 + 1)
        bounds[3] = max(bounds[3], y0 + 1, y1 + 1)
    return True


@kernel
def mark_points(costs, ox, oy, points, min_cells, max_cells, bounds):
    """Set the cells of points within reach of the sensor lethal; see `clear_rays`."""
    height, width = costs.shape
    for k in range(points.shape[0]):
        px = points[k, 0]
        py = points[k, 1]
        square = (px - ox) ** 2 + (py - oy) ** 2
        if square >= max_cells * max_cells or square < min_cells * min_cells:
            continue
        x = math.floor(px)
        y = math.floor(py)
        if x < 0 or y < 0 or x >= width or y >= height:
            continue
        costs[y, x] = 254
        bounds[0] = min(bounds[0], x)
        bounds[1] = min(bounds[1], y)
        bounds[2] = max(bounds[2], x + 1)
        bounds[3] = max(bounds[3], y + 1)


@kernel
def fill_polygon(costs, corners, value, bounds):
    """Set the cells of a convex polygon and of its outline; coordinates in cells.

    The outline counts as ``setConvexPolygonCost`` has it: what `outline_cost` looks at is free
    afterwards.
    """
    height, width = costs.shape
    n = corners.shape[0]
    low = height
    high = -1
    for k in range(n):
        low = min(low, math.floor(corners[k, 1]))
        high = max(high, math.floor(corners[k, 1]))
    for y in range(max(low, 0), min(high, height - 1) + 1):
        centre = y + 0.5
        left = 1e18
        right = -1e18
        for k in range(n):
            ax = corners[k, 0]
            ay = corners[k, 1]
            bx = corners[(k + 1) % n, 0]
            by = corners[(k + 1) % n, 1]
            if (ay <= centre) != (by <= centre):
                crossing = ax + (centre - ay) * (bx - ax) / (by - ay)
                left = min(left, crossing)
                right = max(right, crossing)
        first = max(math.ceil(left - 0.5), 0) if left < 1e17 else width
        last = min(math.floor(right - 0.5), width - 1) if left < 1e17 else -1
        if first > last:
            continue
        for x in range(first, last + 1):
            costs[y, x] = value
        bounds[0] = min(bounds[0], first)
        bounds[1] = min(bounds[1], y)
        bounds[2] = max(bounds[2], last + 1)
        bounds[3] = max(bounds[3], y + 1)
    for k in range(n):
        u = math.floor(corners[k, 0])
        v = math.floor(corners[k, 1])
        end_u = math.floor(corners[(k + 1) % n, 0])
        end_v = math.floor(corners[(k + 1) % n, 1])
        dx = abs(end_u - u)
        dy = abs(end_v - v)
        sx = 1 if end_u > u else -1
        sy = 1 if end_v > v else -1
        steps = max(dx, dy)
        error = steps // 2
        for _step in range(steps + 1):
            if 0 <= u < width and 0 <= v < height:
                costs[v, u] = value
                bounds[0] = min(bounds[0], u)
                bounds[1] = min(bounds[1], v)
                bounds[2] = max(bounds[2], u + 1)
                bounds[3] = max(bounds[3], v + 1)
            if dx >= dy:
                u += sx
                error += dy
            else:
                v += sy
                error += dx
            if error >= steps:
                error -= steps
                if dx >= dy:
                    v += sy
                else:
                    u += sx


@kernel
def squared_distances(seeds, reach):
    """Return squared distances in cells to the next seed, int32, exact up to `reach` cells.

    Two passes: along columns, then along rows over the lower envelope of parabolas (Felzenszwalb
    and Huttenlocher 2012, Distance Transforms of Sampled Functions). What is farther than `reach`
    in its column alone counts as infinitely far.
    """
    height, width = seeds.shape
    column = np.empty((height, width), np.int32)
    for x in range(width):
        column[0, x] = 0 if seeds[0, x] else _FAR
    for y in range(1, height):
        for x in range(width):
            if seeds[y, x]:
                column[y, x] = 0
            else:
                above = column[y - 1, x]
                column[y, x] = above + 1 if above < reach else _FAR
    for y in range(height - 2, -1, -1):
        for x in range(width):
            below = column[y + 1, x]
            if below < reach and below + 1 < column[y, x]:
                column[y, x] = below + 1
    result = np.empty((height, width), np.int32)
    place = np.empty(width, np.int64)
    start = np.empty(width + 1, np.float64)
    for y in range(height):
        count = 0
        for x in range(width):
            if column[y, x] >= _FAR:
                continue
            f = column[y, x] * column[y, x] + x * x
            cut = -1e18
            while count > 0:
                p = place[count - 1]
                cut = (f - column[y, p] * column[y, p] - p * p) / (2.0 * (x - p))
                if cut > start[count - 1]:
                    break
                count -= 1
            start[count] = cut if count > 0 else -1e18
            place[count] = x
            count += 1
        if count == 0:
            for x in range(width):
                result[y, x] = _FAR
            continue
        k = 0
        for x in range(width):
            while k + 1 < count and start[k + 1] < x:
                k += 1
            p = place[k]
            result[y, x] = column[y, p] * column[y, p] + (x - p) * (x - p)
    return result


@kernel
def inflate_window(costs, window, table, reach, inflate_unknown, around_unknown):
    """Raise costs in a window, a `grid.Window`, by what lies in it and around it.

    `table` has the cost by squared distance in cells, up to reach².
    """
    x0, y0, x1, y1 = window.x0, window.y0, window.x1, window.y1
    height, width = costs.shape
    sx0 = max(x0 - reach, 0)
    sy0 = max(y0 - reach, 0)
    sx1 = min(x1 + reach, width)
    sy1 = min(y1 + reach, height)
    seeds = np.zeros((sy1 - sy0, sx1 - sx0), np.bool_)
    found = False
    for y in range(sy0, sy1):
        for x in range(sx0, sx1):
            c = costs[y, x]
            if c == 254 or (around_unknown and c == 255):
                seeds[y - sy0, x - sx0] = True
                found = True
    if not found:
        return
    distances = squared_distances(seeds, reach)
    most = table.shape[0]
    for y in range(y0, y1):
        for x in range(x0, x1):
            d = distances[y - sy0, x - sx0]
            if d >= most:
                continue
            new = table[d]
            old = costs[y, x]
            if old == 255:
                if (inflate_unknown and new > 0) or new >= 253:
                    costs[y, x] = new
            elif new > old:
                costs[y, x] = new


@kernel
def outline_cost(cells, corners, x, y, c, s, scale):
    """Return the highest cost under a robot's outline and its centre.

    −1 for a lethal cell, −2 for an unknown one, −3 for one outside the grid. `cells` are a
    `grid.CostCells`, `c` and `s` cosine and sine of the heading.
    """
    costs, ox, oy, inverse = cells.costs, cells.x_m, cells.y_m, cells.per_m
    n = corners.shape[0]
    height, width = costs.shape
    cx = math.floor((x - ox) * inverse)
    cy = math.floor((y - oy) * inverse)
    if cx < 0 or cy < 0 or cx >= width or cy >= height:
        return -3
    worst = int(costs[cy, cx])
    if worst == 255:
        return -2
    if worst == 254:
        return -1
    px = corners[n - 1, 0] * scale
    py = corners[n - 1, 1] * scale
    ax = math.floor((x + c * px - s * py - ox) * inverse)
    ay = math.floor((y + s * px + c * py - oy) * inverse)
    for k in range(n):
        px = corners[k, 0] * scale
        py = corners[k, 1] * scale
        bx = math.floor((x + c * px - s * py - ox) * inverse)
        by = math.floor((y + s * px + c * py - oy) * inverse)
        if ax < 0 or ay < 0 or ax >= width or ay >= height:
            return -3
        if bx < 0 or by < 0 or bx >= width or by >= height:
            return -3
        dx = abs(bx - ax)
        dy = abs(by - ay)
        sx = 1 if bx > ax else -1
        sy = 1 if by > ay else -1
        steps = max(dx, dy)
        error = steps // 2
        for _step in range(steps + 1):
            cost = int(costs[ay, ax])
            if cost >= 254:
                return -2 if cost == 255 else -1
            worst = max(worst, cost)
            if dx >= dy:
                ax += sx
                error += dy
            else:
                ay += sy
                error += dx
            if error >= steps:
                error -= steps
                if dx >= dy:
                    ay += sy
                else:
                    ax += sx
        ax = bx
        ay = by
    return worst
