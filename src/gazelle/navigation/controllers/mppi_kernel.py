# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, C901, D417, PLR0915, PLR0917
"""The compiled loop of MPPI; see `gazelle.navigation.costmap.kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit
from gazelle.navigation.costmap.kernels import outline_cost

__all__ = ["WEIGHTS", "roll_out", "score_batch"]

WEIGHTS = (
    "cost", "critical", "collision", "near_collision", "near_goal", "goal", "goal_within", "yaw",
    "yaw_within", "align", "align_within", "align_offset", "follow", "follow_within",
    "follow_offset", "angle", "angle_within", "angle_offset", "angle_most", "forward",
    "forward_within", "twirl", "radius", "radius_weight",
)  # fmt: skip
"""Order of `weights`; see `MppiOptions.CRITICS`."""


@njit(cache=True, nogil=True, fastmath=True)
def roll_out(state, controls, limits, dt, poses, driven):
    """Fill poses (T, 3) and velocities that are driven (T, 3) for controls (T, 3).

    `limits` are lowest and highest velocities and accelerations, as rows vx, vy, w of
    (low, high, falling, rising).
    """
    x = state[0]
    y = state[1]
    yaw = state[2]
    v0 = state[3]
    v1 = state[4]
    v2 = state[5]
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


@njit(cache=True, nogil=True, fastmath=True)
def score_batch(
    costs, ox, oy, inverse, corners, outlined, state, goal, path, along, mean, noise, limits, dt,
    spread, gamma, weights,
):  # fmt: skip
    """Return costs of trajectories and whether each one is free, for controls `mean` + `noise`.

    Args:
        corners: outline of the robot; its centre alone is looked at unless `outlined`.
        path: points (n, 2) ahead; `along` their distances from the first one.
        mean: controls (T, 3).
        noise: (K, T, 3).
        limits: see `roll_out`.
        spread: standard deviations of the noise.
        weights: in the order of `WEIGHTS`.
    """
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
    to_goal = math.hypot(goal[0] - state[0], goal[1] - state[1])
    furthest = 0
    for k in range(batch):
        effort = 0.0
        for t in range(steps):
            for a in range(3):
                controls[t, a] = mean[t, a] + noise[k, t, a]
                effort += mean[t, a] * noise[k, t, a] / (spread[a] * spread[a])
        roll_out(state, controls, limits, dt, poses, driven)
        score = gamma * effort
        repulsion = 0.0
        for t in range(0, steps, 2):
            u = math.floor((poses[t, 0] - ox) * inverse)
            v = math.floor((poses[t, 1] - oy) * inverse)
            if u < 0 or v < 0 or u >= width or v >= height:
                # Nobody knows what is there; the way stays where there is a costmap.
                score += weights[1]
                break
            cost = float(costs[v, u])
            hit = 253 <= cost < 255
            if outlined and not hit and 0 < cost < 255:
                hit = (
                    outline_cost(
                        costs, corners, corners.shape[0], ox, oy, inverse, poses[t, 0],
                        poses[t, 1], math.cos(poses[t, 2]), math.sin(poses[t, 2]), 1.0,
                    )
                    == -1
                )  # fmt: skip
            if hit:
                free[k] = False
                score += weights[2]
                break
            if cost >= weights[3]:
                score += weights[1] / steps
            elif to_goal > weights[4]:
                repulsion += 0.0 if cost == 255 else cost
        score += weights[0] * repulsion / 254.0 / (steps / 2)
        reverse = 0.0
        turned = 0.0
        tight = 0.0
        near = 0.0
        askew = 0.0
        for t in range(steps):
            reverse += max(-driven[t, 0], 0.0)
            turned += abs(driven[t, 2])
            if weights[22] > 0 and abs(driven[t, 2]) > 1e-3:
                tight += max(weights[22] - abs(driven[t, 0] / driven[t, 2]), 0.0)
            if to_goal < weights[6]:
                near += math.hypot(poses[t, 0] - goal[0], poses[t, 1] - goal[1])
            if to_goal < weights[8]:
                angle = goal[2] - poses[t, 2]
                askew += abs(math.atan2(math.sin(angle), math.cos(angle)))
        score += weights[21] * turned / steps + weights[23] * tight * dt
        if to_goal >= weights[20]:
            score += weights[19] * reverse * dt
        score += weights[5] * near / steps + weights[7] * askew / steps
        if weights[9] > 0 and to_goal >= weights[10]:
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
            score += weights[9] * off / max(seen, 1)
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
    follow = min(furthest + int(weights[14]), n - 1)
    look = min(furthest + int(weights[17]), n - 1)
    bearing = math.atan2(path[look, 1] - state[1], path[look, 0] - state[0]) - state[2]
    away = abs(math.atan2(math.sin(bearing), math.cos(bearing)))
    steer = to_goal >= weights[16] and away > weights[18]
    for k in range(batch):
        if to_goal >= weights[13]:
            scores[k] += weights[12] * math.hypot(
                ends[k, 0] - path[follow, 0], ends[k, 1] - path[follow, 1]
            )
        if steer:
            angle = math.atan2(path[look, 1] - ends[k, 1], path[look, 0] - ends[k, 0]) - ends[k, 2]
            scores[k] += weights[15] * abs(math.atan2(math.sin(angle), math.cos(angle)))
    return scores, free
