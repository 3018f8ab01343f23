"""Planning with any planner, and why there is no path, in words."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import FREE, INSCRIBED, LETHAL, UNKNOWN, CostGrid
from gazelle.navigation.planners.path_orientations import directed
from gazelle.navigation.planners.planner import NoPlan, Plan, PlanFailure, PlannerOptions, Search
from gazelle.navigation.planners.registry import kind_of

__all__ = ["make_plan", "refuse_ends", "why_no_path"]


Pose = tuple[float, float, float]


def refuse_ends(grid: CostGrid, start: Pose, goal: Pose, tolerance_m: float) -> NoPlan | None:
    """Return why start or goal cannot be, None when they can."""
    if not all(map(math.isfinite, (*start, *goal))):
        return NoPlan(PlanFailure.NO_VALID_PATH, f"start {start} or goal {goal} is not a number")
    if not grid.contains(*grid.world_to_cell(start[0], start[1])):
        return NoPlan(
            PlanFailure.START_OUTSIDE_MAP,
            f"The robot's start position ({start[0]:.2f}, {start[1]:.2f}) is off the global "
            f"costmap, which is {_extent(grid)}. Are you sure the robot has been properly "
            "localized?",
        )
    if not grid.contains(*grid.world_to_cell(goal[0], goal[1])) and not _near(
        grid, goal, tolerance_m
    ):
        return NoPlan(
            PlanFailure.GOAL_OUTSIDE_MAP,
            f"The goal ({goal[0]:.2f}, {goal[1]:.2f}) is off the global costmap, which is "
            f"{_extent(grid)}.",
        )
    return None


def why_no_path(
    grid: CostGrid, start: Pose, goal: Pose, tolerance_m: float, allow_unknown: bool
) -> NoPlan:
    """Return what keeps a planner from the goal."""
    cost = grid.cost_at(goal[0], goal[1])
    within = f" within {tolerance_m:.2f} m" if tolerance_m > 0 else ""
    place = f"The goal ({goal[0]:.2f}, {goal[1]:.2f})"
    if cost in (LETHAL, INSCRIBED):
        what = "lies in an obstacle" if cost == LETHAL else "is too near to an obstacle"
        free = _nearest_free(grid, goal)
        hint = f"; the nearest free place is ({free[0]:.2f}, {free[1]:.2f})" if free else ""
        return NoPlan(PlanFailure.GOAL_OCCUPIED, f"{place} {what} (cost {cost}){hint}.")
    if cost == UNKNOWN and not allow_unknown:
        return NoPlan(PlanFailure.GOAL_OCCUPIED, f"{place} is unknown, and allow_unknown is false.")
    if grid.cost_at(start[0], start[1]) == LETHAL:
        return NoPlan(
            PlanFailure.START_OCCUPIED,
            f"The robot ({start[0]:.2f}, {start[1]:.2f}) stands in an obstacle of the global "
            "costmap, and nothing leads out of it.",
        )
    return NoPlan(
        PlanFailure.NO_VALID_PATH,
        f"{place} is free, but no way leads there from ({start[0]:.2f}, {start[1]:.2f}){within}: "
        "obstacles and what is inflated around them lie between.",
    )


def _extent(grid: CostGrid) -> str:
    x, y = grid.origin
    right, top = x + grid.width * grid.resolution_m, y + grid.height * grid.resolution_m
    return f"x {x:.2f} … {right:.2f} m, y {y:.2f} … {top:.2f} m"


def _near(grid: CostGrid, goal: Pose, tolerance_m: float) -> bool:
    """Tell whether the grid begins within the tolerance."""
    x, y = grid.origin
    dx = max(x - goal[0], goal[0] - x - grid.width * grid.resolution_m, 0.0)
    dy = max(y - goal[1], goal[1] - y - grid.height * grid.resolution_m, 0.0)
    return math.hypot(dx, dy) < tolerance_m


def _nearest_free(grid: CostGrid, goal: Pose) -> tuple[float, float] | None:
    rows, columns = np.nonzero(grid.costs < INSCRIBED)
    if not len(rows):
        return None
    x, y = grid.cell_to_world(columns, rows)
    best = int(((x - goal[0]) ** 2 + (y - goal[1]) ** 2).argmin())
    return float(x[best]), float(y[best])


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
