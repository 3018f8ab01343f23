"""Controllers that try velocities and take the best."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.following import FollowedPlan, angle_between
from gazelle.navigation.controllers.oscillation import Oscillation
from gazelle.navigation.controllers.profile import Profile
from gazelle.navigation.controllers.samples import grid_of_samples
from gazelle.navigation.controllers.state import Command, NoCommand, RobotState, Velocity
from gazelle.navigation.costmap.footprint import Footprint
from gazelle.navigation.costmap.grid import CostGrid

__all__ = ["SamplingController"]

_REFUSALS = {
    -3.0: "lead where no way leads to the goal",
    -4.0: "leave the local costmap",
    -5.0: "would go back on a reversal",
    -6.0: "hit an obstacle",
    -7.0: "leave the local costmap",
    -10.0: "do not move",
}


class SamplingController:
    """Scores trajectories of sampled velocities; DWA, DWB and TrajectoryPlanner by its profile."""

    def __init__(self, profile: Profile, period_s: float) -> None:
        """Begin without a path.

        Args:
            profile: limits, samples and weights.
            period_s: between two velocity commands.
        """
        self._given = self._profile = profile
        self._period_s = period_s
        self._plan: FollowedPlan | None = None
        self._oscillation = Oscillation(profile.reset_m, profile.reset_rad)
        self._latched = False
        self._turning = False

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path; see `Controller`."""
        held = FollowedPlan(plan, before=self._plan if has_moved else None)
        if self._plan is None or (self._plan.goal != held.goal and not has_moved):
            self._latched = self._turning = False
        self._plan = held
        if not has_moved:
            self._oscillation.reset()

    def reset(self) -> None:
        """Forget the path and what was driven."""
        self._plan = None
        self._latched = self._turning = False
        self._oscillation.reset()

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this."""
        given = self._given
        if m_s is None:
            self._profile = given
            return
        fastest = m_s if given.fastest_m_s < 0 else min(m_s, given.fastest_m_s)
        high = (min(given.high[0], m_s), min(given.high[1], m_s), given.high[2])
        low = (max(given.low[0], -m_s), max(given.low[1], -m_s), given.low[2])
        slowest = min(given.slowest_m_s, m_s)
        self._profile = replace(given, fastest_m_s=fastest, high=high, low=low, slowest_m_s=slowest)

    def goal_reached(self, state: RobotState) -> bool:
        """Tell whether the robot stands in the goal, looking the right way."""
        if self._plan is None or not self._in_place(state):
            return False
        turn = angle_between(state.pose[2], self._plan.goal[2])
        return bool(abs(turn) <= self._profile.tolerance_rad and self._stands(state))

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._plan is None:
            return NoCommand("there is no path to follow")
        p = self._profile
        local = self._plan.local(state.pose, grid, p.behind_m, p.ahead_m)
        fields = self._fields(state, grid, local)
        if self._in_place(state):
            return self._stop_and_turn(state, grid, footprint, fields)
        self._turning = False
        return self._best(state, grid, footprint, fields)

    def _best(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: tuple[NDArray[np.float32], ...],
    ) -> Command | NoCommand:
        samples = self._samples(state)
        scores = self._scores(samples, state, grid, footprint, fields)
        if not self._profile.oscillates:
            scores = np.where((scores >= 0) & ~self._oscillation.allowed(samples), -5.0, scores)
        legal = np.nonzero(scores >= 0)[0]
        if not len(legal):
            return self._escape(state, grid, footprint, fields, scores)
        best = int(legal[scores[legal].argmin()])
        return self._command(state, samples[best], float(scores[best]))

    def _command(self, state: RobotState, sample: NDArray[np.float64], cost: float) -> Command:
        velocity = (float(sample[0]), float(sample[1]), float(sample[2]))
        self._oscillation.remember(state.pose, velocity, max(self._profile.slow_m_s, 0.0))
        return Command(velocity, self._trajectory(state, sample), cost)

    def _escape(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: tuple[NDArray[np.float32], ...],
        scores: NDArray[np.float64],
    ) -> Command | NoCommand:
        """Back up where the options say so, else tell why nothing is left."""
        if self._profile.escape_m_s < 0:
            sample = np.array([[self._profile.escape_m_s, 0.0, 0.0]])
            if self._scores(sample, state, grid, footprint, fields)[0] >= 0:
                return self._command(state, sample[0], 0.0)
        counts = {
            text: int(sum((scores == code).sum() for code, own in _REFUSALS.items() if own == text))
            for text in dict.fromkeys(_REFUSALS.values())
        }
        parts = [f"{count} {text}" for text, count in counts.items() if count]
        return NoCommand(
            f"{self._profile.name} failed to produce path: of {len(scores)} velocities "
            + ", ".join(parts)
        )

    def _samples(self, state: RobotState) -> NDArray[np.float64]:
        p = self._profile
        now = np.array(state.velocity)
        span_s = self._period_s if p.holds else p.sim_time_s
        low = np.maximum(p.low, now - np.array(p.deceleration) * span_s)
        high = np.minimum(p.high, now + np.array(p.acceleration) * span_s)
        if not p.holds and p.arrives and self._plan is not None:
            goal = self._plan.goal
            left = math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1]) / p.sim_time_s
            high[:2] = np.maximum(np.minimum(high[:2], left), low[:2])
        samples = grid_of_samples(low, np.maximum(high, low), p.counts)
        if p.side_m_s:
            side = np.array([[0.0, y, 0.0] for y in p.side_m_s])
            samples = np.vstack([samples, side])
        speed = np.hypot(samples[:, 0], samples[:, 1])
        # Turns on the spot are made fast enough to happen, as base_local_planner does.
        spot = (speed < 1e-4) & (np.abs(samples[:, 2]) > 1e-4)
        least = np.maximum(np.abs(samples[:, 2]), p.slowest_in_place_rad_s)
        samples[:, 2] = np.where(spot, np.copysign(least, samples[:, 2]), samples[:, 2])
        turn = np.abs(samples[:, 2])
        slow = (p.slowest_m_s >= 0) & (speed + 1e-4 < p.slowest_m_s)
        slow &= (p.slowest_rad_s >= 0) & (turn + 1e-4 < p.slowest_rad_s)
        fast = (p.fastest_m_s >= 0) & (speed - 1e-4 > p.fastest_m_s)
        kept = samples[~(slow | fast)]
        return kept if len(kept) else samples[:1]

    def _scores(
        self,
        samples: NDArray[np.float64],
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: tuple[NDArray[np.float32], ...],
    ) -> NDArray[np.float64]:
        from gazelle.navigation.controllers.kernels import score_samples

        p = self._profile
        unit = p.per_resolution * grid.resolution_m if p.per_resolution else 1.0
        distances = np.array([p.path, p.goal, p.nose_goal, p.nose_path]) * unit
        scores = score_samples(
            grid.costs, float(grid.origin[0]), float(grid.origin[1]), 1.0 / grid.resolution_m,
            *fields, footprint.points, p.outlined, np.array((*state.pose, *state.velocity)),
            samples, np.array(p.acceleration), np.append(distances, [p.obstacles, p.turning]),
            p.nose_m, np.array([p.sim_time_s, p.step_m, p.step_rad]), not p.holds,
            np.array([p.growth_from_m_s, p.fastest_m_s, p.growth]), p.sums, self._aligns(state),
        )  # fmt: skip
        back = (samples[:, 0] < 0) & (scores >= 0)
        return np.asarray(np.where(back, scores + p.backwards, scores))

    def _aligns(self, state: RobotState) -> bool:
        assert self._plan is not None
        goal = self._plan.goal
        away = (goal[0] - state.pose[0]) ** 2 + (goal[1] - state.pose[1]) ** 2
        return away > self._profile.free_nose_m2

    def _fields(
        self, state: RobotState, grid: CostGrid, local: NDArray[np.float64]
    ) -> tuple[NDArray[np.float32], ...]:
        """Return distances to the path, to its end in the window, and to that of the nose."""
        from gazelle.navigation.controllers.kernels import distance_field

        end = local[-1, :2]
        bearing = math.atan2(end[1] - state.pose[1], end[0] - state.pose[0])
        ahead = end + self._profile.nose_m * np.array([math.cos(bearing), math.sin(bearing)])
        targets = _cells(grid, local[:, :2])
        front = np.vstack([targets, _cells(grid, np.linspace(end, ahead, 20))])
        path = distance_field(grid.costs, targets, False)
        goal = distance_field(grid.costs, targets, True)
        return path, goal, distance_field(grid.costs, front, True)

    def _in_place(self, state: RobotState) -> bool:
        """Tell whether the robot's place is the goal's."""
        assert self._plan is not None
        goal, p = self._plan.goal, self._profile
        near = math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1]) <= p.tolerance_m
        self._latched = p.latches and (near or self._latched)
        return bool(near or self._latched)

    def _stands(self, state: RobotState) -> bool:
        p = self._profile
        speed = math.hypot(state.velocity[0], state.velocity[1])
        return speed <= p.stopped_m_s and abs(state.velocity[2]) <= p.stopped_rad_s

    def _stop_and_turn(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: tuple[NDArray[np.float32], ...],
    ) -> Command | NoCommand:
        """Stand still, then turn into the goal's direction, as LatchedStopRotateController."""
        assert self._plan is not None
        turn = angle_between(state.pose[2], self._plan.goal[2])
        if abs(turn) <= self._profile.tolerance_rad:
            self._turning = False
            return Command((0.0, 0.0, 0.0), np.array([state.pose]))
        if not self._turning and not self._stands(state):
            velocity, what = self._slower(state), "Stopping cmd in collision"
        else:
            self._turning = True
            velocity, what = (0.0, 0.0, self._turn(state, turn)), "Rotation cmd in collision"
        sample = np.array([velocity])
        score = self._scores(sample, state, grid, footprint, fields)[0]
        # A velocity of 0 has no trajectory and hits nothing.
        if score < 0 and any(velocity) and score in (-6.0, -7.0):
            return NoCommand(what)
        return Command(velocity, self._trajectory(state, sample[0]))

    def _slower(self, state: RobotState) -> Velocity:
        p = self._profile
        values = [
            math.copysign(max(0.0, abs(v) - p.deceleration[k] * self._period_s), v)
            for k, v in enumerate(state.velocity)
        ]
        return values[0], values[1], values[2]

    def _turn(self, state: RobotState, turn: float) -> float:
        """Return the turning velocity towards a direction, slow enough to stop there."""
        p = self._profile
        limit, fastest = p.acceleration[2], p.high[2]
        now = abs(state.velocity[2])
        slowest = max(p.slowest_rad_s, 0.0)
        speed = min(fastest, max(slowest, abs(turn)))
        speed = min(max(speed, now - limit * self._period_s), now + limit * self._period_s)
        speed = min(speed, math.sqrt(2 * limit * abs(turn)))
        return math.copysign(min(fastest, max(slowest, speed)), turn)

    def _trajectory(self, state: RobotState, sample: NDArray[np.float64]) -> NDArray[np.float64]:
        from gazelle.navigation.controllers.kernels import simulate

        p, steps = self._profile, 20
        out = np.empty((steps, 3))
        limits, pace = np.array(p.acceleration), p.sim_time_s / steps
        simulate(*state.pose, *state.velocity, sample, limits, steps, pace, not p.holds, out)
        return out


def _cells(grid: CostGrid, points: NDArray[np.float64]) -> NDArray[np.int64]:
    cells = np.floor((points - np.array(grid.origin)) / grid.resolution_m)
    return np.asarray(cells, np.int64)
