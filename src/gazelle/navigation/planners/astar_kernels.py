# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled searches from cell to cell: A* and Theta*; see `kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.navigation.planners.navfn_kernels import FORBIDDEN, HIGH
from gazelle.priority_queue_kernels import sift_down, sift_up

__all__ = ["astar", "theta_star"]

_ROOT2 = math.sqrt(2.0)


@kernel
def _widened(values, wider):
    """Return `wider` with the values at its beginning."""
    for k in range(values.shape[0]):
        wider[k] = values[k]
    return wider


@kernel
def astar(costs, table, start, goal, reach, most):
    """Return (cells from start to goal, cost, cells looked at) by A* over eight neighbours.

    `table` is relative to one cell's length and at least 1. Of cells within `reach` of the goal
    the nearest one that is reached counts when the goal is not; the cells are empty when none is.

    Cells wait in buckets of a quarter cell's length instead of a heap; what is improved later is
    looked at again, and the search ends when no bucket below the goal's cost is left, so the cost
    is the least.
    """
    height, width = costs.shape
    n = height * width
    flat = costs.ravel()
    dearest = np.float32(1.0)
    for k in range(256):
        if table[k] < FORBIDDEN:
            dearest = max(dearest, table[k])
    buckets = int(8.0 * dearest + 8.0) + 8
    heads = np.empty(buckets, np.int32)
    for k in range(buckets):
        heads[k] = -1
    room = 65536
    cells = np.empty(room, np.int32)
    links = np.empty(room, np.int32)
    lengths = np.empty(room, np.float32)
    g = np.empty(n, np.float32)
    parent = np.empty(n, np.int32)
    for k in range(n):
        g[k] = HIGH
        parent[k] = -1
    gx = goal % width
    gy = goal // width
    diagonal = np.float32(_ROOT2)
    bend = np.float32(_ROOT2 - 1.0)
    g[start] = 0.0
    ax = abs(start % width - gx)
    ay = abs(start // width - gy)
    now = int(4.0 * (max(ax, ay) + bend * min(ax, ay)))
    cells[0] = start
    links[0] = -1
    lengths[0] = 0.0
    heads[now % buckets] = 0
    used = 1
    spare = -1
    waiting = 1
    best = -1
    nearest = reach * reach + 1e-6
    looked = 0
    while waiting > 0 and now <= 4.0 * g[goal]:
        entry = heads[now % buckets]
        if entry < 0:
            now += 1
            continue
        heads[now % buckets] = links[entry]
        waiting -= 1
        c = cells[entry]
        length = lengths[entry]
        links[entry] = spare
        spare = entry
        if length > g[c]:
            continue
        looked += 1
        x = c % width
        y = c // width
        away = (x - gx) * (x - gx) + (y - gy) * (y - gy)
        if away <= nearest:
            nearest = away - 1e-6
            best = c
        if most >= 0 and looked >= most:
            break
        for dy in range(-1, 2):
            v = y + dy
            if v < 0 or v >= height:
                continue
            for dx in range(-1, 2):
                u = x + dx
                if (dx == 0 and dy == 0) or u < 0 or u >= width:
                    continue
                q = v * width + u
                cost = table[flat[q]]
                if cost >= FORBIDDEN:
                    continue
                new = length + (diagonal * cost if dx != 0 and dy != 0 else cost)
                if new >= g[q]:
                    continue
                g[q] = new
                parent[q] = c
                ax = abs(u - gx)
                ay = abs(v - gy)
                place = int(4.0 * (new + max(ax, ay) + bend * min(ax, ay)))
                # Rounding may make a sum smaller than the one that it grew from.
                place = max(place, now)
                if spare >= 0:
                    entry = spare
                    spare = links[spare]
                else:
                    if used == room:
                        room *= 2
                        cells = _widened(cells, np.empty(room, np.int32))
                        links = _widened(links, np.empty(room, np.int32))
                        lengths = _widened(lengths, np.empty(room, np.float32))
                    entry = used
                    used += 1
                cells[entry] = q
                lengths[entry] = new
                links[entry] = heads[place % buckets]
                heads[place % buckets] = entry
                waiting += 1
    if best < 0:
        return np.empty(0, np.int64), HIGH, looked
    if g[goal] < HIGH:
        best = goal
    count = 1
    c = best
    while c != start:
        c = parent[c]
        count += 1
    path = np.empty(count, np.int64)
    c = best
    for k in range(count - 1, -1, -1):
        path[k] = c
        c = parent[c]
    return path, float(g[best]), looked


@kernel
def _line_cost(costs, table, x0, y0, x1, y1, limit):
    """Return the sum of cell costs along a straight line, `FORBIDDEN` when it is blocked."""
    dx = abs(x1 - x0)
    dy = abs(y1 - y0)
    sx = 1 if x1 > x0 else -1
    sy = 1 if y1 > y0 else -1
    error = dx - dy
    total = 0.0
    while True:
        cost = table[costs[y0, x0]]
        if cost >= FORBIDDEN:
            return FORBIDDEN
        total += cost
        if total > limit or (x0 == x1 and y0 == y1):
            return total
        twice = 2 * error
        # Through a corner: one side at least must be open.
        corner = twice > -dy and twice < dx
        if (
            corner
            and table[costs[y0, x0 + sx]] >= FORBIDDEN
            and table[costs[y0 + sy, x0]] >= FORBIDDEN
        ):
            return FORBIDDEN
        if twice > -dy:
            error -= dy
            x0 += sx
        if twice < dx:
            error += dx
            y0 += sy


@kernel
def theta_star(costs, table, start, goal, corners, weight):
    """Return corners of an any-angle path, by lazily looking back (Daniel and others 2010).

    The cost of a line is `weight` · length + the sum of `table` over its cells.
    """
    height, width = costs.shape
    n = height * width
    g = np.empty(n)
    parent = np.empty(n, np.int32)
    closed = np.empty(n, np.bool_)
    for k in range(n):
        g[k] = HIGH
        parent[k] = -1
        closed[k] = False
    room = 4096
    keys = np.empty(room, np.float32)
    cells = np.empty(room, np.int32)
    g[start] = 0.0
    parent[start] = start
    keys[0] = 0.0
    cells[0] = start
    count = 1
    gx = goal % width
    gy = goal // width
    while count > 0:
        c = cells[0]
        count -= 1
        if count > 0:
            sift_down(keys, cells, count)
        if closed[c]:
            continue
        closed[c] = True
        if c == goal:
            break
        x = c % width
        y = c // width
        for dy in range(-1, 2):
            for dx in range(-1, 2):
                if (dx == 0 and dy == 0) or (corners == 4 and dx != 0 and dy != 0):
                    continue
                u = x + dx
                v = y + dy
                if u < 0 or v < 0 or u >= width or v >= height:
                    continue
                q = v * width + u
                if closed[q] or table[costs[v, u]] >= FORBIDDEN:
                    continue
                origin = parent[c]
                px = origin % width
                py = origin // width
                room_left = g[q] - g[origin]
                line = _line_cost(costs, table, px, py, u, v, room_left)
                far = g[origin] + line + weight * math.hypot(u - px, v - py)
                near = g[c] + table[costs[v, u]] + weight * math.hypot(dx, dy)
                new = near
                source = c
                if line < FORBIDDEN and far <= near:
                    new = far
                    source = origin
                if new >= g[q] - 1e-9:
                    continue
                g[q] = new
                parent[q] = source
                if count == room:
                    room *= 2
                    keys = _widened(keys, np.empty(room, np.float32))
                    cells = _widened(cells, np.empty(room, np.int32))
                keys[count] = new + weight * math.hypot(u - gx, v - gy)
                cells[count] = q
                sift_up(keys, cells, count)
                count += 1
    if g[goal] >= HIGH:
        return np.empty(0, np.int64), HIGH
    count = 1
    c = goal
    while c != start:
        c = parent[c]
        count += 1
    path = np.empty(count, np.int64)
    c = goal
    for k in range(count - 1, -1, -1):
        path[k] = c
        c = parent[c]
    return path, g[goal]
