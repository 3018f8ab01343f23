"""Planning with any planner."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import FREE, LETHAL, CostGrid
from gazelle.navigation.planners.path_orientations import directed
from gazelle.navigation.planners.plan import NoPlan, Plan
from gazelle.navigation.planners.planner import PlannerOptions, Search
from gazelle.navigation.planners.refusal import refuse_ends, why_no_path
from gazelle.navigation.planners.registry import kind_of

__all__ = ["make_plan"]

Pose = tuple[float, float, float]


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
    kind = kind_of(options)
    tolerance = kind.tolerance_m(options) if tolerance_m is None else tolerance_m
    refusal = refuse_ends(grid, start, goal, tolerance)
    if refusal is not None:
        return refusal
    costs = _prepared(grid, start, is_walled=kind.is_walled(options))
    here, there = (_number(grid, pose) for pose in (start, goal))
    found = kind.search(Search(costs, here, there, tolerance / grid.resolution_m), options)
    if found is None:
        return why_no_path(grid, start, goal, tolerance, options.allow_unknown)
    points = found.points
    is_there = bool((np.round(points[-1]) == grid.world_to_cell(goal[0], goal[1])).all())
    points = points + found.shift
    x, y = grid.cell_to_world(points[:, 0], points[:, 1])
    poses = np.column_stack([x, y, np.zeros(len(x))])
    return Plan(directed(poses, start, goal, kind.facing(options), is_there), found.cost)


def _prepared(grid: CostGrid, start: Pose, *, is_walled: bool) -> NDArray[np.uint8]:
    """Return costs with a free start and, where the planner wants it, a wall around them."""
    costs = grid.costs.copy()
    column, row = grid.world_to_cell(start[0], start[1])
    costs[row, column] = FREE
    if is_walled:
        costs[[0, -1]] = LETHAL
        costs[:, [0, -1]] = LETHAL
    return costs


def _number(grid: CostGrid, pose: Pose) -> int:
    """Return the number of a pose's cell, kept inside of the grid."""
    column, row = grid.world_to_cell(pose[0], pose[1])
    width = grid.width
    return min(max(row, 0), grid.height - 1) * width + min(max(column, 0), width - 1)
