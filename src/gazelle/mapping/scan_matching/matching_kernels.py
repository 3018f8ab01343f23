# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled inner loops of scan matching.

Cells are `match_arguments.FieldCells`. Points are float64 arrays (n, 2). Nothing here holds a
Python object.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit
from gazelle.mapping.scan_matching.step_kernels import emptied, stepped

__all__ = ["best_in_window", "mean_value", "pooled", "refine", "stamp"]


@njit(cache=True, nogil=True)
def stamp(cells, points, kernels):
    """Raise the field around every point.

    `kernels`, (s, s, k, k), has an odd square for every s-th part of a cell that a point may lie
    in, by row and column: whole cells would shift walls by up to half a cell.
    """
    field, x0, y0, cell = cells.values, cells.x_m, cells.y_m, cells.cell_m
    height, width = field.shape
    parts, side = kernels.shape[0], kernels.shape[2]
    reach = side // 2
    # Flat and unsigned: negative indices need not be looked for.
    flat, bells = field.reshape(height * width), kernels.reshape(kernels.size)
    for i in range(points.shape[0]):
        gx, gy = (points[i, 0] - x0) / cell, (points[i, 1] - y0) / cell
        if not (reach <= gx < width - reach and reach <= gy < height - reach):
            continue
        cx, cy = int(gx), int(gy)
        bell = (int((gy - cy) * parts) * parts + int((gx - cx) * parts)) * side * side
        # What raises the middle by nothing raises little around it.
        if flat[np.uint64(cy * width + cx)] >= bells[np.uint64(bell + reach * side + reach)]:
            continue
        first = (cy - reach) * width + cx - reach
        for a in range(side):
            for b in range(side):
                place, value = (
                    np.uint64(first + a * width + b),
                    bells[np.uint64(bell + a * side + b)],
                )
                old = flat[place]
                flat[place] = value if value > old else old


@njit(cache=True, nogil=True)
def pooled(field):
    """Return the field with cells twice as large, each the greatest of its four parts."""
    height, width = field.shape[0] // 2, field.shape[1] // 2
    out = np.empty((height, width), np.float32)
    for y in range(height):
        low, high = field[2 * y], field[2 * y + 1]
        for x in range(width):
            a, b = low[2 * x], low[2 * x + 1]
            c, d = high[2 * x], high[2 * x + 1]
            left = a if a > c else c
            right = b if b > d else d
            out[y, x] = left if left > right else right
    return out


@njit(cache=True, nogil=True, fastmath=True)
def best_in_window(cells, points, guess, window, toward):
    """Return the best pose on a lattice around a guess, as (x, y, yaw, mean value there).

    Args:
        cells: of a field.
        points: in the robot's frame, (n, 2).
        guess: (x, y, yaw).
        window: the lattice, a `match_arguments.Window`.
        toward: what lowers what a pose is worth, a `match_arguments.Toward`.
    """
    field, x0, y0, cell = cells.values, cells.x_m, cells.y_m, cells.cell_m
    height, width = field.shape
    n = points.shape[0]
    step_m, step_rad = window.step_m, window.step_rad
    n_turns, n_steps = round(window.reach_rad / step_rad), round(window.reach_m / step_m)
    best, best_mean = -1e30, 0.0
    bx, by, bt = guess[0], guess[1], guess[2]
    across = 2 * n_steps + 1
    columns, rows = np.empty((across, n), np.int64), np.empty((across, n), np.int64)
    flat, outside = field.reshape(height * width), -height * width - 1
    scale = 1.0 / cell
    for turn in range(-n_turns, n_turns + 1):
        yaw = guess[2] + turn * step_rad
        c, s = math.cos(yaw), math.sin(yaw)
        for i in range(n):
            px = (c * points[i, 0] - s * points[i, 1] - x0) * scale
            py = (s * points[i, 0] + c * points[i, 1] - y0) * scale
            for k in range(across):
                gx = int(px + (guess[0] + (k - n_steps) * step_m) * scale)
                gy = int(py + (guess[1] + (k - n_steps) * step_m) * scale)
                columns[k, i] = gx if 0 <= gx < width else outside
                rows[k, i] = gy * width if 0 <= gy < height else outside
        for iy in range(-n_steps, n_steps + 1):
            y = guess[1] + iy * step_m
            for ix in range(-n_steps, n_steps + 1):
                x = guess[0] + ix * step_m
                up, right = rows[iy + n_steps], columns[ix + n_steps]
                total = 0.0
                for i in range(n):
                    place = up[i] + right[i]
                    if place >= 0:
                        total += flat[np.uint64(place)]
                total /= n
                ex, ey, et = x - toward.x_m, y - toward.y_m, yaw - toward.yaw_rad
                worth = total - toward.per_m2 * (ex * ex + ey * ey) - toward.per_rad2 * et * et
                if worth > best:
                    best, best_mean, bx, by, bt = worth, total, x, y, yaw
    return bx, by, bt, best_mean


@njit(cache=True, nogil=True, fastmath=True)
def mean_value(cells, points, x, y, yaw):
    """Return the mean value of the field at points seen from a pose."""
    field, x0, y0, cell = cells.values, cells.x_m, cells.y_m, cells.cell_m
    height, width = field.shape
    c, s = math.cos(yaw), math.sin(yaw)
    total = 0.0
    for i in range(points.shape[0]):
        gx = math.floor((c * points[i, 0] - s * points[i, 1] + x - x0) / cell)
        gy = math.floor((s * points[i, 0] + c * points[i, 1] + y - y0) / cell)
        if 0 <= gx < width and 0 <= gy < height:
            total += field[gy, gx]
    return total / max(1, points.shape[0])


@njit(cache=True, nogil=True, fastmath=True)
def refine(cells, points, guess, prior, weight, iterations):
    """Minimise ``weight Σ (1 − M)² + eᵀ Λ e`` by Gauss-Newton (Kohlbrecher et al. 2011).

    M is the field, bilinear between cell centres, e the departure from the `match.Prior`, Λ its
    information.

    Returns:
        The pose and the Hessian of the first term, which is what the scan says of the pose.
    """
    field, x0, y0, cell = cells.values, cells.x_m, cells.y_m, cells.cell_m
    height, width = field.shape
    pose, slope, step = np.empty(3), np.empty(3), np.empty(3)
    data = np.empty((3, 3))
    for k in range(3):
        pose[k] = guess[k]
    scale = 1.0 / cell
    for _ in range(iterations):
        emptied(data, slope)
        c, s = math.cos(pose[2]), math.sin(pose[2])
        for i in range(points.shape[0]):
            rx = c * points[i, 0] - s * points[i, 1]
            ry = s * points[i, 0] + c * points[i, 1]
            gx = (rx + pose[0] - x0) * scale - 0.5
            gy = (ry + pose[1] - y0) * scale - 0.5
            if gx < 0 or gy < 0 or gx >= width - 1 or gy >= height - 1:
                continue
            ix, iy = int(gx), int(gy)
            fx, fy = gx - ix, gy - iy
            m00, m10 = field[iy, ix], field[iy, ix + 1]
            m01, m11 = field[iy + 1, ix], field[iy + 1, ix + 1]
            low, high = m00 + (m10 - m00) * fx, m01 + (m11 - m01) * fx
            error = 1.0 - (low + (high - low) * fy)
            dx = ((m10 - m00) * (1 - fy) + (m11 - m01) * fy) * scale
            dy = (high - low) * scale
            dt = -dx * ry + dy * rx
            data[0, 0] += dx * dx
            data[0, 1] += dx * dy
            data[0, 2] += dx * dt
            data[1, 1] += dy * dy
            data[1, 2] += dy * dt
            data[2, 2] += dt * dt
            slope[0] += dx * error
            slope[1] += dy * error
            slope[2] += dt * error
        stepped(data, slope, weight, prior.information, pose, prior.pose, 1e-3, step)
        length = math.sqrt(step[0] * step[0] + step[1] * step[1])
        share = 0.1 / length if length > 0.1 else 1.0
        for k in range(3):
            step[k] *= share
            pose[k] += step[k]
        if length < 1e-4 and abs(step[2]) < 1e-4:
            break
    return pose, data
