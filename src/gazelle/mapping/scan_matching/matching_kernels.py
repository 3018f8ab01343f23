# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled inner loops of scan matching.

Cells are `match_arguments.FieldCells`. Points are float64 arrays (n, 2). Nothing here holds a
Python object.

Sums are float64 (n, 6): count, Σx, Σy, Σx², Σxy, Σy² of the points in a cell, seen from the middle
of the grid, so that squares stay small. A grid of int32 says which row is a cell's; row 0, of empty
cells, is zero. Walls fill few of the cells. Both are a `match_arguments.Lines`.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = [
    "accumulate",
    "best_in_window",
    "emptied",
    "mean_value",
    "placed",
    "pooled",
    "refine",
    "refine_on_lines",
    "stamp",
    "stepped",
]


@kernel
def placed(points, starts, poses, indices):
    """Return the points of some sets, each moved to its pose, (m, 2).

    Args:
        points: of all sets, one after the other, (n, 2).
        starts: where each set begins, int64, and where the last one ends.
        poses: of the sets, (s, 3) at least.
        indices: which sets, int64.
    """
    count = 0
    for k in range(indices.shape[0]):
        count += starts[indices[k] + 1] - starts[indices[k]]
    out = np.empty((count, 2))
    at = 0
    for k in range(indices.shape[0]):
        pose = poses[indices[k]]
        c, s = math.cos(pose[2]), math.sin(pose[2])
        for i in range(starts[indices[k]], starts[indices[k] + 1]):
            out[at, 0] = c * points[i, 0] - s * points[i, 1] + pose[0]
            out[at, 1] = s * points[i, 0] + c * points[i, 1] + pose[1]
            at += 1
    return out


@kernel
def emptied(data, slope):
    """Set the sums, (3, 3) and (3,), to zero."""
    for i in range(3):
        slope[i] = 0.0
        for j in range(3):
            data[i, j] = 0.0


@kernel
def stepped(data, slope, weight, information, pose, prior, damping, step):
    """Fill `step` with that of Gauss-Newton (Levenberg-Marquardt) from a pose.

    Args:
        data: its upper half is that of the information of the scan; filled, and times `weight`
            afterwards.
        slope: of the scan.
        weight: of the scan.
        information: of the prior, (3, 3).
        pose: where it is.
        prior: pose that is expected.
        damping: what the diagonal grows by, as a share of it; and by 0.001.
        step: (3,), filled.
    """
    for i in range(3):
        for j in range(i, 3):
            data[i, j] *= weight
            data[j, i] = data[i, j]
    x, y, turn = pose[0] - prior[0], pose[1] - prior[1], pose[2] - prior[2]
    turn = (turn + math.pi) % (2 * math.pi) - math.pi
    for i in range(3):
        step[i] = slope[i] * weight - (
            information[i, 0] * x + information[i, 1] * y + information[i, 2] * turn
        )
    # L D Lᵀ of the damped matrix, which is positive definite, and what is solved by it.
    a, d = data[0, 0] + information[0, 0], data[1, 1] + information[1, 1]
    f = data[2, 2] + information[2, 2]
    a += 1e-3 + damping * a
    d += 1e-3 + damping * d
    f += 1e-3 + damping * f
    b, c = data[0, 1] + information[0, 1], data[0, 2] + information[0, 2]
    e = data[1, 2] + information[1, 2]
    low, last = b / a, c / a
    d -= low * b
    e -= low * c
    between = e / d
    f -= last * c + between * e
    step[1] -= low * step[0]
    step[2] = (step[2] - last * step[0] - between * step[1]) / f
    step[1] = step[1] / d - between * step[2]
    step[0] = step[0] / a - low * step[1] - last * step[2]


@kernel
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


@kernel
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


@kernel
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


@kernel
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


@kernel
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


@kernel(flags="fast")
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


@kernel(flags="fast")
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


@kernel(flags="fast")
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
