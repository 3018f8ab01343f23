"""Controllers that try velocities and take the best."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.controller import Command, NoCommand, RobotState, Velocity
from gazelle.navigation.controllers.dwa_dwb_parameters import Profile
from gazelle.navigation.controllers.followed_plan import FollowedPlan
from gazelle.navigation.controllers.rollout_arguments import (
    Distances,
    Growth,
    SampleTerms,
    SampleWeights,
    Timing,
)
from gazelle.navigation.controllers.stop_rotate import Arrival
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.costmap.footprint import Footprint

__all__ = ["Oscillation", "SamplingController", "grid_of_samples", "samples_between"]


def samples_between(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return evenly spaced velocities, (n,), with 0 among them where it lies between.

    This is ``VelocityIterator`` of base_local_planner.
    """
    if low >= high:
        return np.array([low])
    values = np.linspace(low, high, max(count, 2))
    if low < 0 < high:
        values = np.union1d(values, [0.0])
    return values


def grid_of_samples(
    low: NDArray[np.float64], high: NDArray[np.float64], counts: tuple[int, int, int]
) -> NDArray[np.float64]:
    """Return all combinations of x, y and turning velocities, (n, 3), x slowest."""
    axes = [samples_between(float(low[k]), float(high[k]), counts[k]) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


Pose = tuple[float, float, float]

_AXES = range(3)


@dataclass
class Oscillation:
    """Remembers which way the robot went along x, along y and around z.

    A direction that was reversed is kept until the robot has moved away from where that happened.

    Attributes:
        reset_m: how far that is.
        reset_rad: or how far the robot has to turn.
    """

    reset_m: float
    reset_rad: float
    _direction: list[int] = field(default_factory=lambda: [0, 0, 0])
    _only: list[int] = field(default_factory=lambda: [0, 0, 0])
    _place: Pose = (0.0, 0.0, 0.0)

    def reset(self) -> None:
        """Allow every direction again."""
        self._direction, self._only = [0, 0, 0], [0, 0, 0]

    def allowed(self, samples: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which velocities do not go back on a reversal, shape (n,)."""
        only = np.array(self._only)
        return np.asarray(((samples * only >= 0) | (only == 0)).all(axis=1))

    def remember(self, pose: Pose, velocity: tuple[float, float, float], slow_m_s: float) -> None:
        """Take in what is driven now; turning and strafing count at low speed only."""
        reversed_now = False
        for axis in _AXES:
            if axis > 0 and abs(velocity[0]) > slow_m_s:
                break
            sign = int(np.sign(velocity[axis]))
            if sign and self._direction[axis] == -sign:
                self._only[axis] = sign
                reversed_now = True
            if sign:
                self._direction[axis] = sign
        if reversed_now:
            self._place = pose
        away = math.hypot(pose[0] - self._place[0], pose[1] - self._place[1])
        turned = abs(math.remainder(pose[2] - self._place[2], math.tau))
        if any(self._only) and (away > self.reset_m or turned > self.reset_rad):
            self.reset()


_Fields = tuple[Distances, NDArray[np.float32]]

_REFUSALS = {
    -3.0: "lead where no way leads to the goal",
    -4.0: "leave the local costmap",
    -5.0: "would go back on a reversal",
    -6.0: "hit an obstacle",
    -7.0: "leave the local costmap",
    -10.0: "do not move",
}


class SamplingController:
    """Scores trajectories of sampled velocities; DWA and DWB by its profile."""

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
        p = profile
        self._arrival = Arrival(
            p.tolerance_m, p.tolerance_rad, p.stopped_m_s, p.stopped_rad_s, p.latches,
            p.deceleration, p.acceleration[2], max(p.slowest_rad_s, 0.0), p.high[2], period_s,
        )  # fmt: skip

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path (n, 3); see `Controller`."""
        held = FollowedPlan(plan, before=self._plan if has_moved else None)
        if self._plan is None or (self._plan.goal != held.goal and not has_moved):
            self._arrival.reset()
        self._plan = held
        if not has_moved:
            self._oscillation.reset()

    def reset(self) -> None:
        """Forget the path and what was driven."""
        self._plan = None
        self._arrival.reset()
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
        return self._plan is not None and self._arrival.is_reached(state, self._plan.goal)

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._plan is None:
            return NoCommand("there is no path to follow")
        p = self._profile
        local = self._plan.local(state.pose, grid, p.behind_m, p.ahead_m)
        fields = self._fields(state, grid, local)
        if self._arrival.is_in_place(state, self._plan.goal):
            return self._stop_and_turn(state, grid, footprint, fields)
        self._arrival.leave()
        return self._best(state, grid, footprint, fields)

    def _best(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: _Fields,
    ) -> Command | NoCommand:
        samples = self._samples(state)
        scores = self._scores(samples, state, grid, footprint, fields)
        if not self._profile.oscillates:
            scores = np.where((scores >= 0) & ~self._oscillation.allowed(samples), -5.0, scores)
        legal = np.nonzero(scores >= 0)[0]
        if not len(legal):
            return self._refusal(scores)
        best = int(legal[scores[legal].argmin()])
        return self._command(state, samples[best], float(scores[best]))

    def _command(self, state: RobotState, sample: NDArray[np.float64], cost: float) -> Command:
        velocity = (float(sample[0]), float(sample[1]), float(sample[2]))
        self._oscillation.remember(state.pose, velocity, max(self._profile.slow_m_s, 0.0))
        return Command(velocity, self._trajectory(state, sample), cost)

    def _refusal(self, scores: NDArray[np.float64]) -> NoCommand:
        """Tell why nothing is left."""
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
        speed = np.hypot(samples[:, 0], samples[:, 1])
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
        fields: _Fields,
    ) -> NDArray[np.float64]:
        from gazelle.navigation.controllers.dwa_dwb_kernels import score_samples

        p = self._profile
        unit = p.per_resolution * grid.resolution_m
        weights = (p.path * unit, p.goal * unit, p.nose_goal * unit, p.nose_path * unit)
        terms = SampleTerms(
            np.array(p.acceleration),
            SampleWeights(*map(float, (*weights, p.obstacles, p.turning))),
            Timing(float(p.sim_time_s), float(p.step_m), float(p.step_rad)),
            Growth(float(p.growth_from_m_s), float(p.fastest_m_s), float(p.growth)),
            float(p.nose_m),
            is_outlined=bool(p.outlined),
            accelerates=not p.holds,
            sums=bool(p.sums),
            is_aligned=self._aligns(state),
        )
        distances, front = fields
        scores = score_samples(
            grid.cells, distances, front, footprint.points, state.planar, samples, terms
        )
        back = (samples[:, 0] < 0) & (scores >= 0)
        return np.asarray(np.where(back, scores + p.backwards, scores))

    def _aligns(self, state: RobotState) -> bool:
        assert self._plan is not None
        goal = self._plan.goal
        away = (goal[0] - state.pose[0]) ** 2 + (goal[1] - state.pose[1]) ** 2
        return bool(away > self._profile.free_nose_m2)

    def _fields(self, state: RobotState, grid: CostGrid, local: NDArray[np.float64]) -> _Fields:
        """Return distances to the path, to its end in the window, and to that of the nose."""
        from gazelle.navigation.controllers.dwa_dwb_kernels import distance_field

        end = local[-1, :2]
        bearing = math.atan2(end[1] - state.pose[1], end[0] - state.pose[0])
        ahead = end + self._profile.nose_m * np.array([math.cos(bearing), math.sin(bearing)])
        targets = grid.cells_of(local[:, :2])
        front = np.vstack([targets, grid.cells_of(np.linspace(end, ahead, 20))])
        path = distance_field(grid.costs, targets, False)
        goal = distance_field(grid.costs, targets, True)
        return Distances(path, goal), distance_field(grid.costs, front, True)

    def _stop_and_turn(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        fields: _Fields,
    ) -> Command | NoCommand:
        assert self._plan is not None

        def hits(velocity: Velocity) -> bool:
            score = self._scores(np.array([velocity]), state, grid, footprint, fields)[0]
            return bool(score in (-6.0, -7.0))

        velocity = self._arrival.velocity(state, self._plan.goal, hits)
        if isinstance(velocity, NoCommand):
            return velocity
        return Command(velocity, self._trajectory(state, np.array(velocity)))

    def _trajectory(self, state: RobotState, sample: NDArray[np.float64]) -> NDArray[np.float64]:
        from gazelle.navigation.controllers.dwa_dwb_kernels import simulate

        p, steps = self._profile, 20
        out = np.empty((steps, 3))
        limits, pace = np.array(p.acceleration), p.sim_time_s / steps
        simulate(state.planar, sample, limits, steps, pace, not p.holds, out)
        return out
