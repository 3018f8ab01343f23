# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled loop of ``TrajectoryPlannerROS``; see `costmap.costmap_kernels`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.navigation.controllers.dwa_dwb_kernels import BLOCKED, simulate
from gazelle.navigation.costmap.costmap_kernels import outline_cost

__all__ = ["HIT", "NO_WAY", "roll_out"]

HIT, NO_WAY = -1.0, -2.0
"""Costs of trajectories on which the robot hits something or leaves the costmap, and of those
that lead where no way leads to the goal."""
_MAX_STEPS = 4096


@kernel
def roll_out(cells, distances, corners, state, samples, terms, plan):
    """Return costs of velocity samples and where they end, (n, 4): cost, x, y, yaw.

    Args:
        cells: of the costmap, a `grid.CostCells`.
        distances: of path and goal, a `rollout_arguments.Distances`.
        corners: outline of the robot, (n, 2), m.
        state: a `rollout_arguments.PlanarState`.
        samples: (n, 3).
        terms: what counts, a `rollout_arguments.RolloutTerms`.
        plan: the path within the costmap, (n, 2), m.
    """
    ox, oy, inverse = cells.x_m, cells.y_m, cells.per_m
    path, goal, timing, heading = distances.path, distances.goal, terms.timing, terms.heading_s
    n = samples.shape[0]
    found = np.empty((n, 4))
    poses = np.empty((_MAX_STEPS + 1, 3))
    last = plan.shape[0] - 1
    reach = 0.0
    for k in range(corners.shape[0]):
        reach = max(reach, math.hypot(corners[k, 0], corners[k, 1]))
    for k in range(n):
        speed = math.hypot(samples[k, 0], samples[k, 1])
        pieces = speed * timing.duration_s / timing.step_m
        if heading >= 0.0:
            pieces = timing.duration_s / timing.step_m
        elif abs(samples[k, 2]) / timing.step_rad > pieces:
            pieces = abs(samples[k, 2]) / timing.step_rad
        steps = min(max(int(pieces + 0.5), 1), _MAX_STEPS)
        # Between the points that are scored nothing of the outline may pass over a cell unseen.
        passed = (speed + abs(samples[k, 2]) * reach) * timing.duration_s / steps * inverse
        between = max(min(math.ceil(passed), _MAX_STEPS // steps), 1)
        steps *= between
        dt = timing.duration_s / steps
        simulate(state, samples[k], terms.acceleration, steps + 1, dt, True, poses)
        cost = 0.0
        worst = 0.0
        path_cells = 0.0
        goal_cells = 0.0
        astray = 0.0
        # The original does not look at where a trajectory ends: a slow one has but the pose now.
        for j in range(steps + 1):
            x = poses[j, 0]
            y = poses[j, 1]
            c = math.cos(poses[j, 2])
            s = math.sin(poses[j, 2])
            under = outline_cost(cells, corners, x, y, c, s, 1.0)
            if under < 0:
                cost = HIT
                break
            if j == steps or j % between:
                continue
            worst = max(worst, float(under))
            if terms.attracts:
                goal_cells = (x - plan[last, 0]) ** 2 + (y - plan[last, 1]) ** 2
                continue
            if heading >= 0.0 and not (heading <= j * dt < heading + between * dt):
                continue
            u = math.floor((x - ox) * inverse)
            v = math.floor((y - oy) * inverse)
            path_cells = path[v, u]
            goal_cells = goal[v, u]
            if path_cells >= BLOCKED or goal_cells >= BLOCKED:
                cost = NO_WAY
                break
            if heading >= 0.0:
                astray = _turn_to_what_is_seen(cells, plan, u, v, poses[j])
        if cost >= 0.0:
            cost = terms.path * path_cells + terms.goal * goal_cells + terms.obstacles * worst
            cost += terms.heading * astray
        found[k, 0] = cost
        found[k, 1] = poses[steps - between, 0]
        found[k, 2] = poses[steps - between, 1]
        found[k, 3] = poses[steps - between, 2]
    return found


@kernel
def _turn_to_what_is_seen(cells, plan, u, v, pose):
    """Return how far a pose looks away from the farthest point of the path in sight of it, rad."""
    costs, ox, oy, inverse = cells.costs, cells.x_m, cells.y_m, cells.per_m
    height, width = costs.shape
    for i in range(plan.shape[0] - 1, -1, -1):
        a = math.floor((plan[i, 0] - ox) * inverse)
        b = math.floor((plan[i, 1] - oy) * inverse)
        if a < 0 or b < 0 or a >= width or b >= height or not _sees(costs, u, v, a, b):
            continue
        bearing = math.atan2(oy + (b + 0.5) / inverse - pose[1], ox + (a + 0.5) / inverse - pose[0])
        turn = (bearing - pose[2]) % (2 * math.pi)
        return min(turn, 2 * math.pi - turn)
    # The original's is infinite: such a trajectory is taken where there is no other.
    return BLOCKED


@kernel
def _sees(costs, x, y, end_x, end_y):
    """Tell whether no cell of a line between two cells is an obstacle or unknown."""
    dx = abs(end_x - x)
    dy = abs(end_y - y)
    sx = 1 if end_x > x else -1
    sy = 1 if end_y > y else -1
    steps = max(dx, dy)
    error = steps // 2
    for _step in range(steps + 1):
        if costs[y, x] >= 253:
            return False
        if dx >= dy:
            x += sx
            error += dy
        else:
            y += sy
            error += dx
        if error >= steps:
            error -= steps
            if dx >= dy:
                y += sy
            else:
                x += sx
    return True
