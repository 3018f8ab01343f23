# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled loop of MPPI; see `gazelle.navigation.costmap.costmap_kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.navigation.costmap.costmap_kernels import outline_cost

__all__ = ["roll_out", "score_batch"]


@kernel(flags="fast")
def roll_out(state, controls, able, poses, driven):
    """Fill poses (T, 3) and velocities that are driven (T, 3) for controls (T, 3).

    It begins in a `rollout_arguments.PlanarState`; what the robot can do is a
    `rollout_arguments.Limits`.
    """
    limits, dt = able.rows, able.step_s
    x, y, yaw, v0, v1, v2 = state
    for t in range(controls.shape[0]):
        a = min(max(controls[t, 0], limits[0, 0]), limits[0, 1])
        b = min(max(controls[t, 1], limits[1, 0]), limits[1, 1])
        c = min(max(controls[t, 2], limits[2, 0]), limits[2, 1])
        v0 = min(max(a, v0 + limits[0, 2] * dt), v0 + limits[0, 3] * dt)
        v1 = min(max(b, v1 + limits[1, 2] * dt), v1 + limits[1, 3] * dt)
        v2 = min(max(c, v2 + limits[2, 2] * dt), v2 + limits[2, 3] * dt)
        cosine = math.cos(yaw)
        sine = math.sin(yaw)
        x += (v0 * cosine - v1 * sine) * dt
        y += (v0 * sine + v1 * cosine) * dt
        yaw += v2 * dt
        poses[t, 0] = x
        poses[t, 1] = y
        poses[t, 2] = yaw
        driven[t, 0] = v0
        driven[t, 1] = v1
        driven[t, 2] = v2


@kernel(flags="fast")
def score_batch(cells, corners, outlined, state, way, varied, able, critics):
    """Return costs of trajectories and whether each one is free, for controls and their variations.

    Args:
        cells: of the costmap, a `grid.CostCells`.
        corners: outline of the robot, (n, 2), m.
        outlined: all of it is looked at, and not the centre alone.
        state: a `rollout_arguments.PlanarState`.
        way: the path ahead, a `rollout_arguments.Way`.
        varied: the controls, `rollout_arguments.Variations`.
        able: what the robot can do, a `rollout_arguments.Limits`.
        critics: what counts, one `rollout_arguments.CRITIC_WEIGHTS`.
    """
    costs, ox, oy, inverse = cells.costs, cells.x_m, cells.y_m, cells.per_m
    path, along, goal, dt = way.points_m, way.along_m, way.goal, able.step_s
    mean, noise, spread, gamma = varied.mean, varied.noise, varied.spread, varied.gamma
    weights = critics[0]
    batch = noise.shape[0]
    steps = noise.shape[1]
    height, width = costs.shape
    n = path.shape[0]
    scores = np.zeros(batch)
    free = np.ones(batch, np.bool_)
    ends = np.empty((batch, 3))
    poses = np.empty((steps, 3))
    driven = np.empty((steps, 3))
    controls = np.empty((steps, 3))
    to_goal = math.hypot(goal[0] - state.x_m, goal[1] - state.y_m)
    furthest = 0
    for k in range(batch):
        effort = 0.0
        for t in range(steps):
            for a in range(3):
                controls[t, a] = mean[t, a] + noise[k, t, a]
                effort += mean[t, a] * noise[k, t, a] / (spread[a] * spread[a])
        roll_out(state, controls, able, poses, driven)
        score = gamma * effort
        repulsion = 0.0
        for t in range(0, steps, 2):
            u = math.floor((poses[t, 0] - ox) * inverse)
            v = math.floor((poses[t, 1] - oy) * inverse)
            if u < 0 or v < 0 or u >= width or v >= height:
                # Nobody knows what is there; the way stays where there is a costmap.
                score += weights.critical
                break
            cost = float(costs[v, u])
            hit = 253 <= cost < 255
            if outlined and not hit and 0 < cost < 255:
                c = math.cos(poses[t, 2])
                s = math.sin(poses[t, 2])
                hit = outline_cost(cells, corners, poses[t, 0], poses[t, 1], c, s, 1.0) == -1
            if hit:
                free[k] = False
                score += weights.collision
                break
            if cost >= weights.near_collision:
                score += weights.critical / steps
            elif to_goal > weights.near_goal:
                repulsion += 0.0 if cost == 255 else cost
        score += weights.cost * repulsion / 254.0 / (steps / 2)
        reverse = 0.0
        turned = 0.0
        tight = 0.0
        near = 0.0
        askew = 0.0
        for t in range(steps):
            reverse += max(-driven[t, 0], 0.0)
            turned += abs(driven[t, 2])
            if weights.radius > 0 and abs(driven[t, 2]) > 1e-3:
                tight += max(weights.radius - abs(driven[t, 0] / driven[t, 2]), 0.0)
            if to_goal < weights.goal_within:
                near += math.hypot(poses[t, 0] - goal[0], poses[t, 1] - goal[1])
            if to_goal < weights.yaw_within:
                angle = goal[2] - poses[t, 2]
                askew += abs(math.atan2(math.sin(angle), math.cos(angle)))
        score += weights.twirl * turned / steps + weights.radius_weight * tight * dt
        if to_goal >= weights.forward_within:
            score += weights.forward * reverse * dt
        score += weights.goal * near / steps + weights.yaw * askew / steps
        if weights.align > 0 and to_goal >= weights.align_within:
            off = 0.0
            seen = 0
            gone = 0.0
            i = 0
            for t in range(4, steps, 4):
                gone += math.hypot(poses[t, 0] - poses[t - 4, 0], poses[t, 1] - poses[t - 4, 1])
                while i + 1 < n and along[i + 1] <= gone:
                    i += 1
                off += math.hypot(poses[t, 0] - path[i, 0], poses[t, 1] - path[i, 1])
                seen += 1
            score += weights.align * off / max(seen, 1)
        ends[k, 0] = poses[steps - 1, 0]
        ends[k, 1] = poses[steps - 1, 1]
        ends[k, 2] = poses[steps - 1, 2]
        if free[k]:
            best = 1e18
            at = 0
            for i in range(n):
                d = (path[i, 0] - ends[k, 0]) ** 2 + (path[i, 1] - ends[k, 1]) ** 2
                if d < best:
                    best = d
                    at = i
            furthest = max(furthest, at)
        scores[k] = score
    follow = min(furthest + int(weights.follow_offset), n - 1)
    look = min(furthest + int(weights.angle_offset), n - 1)
    bearing = math.atan2(path[look, 1] - state.y_m, path[look, 0] - state.x_m)
    bearing -= state.yaw_rad
    away = abs(math.atan2(math.sin(bearing), math.cos(bearing)))
    steer = to_goal >= weights.angle_within and away > weights.angle_most
    for k in range(batch):
        if to_goal >= weights.follow_within:
            scores[k] += weights.follow * math.hypot(
                ends[k, 0] - path[follow, 0], ends[k, 1] - path[follow, 1]
            )
        if steer:
            angle = math.atan2(path[look, 1] - ends[k, 1], path[look, 0] - ends[k, 0]) - ends[k, 2]
            scores[k] += weights.angle * abs(math.atan2(math.sin(angle), math.cos(angle)))
    return scores, free
