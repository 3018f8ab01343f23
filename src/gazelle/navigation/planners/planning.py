"""Planning with any planner."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.grid import FREE, LETHAL, CostGrid
from gazelle.navigation.planners.directions import directed
from gazelle.navigation.planners.options import (
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    PlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
)
from gazelle.navigation.planners.plan import NoPlan, Plan
from gazelle.navigation.planners.refusal import refuse_ends, why_no_path
from gazelle.navigation.planners.tables import (
    global_planner_table,
    navfn_table,
    smac_table,
    theta_table,
)

__all__ = ["make_plan"]

Pose = tuple[float, float, float]
_Found = tuple[NDArray[np.float64], float]


def make_plan(
    grid: CostGrid,
    start: Pose,
    goal: Pose,
    options: PlannerOptions,
    tolerance_m: float | None = None,
) -> Plan | NoPlan:
    """Plan a path.

    Args:
        grid: costs, inflated for the robot.
        start: where the robot is, in the grid's frame; its cell counts as free.
        goal: where it shall go.
        options: which planner, and its parameters.
        tolerance_m: how far from the goal the path may end; the planner's own when None.
    """
    tolerance = _tolerance(options) if tolerance_m is None else tolerance_m
    refusal = refuse_ends(grid, start, goal, tolerance)
    if refusal is not None:
        return refusal
    costs = _prepared(grid, start, options)
    found = _search(costs, grid, start, goal, options, tolerance / grid.resolution_m)
    if found is None:
        return why_no_path(grid, start, goal, tolerance, options.allow_unknown)
    points, cost = found
    is_there = bool((np.round(points[-1]) == grid.world_to_cell(goal[0], goal[1])).all())
    if isinstance(options, GlobalPlannerOptions) and options.old_navfn_behavior:
        points = points - 0.5
    x, y = grid.cell_to_world(points[:, 0], points[:, 1])
    poses = np.column_stack([x, y, np.zeros(len(x))])
    return Plan(directed(poses, start, goal, options, is_there), cost)


def _prepared(grid: CostGrid, start: Pose, options: PlannerOptions) -> NDArray[np.uint8]:
    """Return costs with a free start and, where the planner wants it, a wall around them."""
    costs = grid.costs.copy()
    column, row = grid.world_to_cell(start[0], start[1])
    costs[row, column] = FREE
    outline = isinstance(options, GlobalPlannerOptions) and options.outline_map
    if outline or isinstance(options, NavfnOptions | Nav2NavfnOptions):
        costs[[0, -1]] = LETHAL
        costs[:, [0, -1]] = LETHAL
    return costs


def _search(
    costs: NDArray[np.uint8],
    grid: CostGrid,
    start: Pose,
    goal: Pose,
    options: PlannerOptions,
    reach: float,
) -> _Found | None:
    """Return points in cells, centres are whole numbers, and the cost."""
    width = grid.width
    here, there = (_number(grid, pose, width) for pose in (start, goal))
    if isinstance(options, ThetaStarOptions):
        return _any_angle(costs, here, there, options)
    if isinstance(options, Smac2DOptions):
        return _cells(costs, here, there, smac_table(options), reach, options.max_iterations, True)
    if isinstance(options, GlobalPlannerOptions):
        table = global_planner_table(options)
        if not options.use_dijkstra:
            relative = (table / np.float32(options.neutral_cost)).astype(np.float32)
            return _cells(costs, here, there, relative, 0.0, -1, not options.use_grid_path)
        return _down(costs, here, there, table, options, reach)
    table = navfn_table(options.allow_unknown)
    if isinstance(options, Nav2NavfnOptions) and options.use_astar:
        return _cells(
            costs, here, there, (table / np.float32(50)).astype(np.float32), reach, -1, True
        )
    return _down(costs, here, there, table, options, reach)


def _number(grid: CostGrid, pose: Pose, width: int) -> int:
    """Return the number of a pose's cell, kept inside of the grid."""
    column, row = grid.world_to_cell(pose[0], pose[1])
    return min(max(row, 0), grid.height - 1) * width + min(max(column, 0), width - 1)


def _down(
    costs: NDArray[np.uint8],
    start: int,
    goal: int,
    table: NDArray[np.float32],
    options: PlannerOptions,
    reach: float,
) -> _Found | None:
    """Spread a potential from the start and go down from the goal."""
    from gazelle.navigation.planners.kernels import descend_cells, descend_gradient, navfn_potential

    width = costs.shape[1]
    quadratic, neutral, straight = True, 50.0, False
    if isinstance(options, GlobalPlannerOptions):
        quadratic, straight = options.use_quadratic, options.use_grid_path
        neutral = float(options.neutral_cost)
    potential = navfn_potential(costs, table, start, goal, quadratic, 5 * neutral, 2 * neutral)
    end = _nearest_reached(potential.reshape(costs.shape), goal, reach)
    if end is None:
        return None
    points = np.empty((0, 2)) if straight else descend_gradient(potential, width, end, start, 0.5)
    if not len(points):
        cells = descend_cells(potential, width, end, start)
        points = np.column_stack([cells % width, cells // width]).astype(float)
    return (points[::-1], float(potential[end])) if len(points) else None


def _nearest_reached(potential: NDArray[np.float32], goal: int, reach: float) -> int | None:
    from gazelle.navigation.planners.kernels import HIGH

    height, width = potential.shape
    gx, gy, r = goal % width, goal // width, int(reach)
    if potential[gy, gx] < HIGH:
        return goal
    rows = np.arange(max(gy - r, 0), min(gy + r + 1, height))[:, None]
    columns = np.arange(max(gx - r, 0), min(gx + r + 1, width))[None, :]
    away = (rows - gy) ** 2 + (columns - gx) ** 2
    away = np.where(potential[rows, columns] < HIGH, away, np.iinfo(np.int64).max)
    best = int(away.argmin())
    if away.ravel()[best] == np.iinfo(np.int64).max:
        return None
    row, column = np.unravel_index(best, away.shape)
    return int(rows[row, 0] * width + columns[0, column])


def _cells(
    costs: NDArray[np.uint8],
    start: int,
    goal: int,
    table: NDArray[np.float32],
    reach: float,
    most: int,
    smooth: bool,
) -> _Found | None:
    """Search by A*."""
    from gazelle.navigation.planners.kernels import smooth_path
    from gazelle.navigation.planners.search_kernels import astar

    width = costs.shape[1]
    cells, cost, _looked = astar(costs, table, start, goal, reach, most)
    if not len(cells):
        return None
    points = np.column_stack([cells % width, cells // width]).astype(float)
    if smooth:
        smooth_path(points, costs, table, 0.1, 0.3, 200)
    return points, float(cost)


def _any_angle(
    costs: NDArray[np.uint8], start: int, goal: int, options: ThetaStarOptions
) -> _Found | None:
    from gazelle.navigation.planners.search_kernels import theta_star

    width, table = costs.shape[1], theta_table(options)
    corners = 8 if options.how_many_corners == 8 else 4
    cells, cost = theta_star(costs, table, start, goal, corners, options.w_euc_cost)
    if not len(cells):
        return None
    turns = np.column_stack([cells % width, cells // width]).astype(float)
    return _filled(turns), float(cost)


def _filled(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a path with points at most a cell apart."""
    parts = [turns[:1]]
    for a, b in itertools.pairwise(turns):
        count = max(int(np.ceil(np.hypot(*(b - a)))), 1)
        parts.append(a + (b - a) * (np.arange(1, count + 1) / count)[:, None])
    return np.concatenate(parts)


def _tolerance(options: PlannerOptions) -> float:
    if isinstance(options, NavfnOptions):
        return options.default_tolerance
    if isinstance(options, Nav2NavfnOptions | Smac2DOptions):
        return options.tolerance
    return 0.0
