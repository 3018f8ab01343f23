# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, C901, D417, PLR0915, PLR0917
"""The compiled loops of sampling controllers; see `gazelle.navigation.costmap.kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit
from gazelle.navigation.costmap.kernels import outline_cost

__all__ = ["BLOCKED", "distance_field", "score_samples", "simulate"]

_MOST_STEPS = 4096
BLOCKED = 1e6
"""Distance of cells that are obstacles or that nothing leads to."""


@njit(cache=True, nogil=True)
def distance_field(costs, targets, lone):
    """Return, by cell, how many sides of cells it is away from target cells.

    `targets` are columns and rows in the order of the path. They count from the first one in the
    grid until the path leaves it; with `lone` only the last of these. Obstacles are not crossed.
    """
    height, width = costs.shape
    field = np.empty((height, width), np.float32)
    for y in range(height):
        for x in range(width):
            field[y, x] = BLOCKED
    queue = np.empty(height * width, np.int32)
    count = 0
    begun = False
    last = -1
    for k in range(targets.shape[0]):
        x = targets[k, 0]
        y = targets[k, 1]
        if x < 0 or y < 0 or x >= width or y >= height or costs[y, x] == 255:
            if begun:
                break
            continue
        begun = True
        last = y * width + x
        if not lone and field[y, x] > 0:
            field[y, x] = 0
            queue[count] = last
            count += 1
    if lone and last >= 0:
        field[last // width, last % width] = 0
        queue[0] = last
        count = 1
    k = 0
    while k < count:
        x = queue[k] % width
        y = queue[k] // width
        k += 1
        for side in range(4):
            u = x + (1 if side == 0 else -1 if side == 1 else 0)
            v = y + (1 if side == 2 else -1 if side == 3 else 0)
            if u < 0 or v < 0 or u >= width or v >= height:
                continue
            if costs[v, u] >= 253 or field[v, u] < BLOCKED:
                continue
            field[v, u] = field[y, x] + 1
            queue[count] = v * width + u
            count += 1
    return field


@njit(cache=True, nogil=True)
def simulate(x, y, yaw, vx, vy, w, sample, limits, steps, dt, accelerate, out):
    """Fill `out` (steps, 3) with the poses of a trajectory, the first one where it begins.

    With `accelerate` velocities change towards the sample by `limits` (m/s², rad/s²); otherwise
    the sample holds from the start.
    """
    if not accelerate:
        vx = sample[0]
        vy = sample[1]
        w = sample[2]
    for k in range(steps):
        out[k, 0] = x
        out[k, 1] = y
        out[k, 2] = yaw
        if accelerate:
            vx += min(max(sample[0] - vx, -limits[0] * dt), limits[0] * dt)
            vy += min(max(sample[1] - vy, -limits[1] * dt), limits[1] * dt)
            w += min(max(sample[2] - w, -limits[2] * dt), limits[2] * dt)
        c = math.cos(yaw)
        s = math.sin(yaw)
        x += (vx * c - vy * s) * dt
        y += (vx * s + vy * c) * dt
        yaw += w * dt


@njit(cache=True, nogil=True)
def score_samples(
    costs, ox, oy, inverse, path, goal, front, corners, outlined, state, samples, limits,
    weights, forward, timing, accelerate, scaling, total, aligned,
):  # fmt: skip
    """Return scores of velocity samples, negative where they are not allowed.

    Args:
        costs, ox, oy, inverse: the costmap, its origin (m) and cells per metre.
        path, goal, front: fields of `distance_field` for path, goal, and goal of the robot's nose.
        corners: outline of the robot, (n, 2); its centre alone is looked at unless `outlined`.
        state: x, y, yaw, vx, vy, w.
        samples: (n, 3).
        limits: accelerations for `accelerate`.
        weights: of path, goal, goal of the nose, nose on the path, obstacles, turning.
        forward: how far ahead of the centre the nose is, m.
        timing: duration (s), steps of it (m, rad; with 0 for m fixed steps of rad seconds).
        accelerate: see `simulate`.
        scaling: speed (m/s) from which on the outline grows, top speed, growth at top speed.
        total: sum costs of obstacles, else take the highest.
        aligned: whether the nose shall keep to the path.
    """
    height, width = costs.shape
    n = samples.shape[0]
    scores = np.empty(n)
    count = corners.shape[0]
    poses = np.empty((_MOST_STEPS + 1, 3))
    reach = 0.0
    for k in range(count):
        reach = max(reach, math.hypot(corners[k, 0], corners[k, 1]))
    for k in range(n):
        vx = samples[k, 0]
        vy = samples[k, 1]
        w = samples[k, 2]
        speed = math.hypot(vx, vy)
        if timing[1] <= 0.0:
            steps = math.ceil(timing[0] / timing[2])
        else:
            steps = math.ceil(
                max(speed * timing[0] / timing[1], abs(w) * timing[0] / timing[2]) - 1e-9
            )
        steps = min(steps, _MOST_STEPS)
        if steps <= 0:
            scores[k] = -10.0
            continue
        # Between the points that are scored nothing of the outline may pass over a cell unseen.
        between = math.ceil((speed + abs(w) * reach) * timing[0] / steps * inverse)
        between = max(min(between, _MOST_STEPS // steps), 1)
        steps *= between
        dt = timing[0] / steps
        scale = 1.0
        if speed > scaling[0] and scaling[1] > scaling[0]:
            scale += scaling[2] * (speed - scaling[0]) / (scaling[1] - scaling[0])
        worst = 0.0
        refused = 0.0
        if outlined and not accelerate:
            # The robot will not have the velocity at once, and cuts its corners.
            simulate(
                state[0], state[1], state[2], state[3], state[4], state[5], samples[k], limits,
                steps + 1, dt, True, poses,
            )  # fmt: skip
            for j in range(steps + 1):
                cost = outline_cost(
                    costs, corners, count, ox, oy, inverse, poses[j, 0], poses[j, 1],
                    math.cos(poses[j, 2]), math.sin(poses[j, 2]), scale,
                )  # fmt: skip
                if cost < 0:
                    refused = -6.0 if cost > -3 else -7.0
                    break
        if refused < 0:
            scores[k] = refused
            continue
        simulate(
            state[0], state[1], state[2], state[3], state[4], state[5], samples[k], limits,
            steps + 1, dt, accelerate, poses,
        )  # fmt: skip
        for j in range(steps + 1):
            if not outlined and (j == steps or j % between):
                continue
            c = math.cos(poses[j, 2])
            s = math.sin(poses[j, 2])
            if outlined:
                cost = outline_cost(
                    costs, corners, count, ox, oy, inverse, poses[j, 0], poses[j, 1], c, s, scale
                )
            else:
                u = math.floor((poses[j, 0] - ox) * inverse)
                v = math.floor((poses[j, 1] - oy) * inverse)
                cost = -3
                if u >= 0 and v >= 0 and u < width and v < height:
                    cost = int(costs[v, u])
                    if cost >= 253:
                        cost = -1
            if cost < 0:
                refused = -6.0 if cost > -3 else -7.0
                break
            if j == steps or j % between:
                continue
            worst = worst + cost if total else max(worst, float(cost))
            u = math.floor((poses[j, 0] - ox) * inverse)
            v = math.floor((poses[j, 1] - oy) * inverse)
            if path[v, u] >= BLOCKED or goal[v, u] >= BLOCKED:
                refused = -3.0
                break
        if refused < 0:
            scores[k] = refused
            continue
        end = steps - between
        u = math.floor((poses[end, 0] - ox) * inverse)
        v = math.floor((poses[end, 1] - oy) * inverse)
        score = weights[4] * worst + weights[5] * abs(w)
        score += weights[0] * path[v, u] + weights[1] * goal[v, u]
        if forward != 0.0:
            nx = poses[end, 0] + forward * math.cos(poses[end, 2])
            ny = poses[end, 1] + forward * math.sin(poses[end, 2])
            u = math.floor((nx - ox) * inverse)
            v = math.floor((ny - oy) * inverse)
            if u < 0 or v < 0 or u >= width or v >= height:
                scores[k] = -4.0
                continue
            # The nose may hang over what the robot cannot stand on: far, but allowed.
            far = float(width * height)
            score += weights[2] * min(float(front[v, u]), far)
            if aligned:
                score += weights[3] * min(float(path[v, u]), far)
        else:
            score += weights[2] * front[v, u] + (weights[3] * path[v, u] if aligned else 0.0)
        scores[k] = score
    return scores
