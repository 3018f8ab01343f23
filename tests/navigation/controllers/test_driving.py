"""Every controller drives a robot to its goal, in a plain kinematic world."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from gazelle.navigation.controllers import (
    CONTROLLERS,
    REFUSED_CONTROLLERS,
    Command,
    Controller,
    ControllerSetting,
    DwaOptions,
    DwbOptions,
    MppiOptions,
    NoCommand,
    PursuitOptions,
    RobotState,
    TrajectoryPlannerOptions,
)
from gazelle.navigation.controllers.followed_plan import FollowedPlan
from gazelle.navigation.costmap import (
    CostGrid,
    Footprint,
    InflationOptions,
    footprint_cost,
    inflated,
)
from gazelle.navigation.planners import NavfnOptions, Plan, make_plan

_BURGER = Footprint.parse(
    [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]
).padded(0.01)
# dwa_local_planner_params_burger.yaml of turtlebot3_navigation.
_DWA = DwaOptions(
    max_vel_x=0.22, min_vel_x=-0.22, max_vel_y=0.0, min_vel_y=0.0, max_vel_trans=0.22,
    min_vel_trans=0.11, max_vel_theta=2.75, min_vel_theta=1.37, acc_lim_x=2.5, acc_lim_y=0.0,
    acc_lim_theta=3.2, xy_goal_tolerance=0.05, yaw_goal_tolerance=0.17, sim_time=1.5,
    vx_samples=20, vy_samples=0, vth_samples=40, path_distance_bias=32.0,
    goal_distance_bias=20.0, occdist_scale=0.02, scaling_speed=0.25, max_scaling_factor=0.2,
)  # fmt: skip
# nav2_params.yaml of nav2_bringup.
_DWB = DwbOptions(
    max_vel_x=0.26, max_vel_theta=1.0, max_speed_xy=0.26, acc_lim_x=2.5, acc_lim_theta=3.2,
    decel_lim_x=-2.5, decel_lim_theta=-3.2, linear_granularity=0.05,
)  # fmt: skip
_DWB_CRITICS = {
    "BaseObstacle": {"scale": 0.02},
    "PathAlign": {"scale": 32.0, "forward_point_distance": 0.1},
    "GoalAlign": {"scale": 24.0, "forward_point_distance": 0.1},
    "PathDist": {"scale": 32.0},
    "GoalDist": {"scale": 24.0},
}
_PURSUIT = PursuitOptions(
    desired_linear_vel=0.22, rotate_to_heading_angular_vel=1.5,
    regulated_linear_scaling_min_speed=0.1,
)  # fmt: skip
# base_local_planner_params.yaml of turtlebot3_navigation.
_TRAJECTORY = TrajectoryPlannerOptions(
    max_vel_x=0.18, min_vel_x=0.08, max_vel_theta=1.0, min_vel_theta=-1.0,
    min_in_place_vel_theta=1.0, acc_lim_x=1.0, acc_lim_y=0.0, acc_lim_theta=0.6,
    xy_goal_tolerance=0.1, yaw_goal_tolerance=0.2, holonomic_robot=False, sim_time=0.8,
    vx_samples=18, vtheta_samples=20, sim_granularity=0.05,
)  # fmt: skip
_MPPI = MppiOptions(vx_max=0.26, vx_min=-0.1, batch_size=400)
Make = Callable[[], Controller]


def _make(name: str, options: object, period_s: float, critics: object = None) -> Make:
    setting = ControllerSetting(period_s, critics or {})  # type: ignore[arg-type]
    return lambda: CONTROLLERS[name].make(options, setting)


_DRIVERS = {
    "dwa": (_make("dwa_local_planner/DWAPlannerROS", _DWA, 0.1), 0.1),
    "dwb": (_make("dwb_core::DWBLocalPlanner", _DWB, 0.05, _DWB_CRITICS), 0.05),
    "mppi": (_make("nav2_mppi_controller::MPPIController", _MPPI, 0.05), 0.05),
    "pursuit": (
        _make(
            "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController", _PURSUIT, 0.05
        ),
        0.05,
    ),
    "rollout": (_make("base_local_planner/TrajectoryPlannerROS", _TRAJECTORY, 0.1), 0.1),
}
every_controller = pytest.mark.parametrize("name", list(_DRIVERS))


def _world(boxes: list[tuple[float, float]]) -> CostGrid:
    """5 m × 5 m with walls and boxes of 0.3 m."""
    costs = np.zeros((100, 100), np.uint8)
    costs[[0, -1]] = 254
    costs[:, [0, -1]] = 254
    for x, y in boxes:
        column, row = round(x / 0.05), round(y / 0.05)
        costs[row - 3 : row + 3, column - 3 : column + 3] = 254
    options = InflationOptions(inflation_radius=1.0, cost_scaling_factor=3.0)
    return inflated(CostGrid(costs, 0.05), options, _BURGER)


def _window(grid: CostGrid, pose: list[float]) -> CostGrid:
    """The 3 m × 3 m around a robot."""
    column, row = grid.world_to_cell(pose[0], pose[1])
    x0, y0 = max(column - 30, 0), max(row - 30, 0)
    part = np.ascontiguousarray(grid.costs[y0 : row + 30, x0 : column + 30])
    return CostGrid(part, 0.05, (x0 * 0.05, y0 * 0.05))


def _drive(
    controller: Controller,
    grid: CostGrid,
    pose: list[float],
    period_s: float,
    most_s: float,
) -> tuple[list[float], float, int]:
    """Return last pose, time and how often the robot hit something."""
    velocity, hits, state = [0.0, 0.0, 0.0], 0, RobotState((0.0, 0.0, 0.0))
    for step in range(int(most_s / period_s)):
        state = RobotState((pose[0], pose[1], pose[2]), (velocity[0], 0.0, velocity[2]))
        if controller.goal_reached(state):
            return pose, step * period_s, hits
        command = controller.compute(state, _window(grid, pose), _BURGER)
        wanted = (0.0, 0.0, 0.0) if isinstance(command, NoCommand) else command.velocity
        for _ in range(10):
            for axis, limit in ((0, 2.5), (2, 6.0)):
                most = limit * period_s / 10
                velocity[axis] += min(max(wanted[axis] - velocity[axis], -most), most)
            pose[0] += velocity[0] * math.cos(pose[2]) * period_s / 10
            pose[1] += velocity[0] * math.sin(pose[2]) * period_s / 10
            pose[2] += velocity[2] * period_s / 10
        hits += footprint_cost(grid, _BURGER, (pose[0], pose[1], pose[2])) == -1
    return pose, math.inf, hits


@every_controller
def test_robot_drives_around_boxes_into_its_goal(name: str) -> None:
    make, period_s = _DRIVERS[name]
    grid = _world([(2.0, 1.2), (2.6, 2.6), (3.4, 1.8)])
    plan = make_plan(grid, (1.0, 1.0, 0.0), (4.0, 3.0, 1.57), NavfnOptions())
    assert isinstance(plan, Plan)
    controller = make()
    controller.set_plan(plan.poses)
    pose, time_s, hits = _drive(controller, grid, [1.0, 1.0, 2.0], period_s, 60.0)
    assert hits == 0
    assert time_s < 3.0 * plan.length_m / 0.22
    tolerance = {"dwa": 0.06, "rollout": 0.11}.get(name, 0.26)
    assert math.hypot(pose[0] - 4.0, pose[1] - 3.0) < tolerance
    assert abs(math.remainder(pose[2] - 1.57, math.tau)) < 0.3


@pytest.mark.parametrize("name", ["dwb", "mppi", "pursuit", "rollout"])
@pytest.mark.parametrize("yaw", [math.pi, math.pi - 0.3, -2.6])
def test_robot_turns_to_a_path_that_lies_behind(name: str, yaw: float) -> None:
    make, period_s = _DRIVERS[name]
    controller = make()
    controller.set_plan(np.column_stack([np.linspace(2, 4, 40), np.full(40, 2.5), np.zeros(40)]))
    pose, time_s, hits = _drive(controller, _world([]), [2.0, 2.5, yaw], period_s, 40.0)
    assert hits == 0
    assert time_s < 35.0
    assert math.hypot(pose[0] - 4.0, pose[1] - 2.5) < 0.26


def test_dwb_looks_as_far_as_sim_time_reaches() -> None:
    """One period's turn moves the nose by less than a cell, so that no turn looked better."""
    firsts = []
    for generator in ("StandardTrajectoryGenerator", "LimitedAccelGenerator"):
        options = replace(_DWB, trajectory_generator_name=f"dwb_plugins::{generator}")
        controller = _make("dwb_core::DWBLocalPlanner", options, 0.05, _DWB_CRITICS)()
        path = np.column_stack([np.linspace(2, 4, 40), np.full(40, 2.5), np.zeros(40)])
        controller.set_plan(path)
        state = RobotState((2.0, 2.5, math.pi))
        command = controller.compute(state, _window(_world([]), [2.0, 2.5]), _BURGER)
        assert not isinstance(command, NoCommand)
        firsts.append(abs(command.velocity[2]))
    assert firsts[0] > 0.5
    assert firsts[1] <= 3.2 * 0.05 + 1e-9


def test_paths_that_lead_back_are_followed_in_order() -> None:
    out, back = np.linspace(2.0, 0.7, 27), np.linspace(0.7, 3.0, 47)
    rows = [np.column_stack([x, np.full(len(x), 2.5), np.zeros(len(x))]) for x in (out, back)]
    plan = FollowedPlan(np.vstack(rows))
    left = []
    for x in (*np.arange(2.0, 0.9, -0.1), 0.7, 1.4, 2.0):
        plan.advance((x, 2.5, 0.0), 3.0)
        left.append(plan.remaining_m())
    assert left == sorted(left, reverse=True)
    assert left[10] == pytest.approx(0.3 + 2.3, abs=0.06)
    assert left[-1] == pytest.approx(1.0, abs=0.06)


@every_controller
def test_a_speed_limit_is_kept(name: str) -> None:
    make, _period_s = _DRIVERS[name]
    grid = _world([])
    controller = make()
    controller.set_plan(np.column_stack([np.linspace(1, 4, 60), np.full(60, 2.5), np.zeros(60)]))
    controller.limit_speed(0.12)
    state = RobotState((1.0, 2.5, 0.0), (0.12, 0.0, 0.0))
    for _ in range(6):
        command = controller.compute(state, _window(grid, [1.0, 2.5]), _BURGER)
    assert not isinstance(command, NoCommand)
    assert 0.05 < command.velocity[0] <= 0.12 + 1e-9
    controller.limit_speed(None)
    for _ in range(6):
        command = controller.compute(
            RobotState((1.0, 2.5, 0.0), (0.2, 0.0, 0.0)), _window(grid, [1.0, 2.5]), _BURGER
        )
    assert not isinstance(command, NoCommand)
    # Rollout's fastest of those that end in the same cell is not its fastest of all.
    assert command.velocity[0] > (0.12 if name == "rollout" else 0.15)


@every_controller
def test_a_path_whose_frame_drifts_is_followed_on(name: str) -> None:
    path = np.column_stack([np.linspace(1, 4, 60), np.full(60, 2.5), np.zeros(60)])
    state, grid = RobotState((1.5, 2.5, 0.0), (0.2, 0.0, 0.0)), _window(_world([]), [1.5, 2.5])
    speeds = []
    for drift_m in (0.0, 0.001):
        controller = _DRIVERS[name][0]()
        controller.set_plan(path)
        for _ in range(6):
            controller.compute(state, grid, _BURGER)
        controller.set_plan(path + np.array([drift_m, 0.0, 0.0]), has_moved=True)
        command = controller.compute(state, grid, _BURGER)
        assert not isinstance(command, NoCommand)
        speeds.append(command.velocity[0])
        controller.set_plan(path + np.array([0.5, 0.0, 0.0]), has_moved=True)
        assert controller.goal_reached(RobotState((4.5, 2.5, 0.0)))
        assert not controller.goal_reached(RobotState((4.0, 2.5, 0.0)))
    assert speeds[0] > 0.1
    assert abs(speeds[1] - speeds[0]) < 0.02


@every_controller
def test_commands_keep_acceleration_limits(name: str) -> None:
    make, period_s = _DRIVERS[name]
    if name == "dwb":  # what one period cannot reach is left to velocity_smoother
        limited = replace(_DWB, trajectory_generator_name="dwb_plugins::LimitedAccelGenerator")
        make = _make("dwb_core::DWBLocalPlanner", limited, period_s, _DWB_CRITICS)
    if name == "rollout":
        limited = replace(_TRAJECTORY, dwa=True, min_in_place_vel_theta=0.05)
        make = _make("base_local_planner/TrajectoryPlannerROS", limited, period_s)
    controller = make()
    controller.set_plan(np.column_stack([np.linspace(1, 4, 60), np.full(60, 2.5), np.zeros(60)]))
    grid = _window(_world([]), [1.0, 2.5])
    command = controller.compute(RobotState((1.0, 2.5, 0.1)), grid, _BURGER)
    assert not isinstance(command, NoCommand)
    assert abs(command.velocity[2]) <= (3.5 if name == "mppi" else 3.2) * period_s + 1e-9
    if name != "pursuit":  # its speed has no acceleration limit in Nav2 either
        assert command.velocity[0] <= (3.0 if name == "mppi" else 2.5) * period_s + 1e-9


@pytest.mark.parametrize("name", ["dwa", "dwb", "mppi", "pursuit"])
def test_a_robot_in_an_obstacle_gets_no_command_and_a_reason(name: str) -> None:
    make, _period_s = _DRIVERS[name]
    grid = _world([])
    grid.costs[:] = 254
    controller = make()
    controller.set_plan(np.column_stack([np.linspace(1, 4, 60), np.full(60, 2.5), np.zeros(60)]))
    found = controller.compute(
        RobotState((1.0, 2.5, 0.0), (0.1, 0.0, 0.0)), _window(grid, [1.0, 2.5]), _BURGER
    )
    assert isinstance(found, NoCommand)
    words = {"dwa": "hit an obstacle", "dwb": "hit an obstacle", "mppi": "trajectories collide",
             "pursuit": "detected collision ahead"}  # fmt: skip
    assert words[name] in found.reason


def test_outlines_pass_over_no_cell_unseen() -> None:
    """A post between two points of a trajectory, beside the line that the centre goes along."""
    grid = _world([])
    grid.costs[52, 30] = 254
    along = np.column_stack([np.linspace(1, 2.2, 24), np.full(24, 2.5), np.zeros(24)])
    dwa = replace(
        _DWA, min_vel_x=0.22, max_vel_theta=0.0, min_vel_theta=0.0, sim_time=4.0,
        sim_granularity=1.0, vx_samples=1, vth_samples=1,
    )  # fmt: skip
    controller = _make("dwa_local_planner/DWAPlannerROS", dwa, 0.1)()
    controller.set_plan(along)
    state = RobotState((1.1, 2.51, 0.0), (0.22, 0.0, 0.0))
    found = controller.compute(state, _window(grid, [1.1, 2.51]), _BURGER)
    assert isinstance(found, NoCommand) and "1 hit an obstacle" in found.reason
    rollout = replace(
        _TRAJECTORY, min_vel_x=0.18, sim_time=4.0, sim_granularity=1.0, vx_samples=1,
        vtheta_samples=1, min_vel_theta=0.0,
    )  # fmt: skip
    controller = _make("base_local_planner/TrajectoryPlannerROS", rollout, 0.1)()
    controller.set_plan(along)
    found = controller.compute(state, _window(grid, [1.1, 2.51]), _BURGER)
    assert isinstance(found, Command) and found.velocity == (-0.1, 0.0, 0.0)


@every_controller
def test_without_a_path_there_is_no_command(name: str) -> None:
    controller = _DRIVERS[name][0]()
    found = controller.compute(RobotState((1.0, 1.0, 0.0)), _world([]), _BURGER)
    assert found == NoCommand("there is no path to follow")
    assert not controller.goal_reached(RobotState((1.0, 1.0, 0.0)))
    with pytest.raises(ValueError, match="at least one row"):
        controller.set_plan(np.zeros((0, 3)))


@every_controller
def test_the_same_inputs_give_the_same_command(name: str) -> None:
    commands = []
    for _ in range(2):
        controller = _DRIVERS[name][0]()
        controller.set_plan(
            np.column_stack([np.linspace(1, 4, 60), np.full(60, 2.5), np.zeros(60)])
        )
        found = controller.compute(
            RobotState((1.0, 2.4, 0.2)), _window(_world([(2.0, 2.5)]), [1.0, 2.4]), _BURGER
        )
        assert not isinstance(found, NoCommand)
        commands.append(found.velocity)
    assert commands[0] == commands[1]


def test_names_of_both_generations_are_known() -> None:
    assert CONTROLLERS["dwa_local_planner/DWAPlannerROS"].options is DwaOptions
    assert CONTROLLERS["nav2_mppi_controller::MPPIController"].options is MppiOptions
    assert "DWAPlannerROS" in REFUSED_CONTROLLERS["teb_local_planner/TebLocalPlannerROS"]
    assert not CONTROLLERS.keys() & REFUSED_CONTROLLERS.keys()
