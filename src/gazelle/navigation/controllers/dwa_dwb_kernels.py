# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled loops of sampling controllers; see `gazelle.navigation.costmap.costmap_kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.navigation.costmap.costmap_kernels import outline_cost

__all__ = ["BLOCKED", "distance_field", "score_samples", "simulate"]

_MAX_STEPS = 4096
BLOCKED = 1e6
"""Distance of cells that are obstacles or that nothing leads to."""


@kernel
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


@kernel
def simulate(state, sample, limits, steps, dt, accelerate, out):
    """Fill `out` (steps, 3) with the poses of a trajectory, the first one where it begins.

    It begins in a `rollout_arguments.PlanarState`. With `accelerate` velocities change towards the
    sample by `limits` (m/s², rad/s²); otherwise the sample holds from the start.
    """
    x, y, yaw, vx, vy, w = state
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


@kernel
def score_samples(cells, distances, front, corners, state, samples, terms):
    """Return scores of velocity samples, negative where they are not allowed.

    Args:
        cells: of the costmap, a `grid.CostCells`.
        distances: of path and goal, a `rollout_arguments.Distances`.
        front: `distance_field` of the goal of the robot's nose.
        corners: outline of the robot, (n, 2), m.
        state: a `rollout_arguments.PlanarState`.
        samples: (n, 3).
        terms: what counts, a `rollout_arguments.SampleTerms`.
    """
    costs, ox, oy, inverse = cells.costs, cells.x_m, cells.y_m, cells.per_m
    path, goal, limits = distances.path, distances.goal, terms.acceleration
    weights, timing, growth, forward = terms.weights, terms.timing, terms.growth, terms.nose_m
    outlined, accelerate = terms.is_outlined, terms.accelerates
    height, width = costs.shape
    n = samples.shape[0]
    scores = np.empty(n)
    count = corners.shape[0]
    poses = np.empty((_MAX_STEPS + 1, 3))
    reach = 0.0
    for k in range(count):
        reach = max(reach, math.hypot(corners[k, 0], corners[k, 1]))
    for k in range(n):
        vx = samples[k, 0]
        vy = samples[k, 1]
        w = samples[k, 2]
        speed = math.hypot(vx, vy)
        if timing.step_m <= 0.0:
            steps = math.ceil(timing.duration_s / timing.step_rad)
        else:
            pieces = speed * timing.duration_s / timing.step_m
            pieces = max(pieces, abs(w) * timing.duration_s / timing.step_rad)
            steps = math.ceil(pieces - 1e-9)
        steps = min(steps, _MAX_STEPS)
        if steps <= 0:
            scores[k] = -10.0
            continue
        # Between the points that are scored nothing of the outline may pass over a cell unseen.
        between = math.ceil((speed + abs(w) * reach) * timing.duration_s / steps * inverse)
        between = max(min(between, _MAX_STEPS // steps), 1)
        steps *= between
        dt = timing.duration_s / steps
        scale = 1.0
        if speed > growth.from_m_s and growth.fastest_m_s > growth.from_m_s:
            faster = speed - growth.from_m_s
            scale += growth.share * faster / (growth.fastest_m_s - growth.from_m_s)
        worst = 0.0
        refused = 0.0
        if outlined and not accelerate:
            # The robot will not have the velocity at once, and cuts its corners.
            simulate(state, samples[k], limits, steps + 1, dt, True, poses)
            for j in range(steps + 1):
                c = math.cos(poses[j, 2])
                s = math.sin(poses[j, 2])
                cost = outline_cost(cells, corners, poses[j, 0], poses[j, 1], c, s, scale)
                if cost < 0:
                    refused = -6.0 if cost > -3 else -7.0
                    break
        if refused < 0:
            scores[k] = refused
            continue
        simulate(state, samples[k], limits, steps + 1, dt, accelerate, poses)
        for j in range(steps + 1):
            if not outlined and (j == steps or j % between):
                continue
            c = math.cos(poses[j, 2])
            s = math.sin(poses[j, 2])
            if outlined:
                cost = outline_cost(cells, corners, poses[j, 0], poses[j, 1], c, s, scale)
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
            worst = worst + cost if terms.sums else max(worst, float(cost))
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
        score = weights.obstacles * worst + weights.turning * abs(w)
        score += weights.path * path[v, u] + weights.goal * goal[v, u]
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
            score += weights.nose_goal * min(float(front[v, u]), far)
            if terms.is_aligned:
                score += weights.nose_path * min(float(path[v, u]), far)
        else:
            astray = weights.nose_path * path[v, u] if terms.is_aligned else 0.0
            score += weights.nose_goal * front[v, u] + astray
        scores[k] = score
    return scores
