"""Robots cross narrow fields: a plain kinematic world with move_base's executive.

Fields are 6 m × 5 m, with walls across that have a gap each, and posts between them; the narrowest
place of the way is 1.3 to 1.6 times as wide as the robot. Three robots in turns: like a Jackal,
like a TurtleBot3, and as long as a car. Each of the five controllers drives each field with
move_base's executive, its planner and its turning recovery; the robot moves as its commands and
limits of acceleration say, and what it touches is looked at with half a centimetre.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers import (
    CONTROLLERS,
    Command,
    Controller,
    ControllerSetting,
    DwaOptions,
    DwbOptions,
    MppiOptions,
    PursuitOptions,
    RobotState,
    TrajectoryPlannerOptions,
)
from gazelle.navigation.costmap import (
    LETHAL,
    CostGrid,
    Footprint,
    InflationOptions,
    footprint_cost,
    inflated,
)
from gazelle.navigation.planners import NavfnOptions, Plan, make_plan
from gazelle.nodes.move_base.state_machine import (
    MoveBaseStateMachine,
    Outcome,
    PlanPose,
    Timing,
    Trigger,
)

__all__ = ["DRIVERS", "ROBOTS", "Field", "Robot", "Run", "controller_for", "cross"]

_LENGTH_M, _WIDTH_M, _CELL_M, _FINE_M = 6.0, 5.0, 0.02, 0.005
_WINDOW_M, _PERIOD_S, _STEPS = 3.0, 0.1, 10
_GAP, _MAX_WIDTH = 1.3, 1.6
_MAX_S = 300.0
_START, _GOAL = (0.7, 2.5, 0.0), (5.3, 2.5, 0.0)


@dataclass(frozen=True, slots=True)
class Robot:
    """What drives.

    Attributes:
        name: what it is like.
        length_m, width_m: of its outline.
        fastest_m_s, fastest_rad_s: of it.
        acceleration: m/s² and rad/s².
    """

    name: str
    length_m: float
    width_m: float
    fastest_m_s: float
    fastest_rad_s: float
    acceleration: tuple[float, float]

    @property
    def footprint(self) -> Footprint:
        """Its outline, the centre in the middle."""
        x, y = self.length_m / 2, self.width_m / 2
        return Footprint.parse([[x, y], [-x, y], [-x, -y], [x, -y]])


ROBOTS = (
    Robot("jackal", 0.508, 0.43, 0.5, 1.57, (2.0, 4.0)),
    Robot("turtlebot", 0.21, 0.21, 0.22, 2.0, (2.5, 3.2)),
    Robot("car", 0.6, 0.3, 0.5, 1.2, (1.5, 3.0)),
)


def _dwa(robot: Robot) -> tuple[str, Any, Any]:
    v, w = robot.fastest_m_s, robot.fastest_rad_s
    a, b = robot.acceleration
    options = DwaOptions(
        max_vel_x=v, min_vel_x=-v / 4, max_vel_y=0.0, min_vel_y=0.0, max_vel_trans=v,
        min_vel_trans=v / 5, max_vel_theta=w, min_vel_theta=w / 4, acc_lim_x=a, acc_lim_y=0.0,
        acc_lim_theta=b, xy_goal_tolerance=0.15, yaw_goal_tolerance=0.3, sim_time=1.5,
        vx_samples=12, vy_samples=1, vth_samples=30, path_distance_bias=32.0,
        goal_distance_bias=20.0, occdist_scale=0.02, latch_xy_goal_tolerance=True,
    )  # fmt: skip
    return "dwa_local_planner/DWAPlannerROS", options, {}


def _rollout(robot: Robot) -> tuple[str, Any, Any]:
    v, w = robot.fastest_m_s, robot.fastest_rad_s
    a, b = robot.acceleration
    # As in jackal_navigation's base_local_planner_params.yaml.
    options = TrajectoryPlannerOptions(
        max_vel_x=v, min_vel_x=v / 5, max_vel_theta=w, min_vel_theta=-w,
        min_in_place_vel_theta=0.314, acc_lim_x=a, acc_lim_theta=b, holonomic_robot=False,
        escape_vel=-0.1, xy_goal_tolerance=0.25, yaw_goal_tolerance=0.3, sim_time=2.0,
        sim_granularity=0.02, angular_sim_granularity=0.02, vx_samples=6, vtheta_samples=20,
        meter_scoring=True, path_distance_bias=0.75, goal_distance_bias=1.0, occdist_scale=0.1,
        heading_lookahead=0.325, latch_xy_goal_tolerance=True,
    )  # fmt: skip
    return "base_local_planner/TrajectoryPlannerROS", options, {}


def _dwb(robot: Robot) -> tuple[str, Any, Any]:
    v, w = robot.fastest_m_s, robot.fastest_rad_s
    a, b = robot.acceleration
    options = DwbOptions(
        max_vel_x=v, max_vel_theta=w, max_speed_xy=v, acc_lim_x=a, acc_lim_theta=b, decel_lim_x=-a,
        decel_lim_theta=-b, linear_granularity=0.05, critics=(
            "RotateToGoal", "Oscillation", "ObstacleFootprint", "GoalAlign", "PathAlign",
            "PathDist", "GoalDist",
        ),
    )  # fmt: skip
    critics = {
        "ObstacleFootprint": {"scale": 0.02},
        "PathAlign": {"scale": 32.0, "forward_point_distance": 0.1},
        "GoalAlign": {"scale": 24.0, "forward_point_distance": 0.1},
        "PathDist": {"scale": 32.0},
        "GoalDist": {"scale": 24.0},
    }
    return "dwb_core::DWBLocalPlanner", options, critics


def _mppi(robot: Robot) -> tuple[str, Any, Any]:
    v, w = robot.fastest_m_s, robot.fastest_rad_s
    options = MppiOptions(vx_max=v, vx_min=-v / 3, wz_max=w, batch_size=1000)
    return (
        "nav2_mppi_controller::MPPIController",
        options,
        {"CostCritic": {"consider_footprint": True}},
    )


def _pursuit(robot: Robot) -> tuple[str, Any, Any]:
    options = PursuitOptions(
        desired_linear_vel=robot.fastest_m_s, rotate_to_heading_angular_vel=1.0,
        regulated_linear_scaling_min_speed=0.1, lookahead_dist=0.4, min_lookahead_dist=0.3,
    )  # fmt: skip
    name = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
    return name, options, {}


DRIVERS: dict[str, Callable[[Robot], tuple[str, Any, Any]]] = {
    "trajectory_planner": _rollout,
    "dwa": _dwa,
    "dwb": _dwb,
    "mppi": _mppi,
    "pursuit": _pursuit,
}


class Field:
    """What lies in the way: boxes, as centre and half sizes.

    Attributes:
        boxes: (n, 4): x, y, half width along x and y, m.
    """

    def __init__(self, seed: int, robot: Robot) -> None:
        """Make up fields until one has a way of the wanted width."""
        rng = np.random.default_rng((seed, 31))
        # An outline that is longer than wide needs room where it has to turn.
        reach_m = math.hypot(robot.length_m, robot.width_m)
        while True:
            self.boxes = _boxes(rng, robot, reach_m)
            if self._has_way(_GAP * robot.width_m) and not self._has_way(
                _MAX_WIDTH * robot.width_m
            ):
                return

    def grid(self, cell_m: float) -> CostGrid:
        """Return it in cells: lethal where something lies."""
        width, height = round(_LENGTH_M / cell_m), round(_WIDTH_M / cell_m)
        costs = np.zeros((height, width), np.uint8)
        costs[[0, -1]] = costs[:, [0, -1]] = LETHAL
        for x, y, a, b in self.boxes:
            u, v = (np.arange(width) + 0.5) * cell_m, (np.arange(height) + 0.5) * cell_m
            # As what a laser sees: each cell that something is in.
            costs[np.ix_(abs(v - y) < b + cell_m / 2, abs(u - x) < a + cell_m / 2)] = LETHAL
        return CostGrid(costs, cell_m)

    def _has_way(self, width_m: float) -> bool:
        """Tell whether a disc of this width gets through."""
        grid = self.grid(_CELL_M)
        options = InflationOptions(inflation_radius=width_m / 2, cost_scaling_factor=3.0)
        wide = inflated(grid, options, Footprint.of_radius(width_m / 2))
        return isinstance(make_plan(wide, _START, _GOAL, NavfnOptions()), Plan)


def _boxes(rng: np.random.Generator, robot: Robot, reach_m: float) -> NDArray[np.float64]:
    boxes = []
    for line in (1.9, 3.0, 4.1):
        gap_m = rng.uniform(_GAP, _MAX_WIDTH) * robot.width_m
        y = rng.uniform(1.2, _WIDTH_M - 1.2)
        x = line + rng.uniform(-0.15, 0.15)
        below, above = y - gap_m / 2, _WIDTH_M - y - gap_m / 2
        boxes.append((x, below / 2, 0.05, below / 2))
        boxes.append((x, _WIDTH_M - above / 2, 0.05, above / 2))
    walls = list(boxes)
    for _ in range(60):
        post = (*rng.uniform((1.0, 0.5), (_LENGTH_M - 1.0, _WIDTH_M - 0.5)), 0.06, 0.06)
        away = [max(abs(post[0] - x) - a, abs(post[1] - y) - b) for x, y, a, b in boxes]
        ends_m = min(math.dist(post[:2], end[:2]) for end in (_START, _GOAL))
        is_away = min(away) > 0.06 + 1.15 * reach_m and ends_m > 0.15 + reach_m
        if is_away and len(boxes) < len(walls) + 8:
            boxes.append(post)
    return np.array(boxes)


class Run:
    """One robot on its way; what the executive has done."""

    recovery_count = 2

    def __init__(self, field: Field, robot: Robot, controller: Controller) -> None:
        self.robot, self.controller = robot, controller
        self.pose, self.velocity = list(_START), [0.0, 0.0]
        self.wanted = (0.0, 0.0)
        self.time_s, self.contacts, self.recoveries = 0.0, 0, 0
        self.track: list[tuple[float, float, float]] = []
        self._fine = field.grid(_FINE_M)
        options = InflationOptions(inflation_radius=0.5, cost_scaling_factor=5.0)
        self._padded = robot.footprint.padded(0.005)
        self._grid = inflated(field.grid(_CELL_M), options, self._padded)
        self.executive = MoveBaseStateMachine(self, Timing(planner_frequency_hz=1.0))
        self._plan: Any = None

    def drive(self) -> str:
        """Return how it ended."""
        self.executive.begin()
        next_plan_s = 0.0
        while self.time_s < _MAX_S:
            if self.executive.wants_plan and self.time_s >= next_plan_s:
                next_plan_s = self.time_s + 1.0
                x, y, yaw = self.pose
                plan = make_plan(self._grid, (x, y, yaw), _GOAL, NavfnOptions())
                rows = plan.poses if isinstance(plan, Plan) else ()
                poses = [PlanPose(*map(float, row)) for row in rows]
                self.executive.planned(poses or None, "" if poses else "no plan")
            end = self.executive.cycle(PlanPose(*self.pose))
            if end is not None:
                return "crossed" if end.outcome is Outcome.SUCCEEDED else end.text
            self._move()
        return "still about it"

    def _move(self) -> None:
        step_s = _PERIOD_S / _STEPS
        for _ in range(_STEPS):
            for axis in (0, 1):
                most = self.robot.acceleration[axis] * step_s
                change = self.wanted[axis] - self.velocity[axis]
                self.velocity[axis] += min(max(change, -most), most)
            self.pose[0] += self.velocity[0] * math.cos(self.pose[2]) * step_s
            self.pose[1] += self.velocity[0] * math.sin(self.pose[2]) * step_s
            self.pose[2] += self.velocity[1] * step_s
        self.time_s += _PERIOD_S
        x, y, yaw = self.pose
        self.track.append((x, y, yaw))
        self.contacts += footprint_cost(self._fine, self.robot.footprint, (x, y, yaw)) == -1

    @property
    def _state(self) -> RobotState:
        x, y, yaw = self.pose
        return RobotState((x, y, yaw), (self.velocity[0], 0.0, self.velocity[1]))

    def _window(self) -> CostGrid:
        column, row = self._grid.world_to_cell(self.pose[0], self.pose[1])
        half = round(_WINDOW_M / _CELL_M / 2)
        x0, y0 = max(column - half, 0), max(row - half, 0)
        part = np.ascontiguousarray(self._grid.costs[y0 : row + half, x0 : column + half])
        return CostGrid(part, _CELL_M, (x0 * _CELL_M, y0 * _CELL_M))

    def is_current(self) -> bool:
        return True

    def set_plan(self, plan: Any) -> bool:
        self.controller.set_plan(np.array(plan))
        return True

    def is_goal_reached(self) -> bool:
        return self.controller.goal_reached(self._state)

    def control(self) -> str:
        found = self.controller.compute(self._state, self._window(), self._padded)
        if not isinstance(found, Command):
            return found.reason
        self.wanted = (found.velocity[0], found.velocity[2])
        return ""

    def stop(self) -> None:
        self.wanted = (0.0, 0.0)

    def recover(self, index: int, trigger: Trigger) -> None:
        """Turn around on the spot, as far as that is free."""
        self.recoveries += 1
        turned = 0.0
        while turned < math.tau:
            x, y, yaw = self.pose
            ahead = [(x, y, yaw + k * 0.02) for k in range(12)]
            if any(footprint_cost(self._grid, self._padded, one) < 0 for one in ahead):
                break
            self.wanted = (0.0, 0.6)
            self._move()
            turned += self.pose[2] - yaw
        self.stop()
        while any(self.velocity):
            self._move()

    def log(self, level: str, text: str) -> None:
        pass

    def now_ns(self) -> int:
        return int(self.time_s * 1e9)


def controller_for(name: str, robot: Robot) -> Controller:
    """Return a controller with the robot's limits."""
    kind, options, critics = DRIVERS[name](robot)
    given = ("pdist_scale",) if name == "trajectory_planner" else ()
    setting = ControllerSetting(_PERIOD_S, critics, (0.25, 0.3), given=given)
    return CONTROLLERS[kind].make(options, setting)


def cross(seed: int, name: str) -> tuple[str, Run]:
    """Let a controller drive through a field; return how it ended."""
    robot = ROBOTS[seed % len(ROBOTS)]
    run = Run(Field(seed, robot), robot, controller_for(name, robot))
    return run.drive(), run
