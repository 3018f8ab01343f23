"""TrajectoryPlannerROS chooses as its source says."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gazelle.navigation.controllers import (
    CONTROLLERS,
    Command,
    ControllerSetting,
    NoCommand,
    RobotState,
    TrajectoryPlanner,
    TrajectoryPlannerOptions,
)
from gazelle.navigation.costmap import CostGrid, Footprint

_SQUARE = Footprint.parse([[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1]])
_OPTIONS = TrajectoryPlannerOptions(holonomic_robot=False, min_vel_x=0.1, max_vel_x=0.5)
_EAST = np.column_stack([np.linspace(1.02, 2.42, 29), np.full(29, 1.5), np.zeros(29)])


def _grid() -> CostGrid:
    """Three metres square, free."""
    return CostGrid(np.zeros((60, 60), np.uint8), 0.05)


def _planner(plan: np.ndarray = _EAST, **options: Any) -> TrajectoryPlanner:
    planner = TrajectoryPlanner(replace(_OPTIONS, **options), 0.1)
    planner.set_plan(plan)
    return planner


def _command(planner: TrajectoryPlanner, grid: CostGrid, *pose: float) -> Command:
    x, y, yaw = pose
    found = planner.compute(RobotState((x, y, yaw)), grid, _SQUARE)
    assert isinstance(found, Command), found
    return found


def test_cost_is_the_weighted_distances_at_the_end_and_the_worst_cell() -> None:
    """Straight ahead along the path: 0 cells off it, and the goal is as far as is left of it."""
    grid = _grid()
    grid.costs[26:34, 24:26] = 90
    only = {"vx_samples": 1, "vtheta_samples": 1, "min_vel_x": 0.5, "sim_time": 1.0}
    weights = {"goal_distance_bias": 0.8, "occdist_scale": 0.01, "sim_granularity": 0.05}
    planner = _planner(acc_lim_x=1e9, **only, **weights)
    found = _command(planner, grid, 1.02, 1.51, 0.0)
    assert found.velocity == (0.5, 0.0, 0.0)
    # 10 poses of which the last is 0.45 m on, in column 29; the goal's is 48.
    assert found.cost == pytest.approx(0.8 * (48 - 29) + 0.01 * 90)


def test_weights_per_metre_are_multiplied_by_the_resolution() -> None:
    grid = _grid()
    grid.costs[:] = 100
    kind = CONTROLLERS["base_local_planner/TrajectoryPlannerROS"]
    found = {}
    for name in ("pdist_scale", "path_distance_bias"):
        for meter_scoring in (False, True):
            options = replace(_OPTIONS, meter_scoring=meter_scoring, occdist_scale=1.0)
            planner = kind.make(options, ControllerSetting(0.1, {}, given=(name,)))
            planner.set_plan(_EAST)
            found[name, meter_scoring] = _command(planner, grid, 1.0, 1.5, 0.0).cost
    before = found["pdist_scale", False]
    assert found["path_distance_bias", False] == before
    # Up to ROS Lunar, whose names these are, obstacles count per metre, too.
    assert found["pdist_scale", True] == pytest.approx(0.05 * before)
    assert found["path_distance_bias", True] == pytest.approx(0.05 * (before - 100) + 100)


def test_turns_on_the_spot_are_fast_enough_to_happen() -> None:
    west = np.column_stack([np.linspace(1, 0.3, 15), np.full(15, 1.5), np.full(15, math.pi)])
    grid = _grid()
    grid.costs[26:34, 24:26] = 254
    found = _command(_planner(west, dwa=True, acc_lim_theta=3.0), grid, 1.0, 1.5, 0.3)
    assert found.velocity[0] == 0.0
    assert abs(found.velocity[2]) == 0.4


def test_a_turn_that_was_begun_is_not_taken_back_before_the_robot_has_moved() -> None:
    grid = _grid()
    grid.costs[:] = 254
    # A cage in which the robot can only turn.
    grid.costs[25:35, 15:25] = 0
    planner = _planner(oscillation_reset_dist=0.05, sim_time=1.0, heading_lookahead=0.2)
    west = np.column_stack([np.linspace(1, 0.8, 5), np.full(5, 1.5), np.full(5, math.pi)])
    turns = []
    for yaw in (0.4, -0.4, 0.4, -0.4, 0.4, -0.4):
        planner.set_plan(west)
        turns.append(_command(planner, grid, 1.0, 1.5, yaw).velocity[2])
    # Right is better with 0.4, left with -0.4; what was begun twice is gone on with.
    assert np.sign(turns).tolist() == [-1, 1, -1, -1, -1, -1]
    planner.set_plan(_EAST)
    assert _command(planner, _grid(), 1.08, 1.5, 0.0).velocity[0] > 0.0
    planner.set_plan(west)
    assert _command(planner, grid, 1.0, 1.5, -0.4).velocity[2] > 0.0


def _walled(behind: bool) -> CostGrid:
    """Walls so near that the robot can neither turn nor drive on."""
    grid = _grid()
    # Its outline is in cells 18 to 22 along x, 28 to 32 along y.
    grid.costs[27, 14:28] = grid.costs[33, 14:28] = 254
    grid.costs[27:34, 23] = 254
    if behind:
        # A way leads out, but not for the robot.
        grid.costs[29:34, 17] = 254
    return grid


def test_a_robot_with_nothing_else_left_backs_up_until_it_is_somewhere_else() -> None:
    narrow = {"min_in_place_vel_theta": 1.0, "min_vel_theta": -1.0}
    planner = _planner(escape_vel=-0.2, escape_reset_dist=0.1, **narrow)
    assert _command(planner, _walled(behind=False), 1.02, 1.52, 0.0).velocity == (-0.2, 0.0, 0.0)
    free = _grid()
    # Free again, but it still escapes: no way ahead is tried.
    assert _command(planner, free, 0.98, 1.52, 0.0).velocity[0] <= 0.0
    assert _command(planner, free, 0.9, 1.52, 0.0).velocity[0] > 0.0


def test_a_robot_does_not_back_into_an_obstacle_that_it_does_not_touch() -> None:
    planner, state = _planner(), RobotState((1.02, 1.52, 0.0))
    found = planner.compute(state, _walled(behind=True), _SQUARE)
    assert isinstance(found, NoCommand)
    assert "behind the robot is an obstacle" in found.reason
    # Where it stands in one it may, as the original does: it may come free.
    grid = _walled(behind=False)
    grid.costs[28:33, 22] = 254
    assert _command(planner, grid, 1.02, 1.52, 0.0).velocity == (-0.1, 0.0, 0.0)


def test_a_robot_that_can_strafes_where_it_can_neither_drive_nor_turn() -> None:
    north = np.column_stack([np.full(21, 1.02), np.linspace(1.52, 2.5, 21), np.full(21, 1.57)])
    grid = _grid()
    grid.costs[20:60, 17] = grid.costs[20:60, 23] = grid.costs[26, 17:24] = 254
    planner = _planner(north, holonomic_robot=True, escape_vel=-0.1, y_vels=("-0.3,-0.1", "0.1"))
    assert _command(planner, grid, 1.02, 1.52, 0.0).velocity == (0.0, 0.1, 0.0)


def test_headings_are_scored_by_what_of_the_path_is_in_sight() -> None:
    plan = np.vstack([_EAST[:21], np.column_stack([np.full(20, 2), np.linspace(1.55, 2.5, 20),
                                                   np.full(20, 1.57)])])  # fmt: skip
    options = {"heading_scoring": True, "path_distance_bias": 0.0, "goal_distance_bias": 0.0}
    grid = _grid()
    found = _command(_planner(plan, dwa=True, **options), grid, 1.0, 1.5, 0.0)
    # The end of the path is seen across the corner, to the left of where the path leads.
    assert found.velocity[2] > 0.0
    grid.costs[32:60, 34:36] = 254
    found = _command(_planner(plan, dwa=True, **options), grid, 1.0, 1.5, 0.2)
    assert found.velocity[2] < 0.0


def test_a_goal_attracts_in_a_straight_line_with_simple_attractor() -> None:
    corners = [(1.0, 1.0, 1.57), (1.0, 2.0, 0.0), (2.0, 2.0, -1.57), (2.0, 1.0, -1.57)]
    turns, grid = [], _grid()
    grid.costs[:36, 34] = 254
    for simple in (False, True):
        options = {"simple_attractor": simple, "path_distance_bias": 5.0, "goal_distance_bias": 0.1}
        planner = _planner(np.array(corners), **options)
        turns.append(_command(planner, grid, 1.0, 1.0, math.pi / 2).velocity[2])
    # The plan leads straight on, the goal lies to the right behind a wall.
    assert abs(turns[0]) < 0.2
    assert turns[1] < -0.3


def test_a_speed_below_the_lowest_is_driven_where_only_it_is_left() -> None:
    planner = _planner(min_vel_x=0.2)
    planner.limit_speed(0.05)
    assert _command(planner, _grid(), 1.0, 1.5, 0.0).velocity[0] == 0.2
