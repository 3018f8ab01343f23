# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202, D417
"""The compiled search for a way of turns and straight pieces; see `maneuver`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.navigation.costmap.costmap_kernels import outline_cost, squared_distances
from gazelle.priority_queue_kernels import sift_down, sift_up

__all__ = ["find_maneuver", "outline_is_free"]

_STEP_M = 0.05
_HEADINGS = 48
_MAX_LOOKED_AT = 60_000
# Lengths, m, that a turn by one heading and a metre backwards are worth.
_TURN_M, _BACK = 0.02, 2.0
_GREED = 1.2


@kernel
def outline_is_free(cells, squared, outline, x, y, yaw):
    """Tell whether an outline hits nothing; far from everything it is not laid down.

    `cells` are a `grid.CostCells`, `squared` their squared distances in cells to the next obstacle;
    the outline is a `rollout_arguments.Outline`.
    """
    ox, oy, inverse = cells.x_m, cells.y_m, cells.per_m
    inner = outline.inner_m * inverse
    outer = outline.outer_m * inverse
    height, width = cells.costs.shape
    u = math.floor((x - ox) * inverse)
    v = math.floor((y - oy) * inverse)
    if u < 0 or v < 0 or u >= width or v >= height:
        return False
    away = math.sqrt(squared[v, u])
    if away > outer + 1.5:
        reach = int(outer) + 1
        return u >= reach and v >= reach and u < width - reach and v < height - reach
    if away < inner - 1.5:
        return False
    c = math.cos(yaw)
    s = math.sin(yaw)
    return outline_cost(cells, outline.corners_m, x, y, c, s, outline.scale) >= 0


@kernel
def _lengths_to(squared, inner, target, width, height):
    """Return, by cell, how far a disc that fits within the outline has to go, in cells."""
    lengths = np.full(width * height, 1e9)
    keys = np.empty(8 * width * height, np.float64)
    items = np.empty(8 * width * height, np.int64)
    lengths[target] = 0.0
    keys[0] = 0.0
    items[0] = target
    count = 1
    least = (inner - 1.5) ** 2 if inner > 1.5 else 0.0
    while count > 0:
        length = keys[0]
        cell = items[0]
        count -= 1
        if count > 0:
            sift_down(keys, items, count)
        if length > lengths[cell]:
            continue
        x = cell % width
        y = cell // width
        for dy in range(-1, 2):
            for dx in range(-1, 2):
                u = x + dx
                v = y + dy
                if u < 0 or v < 0 or u >= width or v >= height or squared[v, u] <= least:
                    continue
                new = length + (1.4142135 if dx != 0 and dy != 0 else 1.0)
                if new < lengths[v * width + u]:
                    lengths[v * width + u] = new
                    keys[count] = new
                    items[count] = v * width + u
                    sift_up(keys, items, count)
                    count += 1
    return lengths


@kernel
def find_maneuver(cells, outline, start, target, near):
    """Return the poses of a way from start to target, (n, 3), empty where there is none.

    Steps are 5 cm ahead or back and turns by 7.5° on the spot, of which the target's direction is
    one; the first turn takes the robot to such a direction.

    Args:
        cells: of the costmap, a `grid.CostCells`.
        outline: of the robot, a `rollout_arguments.Outline`.
        start, target: poses.
        near: how near the target is near enough, m.
    """
    costs, ox, oy, inverse = cells.costs, cells.x_m, cells.y_m, cells.per_m
    height, width = costs.shape
    inner = outline.inner_m * inverse
    outer = outline.outer_m * inverse
    blocked = np.empty((height, width), np.bool_)
    for v in range(height):
        for u in range(width):
            blocked[v, u] = costs[v, u] >= 254
    squared = squared_distances(blocked, int(outer) + 4)
    tu = math.floor((target[0] - ox) * inverse)
    tv = math.floor((target[1] - oy) * inverse)
    none = np.empty((0, 3))
    if tu < 0 or tv < 0 or tu >= width or tv >= height:
        return none
    lengths = _lengths_to(squared, inner, tv * width + tu, width, height)
    columns = int(width / inverse / _STEP_M) + 2
    rows = int(height / inverse / _STEP_M) + 2
    best = np.full(columns * rows * _HEADINGS, 1e9)
    room = 4 * _MAX_LOOKED_AT + 8
    keys = np.empty(room, np.float64)
    items = np.empty(room, np.int64)
    xs = np.empty(room)
    ys = np.empty(room)
    ks = np.empty(room, np.int64)
    costs_so_far = np.empty(room)
    parents = np.empty(room, np.int64)
    step = 2 * math.pi / _HEADINGS
    xs[0] = start[0]
    ys[0] = start[1]
    ks[0] = math.floor((start[2] - target[2]) / step + 0.5) % _HEADINGS
    costs_so_far[0] = 0.0
    parents[0] = -1
    keys[0] = 0.0
    items[0] = 0
    nodes = 1
    count = 1
    looked = 0
    while count > 0 and looked < _MAX_LOOKED_AT:
        node = items[0]
        count -= 1
        if count > 0:
            sift_down(keys, items, count)
        x = xs[node]
        y = ys[node]
        k = ks[node]
        so_far = costs_so_far[node]
        column = int((x - ox) / _STEP_M)
        row = int((y - oy) / _STEP_M)
        place = (row * columns + column) * _HEADINGS + k
        if so_far > best[place] + 1e-6:
            continue
        looked += 1
        if k == 0 and math.hypot(x - target[0], y - target[1]) <= near:
            n = 0
            at = node
            while at >= 0:
                n += 1
                at = parents[at]
            way = np.empty((n, 3))
            at = node
            while at >= 0:
                n -= 1
                way[n, 0] = xs[at]
                way[n, 1] = ys[at]
                way[n, 2] = target[2] + ks[at] * step
                at = parents[at]
            return way
        yaw = target[2] + k * step
        for move in range(4):
            nx = x
            ny = y
            nk = k
            half = yaw
            if move < 2:
                sign = 1.0 if move == 0 else -1.0
                nx = x + sign * _STEP_M * math.cos(yaw)
                ny = y + sign * _STEP_M * math.sin(yaw)
                price = _STEP_M if move == 0 else _STEP_M * _BACK
            else:
                sign = 1.0 if move == 2 else -1.0
                nk = (k + (1 if move == 2 else _HEADINGS - 1)) % _HEADINGS
                half = yaw + sign * step / 2
                price = _TURN_M
            if not (
                outline_is_free(cells, squared, outline, (x + nx) / 2, (y + ny) / 2, half)
                and outline_is_free(cells, squared, outline, nx, ny, target[2] + nk * step)
            ):
                continue
            u = math.floor((nx - ox) * inverse)
            v = math.floor((ny - oy) * inverse)
            # Where it is dear to be it is narrow.
            price *= 1.0 + min(int(costs[v, u]), 252) / 126.0
            left = lengths[v * width + u]
            new = so_far + price
            place = (int((ny - oy) / _STEP_M) * columns + int((nx - ox) / _STEP_M)) * _HEADINGS + nk
            if left >= 1e8 or new >= best[place] - 1e-6 or nodes >= room:
                continue
            best[place] = new
            xs[nodes] = nx
            ys[nodes] = ny
            ks[nodes] = nk
            costs_so_far[nodes] = new
            parents[nodes] = node
            keys[count] = new + _GREED * left / inverse
            items[count] = nodes
            sift_up(keys, items, count)
            count += 1
            nodes += 1
    return none
