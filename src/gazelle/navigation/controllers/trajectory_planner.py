"""The controller of ROS 1's older local planner: trajectory rollout."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.controller import Command, NoCommand, RobotState, Velocity
from gazelle.navigation.controllers.dwa_dwb_parameters import TrajectoryPlannerOptions
from gazelle.navigation.controllers.followed_plan import FollowedPlan, angle_between
from gazelle.navigation.controllers.rollout_arguments import Distances, RolloutTerms, Timing
from gazelle.navigation.controllers.stop_rotate import Arrival
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.costmap.footprint import Footprint, footprint_cost

__all__ = ["TrajectoryPlanner"]

Pose = tuple[float, float, float]
_PASSED_M = 1.0
_SHOWN_POSES = 20
# Of robots that can drive sideways, besides going straight.
_SLANTING: tuple[Velocity, ...] = ((0.1, 0.1, 0.0), (0.1, -0.1, 0.0))


class TrajectoryPlanner:
    """Rolls out velocities and takes the cheapest, as ``TrajectoryPlannerROS``.

    Where nothing is left it backs up, even where the costmap says that this cannot be, but not
    into an obstacle that the robot does not touch yet: the original does.
    """

    def __init__(
        self, options: TrajectoryPlannerOptions, period_s: float, *, scales_obstacles: bool = True
    ) -> None:
        """Begin without a path.

        Args:
            options: of the planner.
            period_s: between two velocity commands.
            scales_obstacles: with ``meter_scoring`` all weights are multiplied by the resolution,
                as up to ROS Lunar; else all but ``occdist_scale``, as since Melodic.
        """
        o = self._options = options
        self._period_s = period_s
        self._scales_obstacles = scales_obstacles
        self._fastest_m_s = o.max_vel_x
        self._strafes = tuple(float(text) for one in o.y_vels for text in one.split(","))
        self._acceleration = np.array([o.acc_lim_x, o.acc_lim_y, o.acc_lim_theta])
        self._plan: FollowedPlan | None = None
        self._stuck = _Stuck(o.oscillation_reset_dist)
        self._escaping_from: Pose | None = None
        self._arrival = Arrival(
            o.xy_goal_tolerance, o.yaw_goal_tolerance, o.trans_stopped_velocity,
            o.rot_stopped_velocity, o.latch_xy_goal_tolerance,
            (o.acc_lim_x, o.acc_lim_y, o.acc_lim_theta), o.acc_lim_theta, o.min_in_place_vel_theta,
            o.max_vel_theta, period_s,
        )  # fmt: skip

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path (n, 3); see `Controller`."""
        held = FollowedPlan(plan, before=self._plan if has_moved else None)
        if self._plan is None or (self._plan.goal != held.goal and not has_moved):
            self._arrival.reset()
        self._plan = held

    def reset(self) -> None:
        """Forget the path and what was driven."""
        self._plan = self._escaping_from = None
        self._arrival.reset()
        self._stuck.reset()

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this."""
        most = self._options.max_vel_x
        self._fastest_m_s = most if m_s is None else min(m_s, most)

    def goal_reached(self, state: RobotState) -> bool:
        """Tell whether the robot stands in the goal, looking the right way."""
        return self._plan is not None and self._arrival.is_reached(state, self._plan.goal)

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._plan is None:
            return NoCommand("there is no path to follow")
        behind_m = _PASSED_M if self._options.prune_plan else math.inf
        local = self._plan.local(state.pose, grid, behind_m)
        rollout = _Rollout(self._options, self._terms(grid), state, grid, footprint, local)
        goal = self._plan.goal
        if not self._arrival.is_in_place(state, goal):
            self._arrival.leave()
            return self._best(state, rollout, goal)
        velocity = self._arrival.velocity(
            state, goal, lambda one: bool(rollout.of([one])[0, 0] == rollout.hit)
        )
        return velocity if isinstance(velocity, NoCommand) else rollout.command(velocity)

    def _terms(self, grid: CostGrid) -> RolloutTerms:
        o = self._options
        unit = grid.resolution_m if o.meter_scoring else 1.0
        obstacles = unit if self._scales_obstacles else 1.0
        return RolloutTerms(
            self._acceleration,
            Timing(float(o.sim_time), float(o.sim_granularity), float(o.angular_sim_granularity)),
            path=float(o.path_distance_bias * unit),
            goal=float(o.goal_distance_bias * unit),
            obstacles=float(o.occdist_scale * obstacles),
            heading=0.3 if o.heading_scoring else 0.0,
            heading_s=float(o.heading_scoring_timestep) if o.heading_scoring else -1.0,
            attracts=bool(o.simple_attractor),
        )

    def _best(self, state: RobotState, rollout: _Rollout, goal: Pose) -> Command | NoCommand:
        self._end_escape(state.pose)
        low, high = self._window(state, goal)
        ahead = [] if self._escaping_from else self._ahead(low, high)
        best, cost = rollout.cheapest(ahead)
        best, cost = self._turned(rollout, low[1], high[1], best, cost)
        if best is None and self._options.holonomic_robot:
            best, cost = self._strafed(rollout)
        if best is not None:
            self._stuck.remember(state.pose, best)
            return rollout.command(best, cost)
        return self._back(state, rollout)

    def _window(
        self, state: RobotState, goal: Pose
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return lowest and highest velocities that are tried, m/s and rad/s."""
        o = self._options
        span_s = self._period_s if o.dwa else o.sim_time
        x, _, turn = state.velocity
        left_m = math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1])
        fastest = min(self._fastest_m_s, left_m / o.sim_time, x + o.acc_lim_x * span_s)
        low_x = max(o.min_vel_x, x - o.acc_lim_x * span_s)
        low_turn = max(o.min_vel_theta, turn - o.acc_lim_theta * span_s)
        high_turn = min(o.max_vel_theta, turn + o.acc_lim_theta * span_s)
        return (low_x, low_turn), (max(fastest, o.min_vel_x), high_turn)

    def _ahead(self, low: tuple[float, float], high: tuple[float, float]) -> list[Velocity]:
        o = self._options
        # The fastest turn to the left is left out, as in the original.
        turns = [0.0, *np.linspace(low[1], high[1], o.vtheta_samples)[:-1].tolist()]
        speeds = np.linspace(low[0], high[0], o.vx_samples).tolist()
        found = [(speed, 0.0, turn) for speed in speeds for turn in turns]
        return [*found, *_SLANTING] if o.holonomic_robot else found

    def _turned(
        self,
        rollout: _Rollout,
        low: float,
        high: float,
        best: Velocity | None,
        cost: float,
    ) -> tuple[Velocity | None, float]:
        """Return the turn on the spot that looks towards the goal, where none is better."""
        o = self._options
        step = (high - low) / (o.vtheta_samples - 1) if o.vtheta_samples > 1 else math.inf
        turns = np.linspace(low, high, o.vtheta_samples)
        turns = turns[np.abs(turns) > step]
        # Slower turns on the spot do not happen.
        samples = [
            (0.0, 0.0, math.copysign(max(abs(turn), o.min_in_place_vel_theta), turn))
            for turn in turns.tolist()
        ]
        nearest = math.inf
        for sample, (own, *end) in zip(samples, rollout.of(samples), strict=True):
            is_worse = best is not None and own > cost and not best[1]
            if own < 0 or is_worse or not self._stuck.allows(_way(sample)):
                continue
            ahead = rollout.goal_cells_ahead(end)
            if ahead < nearest:
                best, cost, nearest = sample, float(own), ahead
        return best, cost

    def _strafed(self, rollout: _Rollout) -> tuple[Velocity | None, float]:
        best, cost, nearest = None, math.inf, math.inf
        samples = [(0.0, y, 0.0) for y in self._strafes]
        for sample, (own, *end) in zip(samples, rollout.of(samples), strict=True):
            if own < 0 or own > cost or not self._stuck.allows(_way(sample)):
                continue
            ahead = rollout.goal_cells_ahead(end)
            if ahead < nearest:
                best, cost, nearest = sample, float(own), ahead
        return best, cost

    def _back(self, state: RobotState, rollout: _Rollout) -> Command | NoCommand:
        """Back up, and turn on the spot only until the robot is somewhere else."""
        back = (self._options.escape_vel, 0.0, 0.0)
        cost = rollout.of([back])[0, 0]
        if cost == rollout.hit and not rollout.touches:
            return NoCommand(
                "the rollout planner failed to find a valid plan: the footprint is in collision "
                "on all trajectories, and behind the robot is an obstacle"
            )
        if cost == rollout.no_way:
            return NoCommand(
                "the rollout planner failed to find a valid plan: all trajectories hit something "
                "or lead where no way leads to the goal"
            )
        if self._escaping_from is None:
            self._escaping_from = state.pose
        self._stuck.remember(state.pose, back)
        return rollout.command(back)

    def _end_escape(self, pose: Pose) -> None:
        begin, o = self._escaping_from, self._options
        if begin is not None:
            away = math.hypot(pose[0] - begin[0], pose[1] - begin[1])
            turned = abs(angle_between(begin[2], pose[2]))
            if away > o.escape_reset_dist or turned > o.escape_reset_theta:
                self._escaping_from = None


class _Rollout:
    """What trajectories from where a robot is cost.

    Attributes:
        hit, no_way: costs of those that are not allowed.
        touches: the robot's outline is in an obstacle where it is.
    """

    def __init__(
        self,
        options: TrajectoryPlannerOptions,
        terms: RolloutTerms,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        plan: NDArray[np.float64],
    ) -> None:
        """Measure how far all cells of a costmap are from the path and from its end."""
        from gazelle.navigation.controllers.dwa_dwb_kernels import distance_field
        from gazelle.navigation.controllers.trajectory_planner_kernels import HIT, NO_WAY
        from gazelle.navigation.costmap.costmap_kernels import fill_polygon

        self.hit, self.no_way = HIT, NO_WAY
        self._options, self._terms = options, terms
        self._state, self._grid, self._footprint = state, grid, footprint
        self._plan = np.ascontiguousarray(plan[:, :2])
        # What is under the robot does not stop it from going away.
        passable = grid.costs.copy()
        corners = (footprint.at(state.pose) - np.array(grid.origin)) / grid.resolution_m
        fill_polygon(passable, corners, np.uint8(0), np.array([1 << 30, 1 << 30, -1, -1]))
        targets = grid.cells_of(plan[:, :2])
        self._distances = Distances(
            distance_field(passable, targets, False), distance_field(passable, targets, True)
        )

    @property
    def touches(self) -> bool:
        return footprint_cost(self._grid, self._footprint, self._state.pose) < 0

    def of(self, samples: list[Velocity]) -> NDArray[np.float64]:
        """Return costs and ends, (n, 4): cost, x, y, yaw."""
        from gazelle.navigation.controllers.trajectory_planner_kernels import roll_out

        found = roll_out(
            self._grid.cells, self._distances, self._footprint.points, self._state.planar,
            np.array(samples, float).reshape(-1, 3), self._terms, self._plan,
        )  # fmt: skip
        return np.asarray(found)

    def cheapest(self, samples: list[Velocity]) -> tuple[Velocity | None, float]:
        """Return the first of the cheapest, None where none is allowed."""
        costs = self.of(samples)[:, 0]
        costs = np.where(costs < 0, math.inf, costs)
        if not len(costs) or costs.min() == math.inf:
            return None, math.inf
        best = int(costs.argmin())
        return samples[best], float(costs[best])

    def goal_cells_ahead(self, end: list[float]) -> float:
        """Return how far the goal is from what a pose looks at, infinite outside the costmap."""
        x, y, yaw = end
        ahead_m = self._options.heading_lookahead
        point = np.array([[x + ahead_m * math.cos(yaw), y + ahead_m * math.sin(yaw)]])
        u, v = self._grid.cells_of(point)[0]
        if not (0 <= u < self._grid.width and 0 <= v < self._grid.height):
            return math.inf
        return float(self._distances.goal[v, u])

    def command(self, velocity: Velocity, cost: float = 0.0) -> Command:
        """Return a command with its trajectory."""
        from gazelle.navigation.controllers.dwa_dwb_kernels import simulate

        out = np.empty((_SHOWN_POSES, 3))
        step_s = self._options.sim_time / _SHOWN_POSES
        simulate(
            self._state.planar, np.array(velocity), self._terms.acceleration, _SHOWN_POSES, step_s,
            True, out,
        )  # fmt: skip
        return Command(velocity, out, cost)


@dataclass
class _Stuck:
    """Which ways of moving without going ahead were tried since the robot got on.

    A turn or a strafe that is begun twice, with the other one between, is not begun again until the
    robot has moved by `reset_m`.
    """

    reset_m: float
    _begun: set[str] = field(default_factory=set)
    _refused: set[str] = field(default_factory=set)
    _place: tuple[float, float] = (0.0, 0.0)

    def allows(self, way: str) -> bool:
        """Tell whether ``left``, ``right``, ``strafe left`` or ``strafe right`` may be driven."""
        return way not in self._refused

    def remember(self, pose: Pose, velocity: Velocity) -> None:
        """Take in what is driven now."""
        if not velocity[0] > 0:
            way = _way(velocity)
            opposite = _OPPOSITE.get(way)
            if opposite is not None:
                if way in self._begun:
                    self._refused.add(opposite)
                self._begun.add(way)
            self._place = pose[0], pose[1]
        if math.hypot(pose[0] - self._place[0], pose[1] - self._place[1]) > self.reset_m:
            self.reset()

    def reset(self) -> None:
        """Allow everything again."""
        self._begun.clear()
        self._refused.clear()


_OPPOSITE = {"left": "right", "right": "left", "strafe left": "strafe right",
             "strafe right": "strafe left"}  # fmt: skip


def _way(velocity: Velocity) -> str:
    if velocity[2]:
        return "left" if velocity[2] > 0 else "right"
    if velocity[1]:
        return "strafe left" if velocity[1] > 0 else "strafe right"
    return ""
