"""The searches of ROS's planners, and what entering a cell costs each of them."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import INSCRIBED, UNKNOWN
from gazelle.navigation.planners.planner import Route, Search
from gazelle.navigation.planners.planner_parameters import (
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    Smac2DOptions,
    ThetaStarOptions,
)

__all__ = [
    "any_angle",
    "global_planner",
    "global_planner_table",
    "nav2_navfn",
    "navfn",
    "navfn_table",
    "smac_2d",
    "smac_table",
    "theta_table",
]


_FORBIDDEN = np.float32(1e9)

_COSTS: NDArray[np.float64] = np.arange(256, dtype=float)


def navfn_table(allow_unknown: bool) -> NDArray[np.float32]:
    """Return 50 + 0.8 · cost, at most 253, (256,) by cost, as ``NavFn::setCostmap``."""
    table: NDArray[np.float32] = np.minimum(np.floor(50 + 0.8 * _COSTS), 253).astype(np.float32)
    table[INSCRIBED:] = _FORBIDDEN
    if allow_unknown:
        table[UNKNOWN] = 253
    return table


def global_planner_table(options: GlobalPlannerOptions) -> NDArray[np.float32]:
    """Return neutral_cost + cost_factor · cost below lethal_cost, (256,), by ``getCost``."""
    lethal = options.lethal_cost
    steps = np.minimum(options.neutral_cost + options.cost_factor * _COSTS, lethal - 1)
    table: NDArray[np.float32] = steps.astype(np.float32)
    table[max(lethal - 1, 0) :] = _FORBIDDEN
    if options.allow_unknown:
        table[UNKNOWN] = lethal - 1
    elif lethal > UNKNOWN:
        table[UNKNOWN] = _FORBIDDEN
    return table


def smac_table(options: Smac2DOptions) -> NDArray[np.float32]:
    """Return 1 + cost_travel_multiplier · cost / 252, (256,), by ``getTraversalCost``."""
    return _relative(1 + options.cost_travel_multiplier * _COSTS / 252, options.allow_unknown)


def theta_table(options: ThetaStarOptions) -> NDArray[np.float32]:
    """Return w_traversal_cost · (cost / 252)², (256,), by ``ThetaStar::getTraversalCost``."""
    # Cheap cells count as 50 there, so that paths do not hug walls for a few millimetres.
    costs = np.maximum(_COSTS, 50) / 252
    return _relative(options.w_traversal_cost * costs * costs, options.allow_unknown)


def _relative(steps: NDArray[np.float64], allow_unknown: bool) -> NDArray[np.float32]:
    table: NDArray[np.float32] = steps.astype(np.float32)
    table[INSCRIBED:] = _FORBIDDEN
    if allow_unknown:
        table[UNKNOWN] = table[INSCRIBED - 1]
    return table


_NEUTRAL = 50.0


def navfn(search: Search, options: NavfnOptions) -> Route | None:
    """Spread a potential and go down its gradient."""
    return _down(search, navfn_table(options.allow_unknown))


def nav2_navfn(search: Search, options: Nav2NavfnOptions) -> Route | None:
    """Go from cell to cell by A*, or as `navfn`."""
    table = navfn_table(options.allow_unknown)
    if not options.use_astar:
        return _down(search, table)
    return _cells(search, (table / np.float32(_NEUTRAL)).astype(np.float32), -1, True)


def global_planner(search: Search, options: GlobalPlannerOptions) -> Route | None:
    """Spread a potential, or search by A*."""
    table, neutral = global_planner_table(options), float(options.neutral_cost)
    if options.use_dijkstra:
        found = _down(
            search,
            table,
            neutral,
            quadratic=options.use_quadratic,
            straight=options.use_grid_path,
        )
    else:
        relative = (table / np.float32(neutral)).astype(np.float32)
        found = _cells(search._replace(reach=0.0), relative, -1, not options.use_grid_path)
    return found and found._replace(shift=-0.5 if options.old_navfn_behavior else 0.0)


def smac_2d(search: Search, options: Smac2DOptions) -> Route | None:
    """Search by A*, and smooth."""
    return _cells(search, smac_table(options), options.max_iterations, True)


def any_angle(search: Search, options: ThetaStarOptions) -> Route | None:
    """Go straight from corner to corner."""
    from gazelle.navigation.planners.astar_kernels import theta_star

    costs, start, goal, _reach = search
    width, table = costs.shape[1], theta_table(options)
    corners = 8 if options.how_many_corners == 8 else 4
    cells, cost = theta_star(costs, table, start, goal, corners, options.w_euc_cost)
    if not len(cells):
        return None
    turns = np.column_stack([cells % width, cells // width]).astype(float)
    return Route(_filled(turns), float(cost))


def _down(
    search: Search,
    table: NDArray[np.float32],
    neutral: float = _NEUTRAL,
    *,
    quadratic: bool = True,
    straight: bool = False,
) -> Route | None:
    """Spread a potential from the start and go down from the goal."""
    from gazelle.navigation.planners.navfn_kernels import (
        descend_cells,
        descend_gradient,
        navfn_potential,
    )

    costs, start, goal, reach = search
    width = costs.shape[1]
    potential = navfn_potential(costs, table, start, goal, quadratic, 5 * neutral, 2 * neutral)
    end = _nearest_reached(potential.reshape(costs.shape), goal, reach)
    if end is None:
        return None
    points = np.empty((0, 2)) if straight else descend_gradient(potential, width, end, start, 0.5)
    if not len(points):
        cells = descend_cells(potential, width, end, start)
        points = np.column_stack([cells % width, cells // width]).astype(float)
    return Route(points[::-1], float(potential[end])) if len(points) else None


def _nearest_reached(potential: NDArray[np.float32], goal: int, reach: float) -> int | None:
    from gazelle.navigation.planners.navfn_kernels import HIGH

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


def _cells(search: Search, table: NDArray[np.float32], most: int, smooth: bool) -> Route | None:
    """Search by A*."""
    from gazelle.navigation.planners.astar_kernels import astar
    from gazelle.navigation.planners.navfn_kernels import smooth_path

    costs, start, goal, reach = search
    width = costs.shape[1]
    cells, cost, _looked = astar(costs, table, start, goal, reach, most)
    if not len(cells):
        return None
    points = np.column_stack([cells % width, cells // width]).astype(float)
    if smooth:
        smooth_path(points, costs, table, 0.1, 0.3, 200)
    return Route(points, float(cost))


def _filled(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a path with points at most a cell apart."""
    parts = [turns[:1]]
    for a, b in itertools.pairwise(turns):
        count = max(int(np.ceil(np.hypot(*(b - a)))), 1)
        parts.append(a + (b - a) * (np.arange(1, count + 1) / count)[:, None])
    return np.concatenate(parts)
