"""Paths of every planner."""

from __future__ import annotations

import heapq
import math

import numpy as np
import pytest

from gazelle.navigation.costmap import CostGrid, Footprint, InflationOptions, inflated
from gazelle.navigation.planners import (
    PLANNERS,
    REFUSED_PLANNERS,
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    NoPlan,
    Plan,
    PlanFailure,
    PlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
    make_plan,
)

_ALL: tuple[PlannerOptions, ...] = (
    NavfnOptions(),
    GlobalPlannerOptions(),
    GlobalPlannerOptions(use_dijkstra=False),
    GlobalPlannerOptions(use_grid_path=True),
    GlobalPlannerOptions(use_quadratic=False),
    Nav2NavfnOptions(),
    Nav2NavfnOptions(use_astar=True),
    Smac2DOptions(),
    ThetaStarOptions(),
)
_IDS = ["navfn", "global", "global-astar", "global-grid", "global-linear", "nav2-navfn",
        "nav2-astar", "smac", "theta"]  # fmt: skip
every_planner = pytest.mark.parametrize("options", _ALL, ids=_IDS)


def test_every_planner_has_options_of_its_own() -> None:
    kinds = {id(kind) for kind in PLANNERS.values()}
    assert len({kind.options for kind in PLANNERS.values()}) == len(kinds)


def _room(walls: np.ndarray | None = None, size: int = 80) -> CostGrid:
    """4 m × 4 m, (0, 0) in the lower left corner, a wall with a gap at the top."""
    costs = np.zeros((size, size), np.uint8)
    costs[[0, -1]] = 254
    costs[:, [0, -1]] = 254
    costs[: size * 3 // 4, size // 2] = 254
    if walls is not None:
        costs[walls] = 254
    raw = CostGrid(costs, 0.05)
    return inflated(raw, InflationOptions(inflation_radius=0.4), Footprint.of_radius(0.15))


def _plan(grid: CostGrid, options: PlannerOptions, goal: tuple[float, float, float]) -> Plan:
    found = make_plan(grid, (1.0, 1.0, 0.5), goal, options)
    assert isinstance(found, Plan), found
    return found


@every_planner
def test_paths_lead_around_the_wall_to_the_goal(options: PlannerOptions) -> None:
    grid = _room()
    plan = _plan(grid, options, (3.0, 1.0, 1.5))
    np.testing.assert_allclose(plan.poses[0, :2], (1.0, 1.0), atol=0.08)
    np.testing.assert_allclose(plan.poses[-1], (3.0, 1.0, 1.5), atol=1e-9)
    assert plan.poses[:, 1].max() > 3.0
    costs = [grid.cost_at(x, y) for x, y, _ in plan.poses[1:]]
    assert max(costs) < 253
    steps = np.hypot(*np.diff(plan.poses[:, :2], axis=0).T)
    assert steps.max() < 0.12
    # Around the end of the wall at (2.0, 3.0), a straight line would be 4.47 m.
    assert 4.47 < plan.length_m < 6.2


@every_planner
@pytest.mark.parametrize("seed", range(4))
def test_paths_are_found_exactly_where_there_is_a_way(options: PlannerOptions, seed: int) -> None:
    """Law: a plan exists where flood filling reaches, for random rooms."""
    from scipy.ndimage import label

    rng = np.random.default_rng(seed)
    grid = _room(rng.random((80, 80)) < 0.02)
    free = (grid.costs < 253) & (np.arange(80) % 79 > 0) & (np.arange(80) % 79 > 0)[:, None]
    start = grid.world_to_cell(1.0, 1.0)
    free[start[1], start[0]] = True
    regions, _count = label(free)
    for _ in range(8):
        row, column = rng.integers(2, 78, 2)
        if not free[row, column]:
            continue
        x, y = map(float, grid.cell_to_world(column, row))
        goal = (x, y, 0.0)
        found = make_plan(grid, (1.0, 1.0, 0.0), goal, options, tolerance_m=0.0)
        same = regions[row, column] == regions[start[1], start[0]]
        if same:
            assert isinstance(found, Plan), found
        elif isinstance(found, Plan):
            # Diagonal steps lead through corners that flood filling over sides does not pass.
            assert not isinstance(options, NavfnOptions)


def _dijkstra(grid: CostGrid, start: int, goal: int, weight: float) -> float:
    """The textbook's, over eight neighbours."""
    height, width = grid.costs.shape
    best = {start: 0.0}
    queue = [(0.0, start)]
    while queue:
        cost, cell = heapq.heappop(queue)
        if cell == goal:
            return cost
        if cost > best[cell]:
            continue
        y, x = divmod(cell, width)
        for v in range(max(y - 1, 0), min(y + 2, height)):
            for u in range(max(x - 1, 0), min(x + 2, width)):
                value = int(grid.costs[v, u])
                if value >= 253 or (u, v) == (x, y):
                    continue
                step = math.hypot(u - x, v - y) * (1 + weight * value / 252)
                if cost + step < best.get(v * width + u, math.inf):
                    best[v * width + u] = cost + step
                    heapq.heappush(queue, (cost + step, v * width + u))
    return math.inf


@pytest.mark.parametrize("seed", range(3))
def test_astar_costs_what_dijkstra_costs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grid = _room(rng.random((80, 80)) < 0.01)
    options = Smac2DOptions(cost_travel_multiplier=2.0, allow_unknown=False)
    found = make_plan(grid, (1.0, 1.0, 0.0), (3.0, 1.0, 0.0), options, tolerance_m=0.0)
    want = _dijkstra(grid, 20 * 80 + 20, 20 * 80 + 60, 2.0)
    if math.isinf(want):
        assert isinstance(found, NoPlan)
    else:
        assert isinstance(found, Plan)
        assert found.cost == pytest.approx(want, rel=1e-4)


def test_potential_grows_like_distance_in_the_open() -> None:
    """50 a cell: NavFn's planar wave is within 8 % of the straight line in every direction."""
    grid = CostGrid(np.zeros((120, 120), np.uint8), 0.05)
    for angle in np.linspace(0, math.tau, 16, endpoint=False):
        goal = (3.0 + 2.0 * math.cos(angle), 3.0 + 2.0 * math.sin(angle), 0.0)
        found = make_plan(grid, (3.0, 3.0, 0.0), goal, NavfnOptions())
        assert isinstance(found, Plan)
        assert found.cost / 50 * 0.05 == pytest.approx(2.0, rel=0.08)
        assert found.length_m == pytest.approx(2.0, abs=0.15)


def test_any_angle_paths_are_straight_in_the_open() -> None:
    grid = CostGrid(np.zeros((120, 120), np.uint8), 0.05)
    found = make_plan(grid, (1.0, 1.0, 0.0), (5.0, 2.3, 0.0), ThetaStarOptions())
    assert isinstance(found, Plan)
    assert found.length_m == pytest.approx(math.hypot(4.0, 1.3), abs=0.06)


@every_planner
def test_a_goal_in_an_obstacle_is_refused_with_the_nearest_free_place(
    options: PlannerOptions,
) -> None:
    found = make_plan(_room(), (1.0, 1.0, 0.0), (2.01, 1.0, 0.0), options, tolerance_m=0.0)
    assert isinstance(found, NoPlan)
    assert found.failure is PlanFailure.GOAL_OCCUPIED
    assert "The goal (2.01, 1.00) lies in an obstacle (cost 254)" in found.reason
    assert "nearest free place is (" in found.reason


@every_planner
def test_a_walled_off_goal_is_refused(options: PlannerOptions) -> None:
    grid = _room()
    grid.costs[:, 40] = 254
    found = make_plan(grid, (1.0, 1.0, 0.0), (3.0, 1.0, 0.0), options)
    assert isinstance(found, NoPlan)
    assert found.failure is PlanFailure.NO_VALID_PATH
    assert "no way leads there from (1.00, 1.00)" in found.reason


@every_planner
def test_places_off_the_map_are_refused(options: PlannerOptions) -> None:
    off = make_plan(_room(), (1.0, 1.0, 0.0), (9.0, 1.0, 0.0), options)
    assert isinstance(off, NoPlan)
    assert off.failure is PlanFailure.GOAL_OUTSIDE_MAP
    assert "x 0.00 … 4.00 m" in off.reason
    lost = make_plan(_room(), (-1.0, 1.0, 0.0), (3.0, 1.0, 0.0), options)
    assert isinstance(lost, NoPlan)
    assert lost.failure is PlanFailure.START_OUTSIDE_MAP
    assert "properly localized?" in lost.reason
    odd = make_plan(_room(), (1.0, math.nan, 0.0), (3.0, 1.0, 0.0), options)
    assert isinstance(odd, NoPlan)


@pytest.mark.parametrize(
    "options",
    [NavfnOptions(), Nav2NavfnOptions(), Nav2NavfnOptions(use_astar=True), Smac2DOptions()],
)
def test_within_the_tolerance_the_nearest_place_counts(options: PlannerOptions) -> None:
    found = make_plan(_room(), (1.0, 1.0, 0.0), (2.01, 1.0, 0.0), options, tolerance_m=0.5)
    assert isinstance(found, Plan)
    assert 0.13 < math.hypot(found.poses[-1, 0] - 2.01, found.poses[-1, 1] - 1.0) < 0.35


@every_planner
def test_paths_of_a_step_still_end_in_the_goal(options: PlannerOptions) -> None:
    """A planner that ends in the robot's own cell lets the robot stop a cell too early."""
    for dx in (-0.04, 0.02, 0.09):
        for dy in (-0.04, 0.02, 0.09):
            goal = (1.0 + dx, 1.0 + dy, 0.5)
            np.testing.assert_allclose(_plan(_room(), options, goal).poses[-1], goal, atol=1e-9)


def test_a_robot_in_an_inflated_cell_still_gets_a_path() -> None:
    grid = _room()
    found = make_plan(grid, (0.12, 2.0, 0.0), (1.0, 1.0, 0.0), Smac2DOptions())
    assert isinstance(found, NoPlan | Plan)
    assert grid.cost_at(0.12, 2.0) == 253
    edge = make_plan(grid, (0.19, 2.0, 0.0), (1.0, 1.0, 0.0), NavfnOptions())
    assert isinstance(edge, Plan)


def test_a_robot_in_an_obstacle_is_told() -> None:
    grid = _room()
    grid.costs[15:25, 15:25] = 254
    found = make_plan(grid, (1.0, 1.0, 0.0), (1.0, 3.0, 0.0), NavfnOptions())
    assert isinstance(found, NoPlan)
    assert found.failure is PlanFailure.START_OCCUPIED


@pytest.mark.parametrize("options", _ALL, ids=_IDS)
def test_unknown_space_is_crossed_only_when_allowed(options: PlannerOptions) -> None:
    from dataclasses import replace

    grid = _room()
    grid.costs[:, 20:30] = 255
    through = make_plan(grid, (0.5, 1.0, 0.0), (1.8, 1.0, 0.0), options)
    assert isinstance(through, Plan)
    barred = make_plan(
        grid, (0.5, 1.0, 0.0), (1.8, 1.0, 0.0), replace(options, allow_unknown=False)
    )
    assert isinstance(barred, NoPlan)


@pytest.mark.parametrize(
    ("mode", "middle", "last"),
    [(0, 0.0, 0.7), (1, 0.0, 0.7), (2, 0.6, 0.7), (4, -math.pi, 0.7), (5, -math.pi / 2, 0.7),
     (6, math.pi / 2, 0.7)],
)  # fmt: skip
def test_orientation_modes(mode: int, middle: float, last: float) -> None:
    grid = CostGrid(np.zeros((80, 80), np.uint8), 0.05)
    options = GlobalPlannerOptions(orientation_mode=mode, outline_map=False)
    found = make_plan(grid, (1.0, 1.0, 0.5), (3.0, 1.0, 0.7), options)
    assert isinstance(found, Plan)
    half = found.poses[len(found.poses) // 2, 2]
    assert abs(math.remainder(half - middle, math.tau)) < 0.06
    assert found.poses[-1, 2] == pytest.approx(last)


def test_the_final_approach_gives_the_last_direction() -> None:
    grid = CostGrid(np.zeros((80, 80), np.uint8), 0.05)
    options = Nav2NavfnOptions(use_final_approach_orientation=True)
    found = make_plan(grid, (1.0, 1.0, 0.0), (1.0, 3.0, 0.0), options)
    assert isinstance(found, Plan)
    assert found.poses[-1, 2] == pytest.approx(math.pi / 2, abs=0.2)


def test_old_navfn_behavior_goes_along_corners_of_cells() -> None:
    grid = CostGrid(np.zeros((80, 80), np.uint8), 0.05)
    plans = [
        _plan(grid, GlobalPlannerOptions(old_navfn_behavior=old), (3.0, 1.0, 0.0))
        for old in (False, True)
    ]
    offset = plans[0].poses[0, :2] - plans[1].poses[0, :2]
    np.testing.assert_allclose(offset, 0.025)


def test_paths_keep_away_from_walls_more_with_a_higher_cost_factor() -> None:
    grid = _room()
    lengths = []
    for factor in (0.1, 3.0):
        options = GlobalPlannerOptions(cost_factor=factor)
        lengths.append(_plan(grid, options, (3.0, 1.0, 0.0)).length_m)
    assert lengths[0] < lengths[1]


def test_names_of_both_generations_are_known() -> None:
    assert PLANNERS["navfn/NavfnROS"].options is NavfnOptions
    assert PLANNERS["nav2_navfn_planner::NavfnPlanner"].options is Nav2NavfnOptions
    assert "turn" in REFUSED_PLANNERS["nav2_smac_planner/SmacPlannerHybrid"]
    assert not PLANNERS.keys() & REFUSED_PLANNERS.keys()
