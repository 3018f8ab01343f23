"""Model Predictive Path Integral control (Williams and others 2017), as in Nav2."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.following import FollowedPlan, angle_between
from gazelle.navigation.controllers.mppi_options import MppiOptions
from gazelle.navigation.controllers.rollout_arguments import (
    CRITIC_WEIGHTS,
    Limits,
    PlanarState,
    Variations,
    Way,
)
from gazelle.navigation.controllers.state import Command, NoCommand, RobotState
from gazelle.navigation.costmap.footprint import Footprint
from gazelle.navigation.costmap.grid import CostGrid

__all__ = ["MppiController"]

_SMOOTHER = np.array([-21.0, 14.0, 39.0, 54.0, 59.0, 54.0, 39.0, 14.0, -21.0]) / 231.0
"""Savitzky and Golay's filter of 9 points and second order."""


class MppiController:
    """Improves a sequence of velocities by what random variations of it lead to."""

    def __init__(
        self,
        options: MppiOptions,
        period_s: float,
        critics: Mapping[str, Mapping[str, Any]] | None = None,
        tolerance: tuple[float, float] = (0.25, 0.25),
        seed: int = 0,
    ) -> None:
        """Begin without a path.

        Args:
            options: parameters.
            period_s: between two velocity commands.
            critics: parameters of critics by name; what is missing has the default.
            tolerance: of the goal, m and rad; a goal checker's.
            seed: of the variations.
        """
        self._options = options
        self._period_s = period_s
        self._tolerance = tolerance
        self._random = np.random.default_rng(seed)
        self._noise: NDArray[np.float64] | None = None
        self._critics = _merged(options, critics or {})
        self._plan: FollowedPlan | None = None
        self._limit_m_s = math.inf
        self._last = (0.0, 0.0, 0.0)
        self._controls = np.zeros((options.time_steps, 3))

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path (n, 3); see `Controller`."""
        held = FollowedPlan(plan, before=self._plan if has_moved else None)
        if self._plan is None or (self._plan.goal != held.goal and not has_moved):
            self._controls[:] = 0.0
        self._plan = held

    def reset(self) -> None:
        """Forget the path and the last solution."""
        self._plan = None
        self._controls[:] = 0.0
        self._last = (0.0, 0.0, 0.0)

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this."""
        self._limit_m_s = math.inf if m_s is None else m_s

    def goal_reached(self, state: RobotState) -> bool:
        """Tell whether the robot stands in the goal."""
        if self._plan is None:
            return False
        goal = self._plan.goal
        away = math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1])
        turn = abs(angle_between(state.pose[2], goal[2]))
        return bool(away <= self._tolerance[0] and turn <= self._tolerance[1])

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._plan is None:
            return NoCommand("there is no path to follow")
        path = self._plan.local(state.pose, grid, 0.0, self._options.prune_distance)
        speeds = self._last if self._options.open_loop else state.velocity
        start = RobotState(state.pose, speeds).planar
        for attempt in range(self._options.retry_attempt_limit + 1):
            for _ in range(self._options.iteration_count):
                found = self._improve(start, path, grid, footprint, anew=attempt > 0)
            if found:
                return self._command(start)
            self._controls[:] = 0.0
        self._last = (0.0, 0.0, 0.0)
        return NoCommand(
            f"Optimizer fail to compute path: all {self._options.batch_size} trajectories collide"
        )

    def _improve(
        self,
        start: PlanarState,
        path: NDArray[np.float64],
        grid: CostGrid,
        footprint: Footprint,
        *,
        anew: bool,
    ) -> bool:
        """Take one round; tells whether any trajectory was free."""
        from gazelle.navigation.controllers.mppi_kernel import score_batch

        assert self._plan is not None
        o, noise = self._options, self._variations(anew)
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(path[:, :2], axis=0).T)))
        way = Way(np.ascontiguousarray(path[:, :2]), along, np.array(self._plan.goal))
        spread = np.array([o.vx_std, o.vy_std, o.wz_std])
        varied = Variations(self._controls, noise, spread, float(o.gamma))
        scores, free = score_batch(
            grid.cells, footprint.points, bool(self._critics["CostCritic"]["consider_footprint"]),
            start, way, varied, self._limits(), self._weights(len(path)),
        )  # fmt: skip
        if not free.any():
            return False
        shares = np.exp(-(scores - scores.min()) / o.temperature)
        shares /= shares.sum()
        self._controls += np.tensordot(shares, noise, (0, 0))
        limits = self._limits().rows
        np.clip(self._controls, limits[:, 0], limits[:, 1], out=self._controls)
        self._smooth()
        return True

    def _command(self, start: PlanarState) -> Command:
        from gazelle.navigation.controllers.mppi_kernel import roll_out

        poses, driven = np.empty_like(self._controls), np.empty_like(self._controls)
        roll_out(start, self._controls, self._limits(), poses, driven)
        # With equal periods the next solution begins with the second velocity of this one.
        shifts = self._period_s >= self._options.model_dt - 1e-9
        velocity = (float(driven[0, 0]), float(driven[0, 1]), float(driven[0, 2]))
        if shifts:
            count = max(round(self._period_s / self._options.model_dt), 1)
            first = min(count, len(driven)) - 1
            velocity = (float(driven[first, 0]), float(driven[first, 1]), float(driven[first, 2]))
            kept = self._controls[count:]
            tail = np.repeat(self._controls[-1:], len(self._controls) - len(kept), axis=0)
            self._controls = np.concatenate([kept, tail])
        self._last = velocity
        return Command(velocity, poses)

    def _variations(self, anew: bool) -> NDArray[np.float64]:
        o = self._options
        if self._noise is None or o.regenerate_noises or anew:
            shape = (o.batch_size, o.time_steps, 3)
            side = o.vy_std if o.motion_model == "Omni" else 0.0
            spread = np.array([o.vx_std, side, o.wz_std])
            self._noise = self._random.standard_normal(shape) * spread
        return self._noise

    def _limits(self) -> Limits:
        o, most = self._options, self._limit_m_s
        side = o.vy_max if o.motion_model == "Omni" else 0.0
        rows = np.array(
            [
                [max(o.vx_min, -most), min(o.vx_max, most), o.ax_min, o.ax_max],
                [-min(side, most), min(side, most), o.ay_min, o.ay_max],
                [-o.wz_max, o.wz_max, -o.az_max, o.az_max],
            ]
        )
        return Limits(rows, float(o.model_dt))

    def _smooth(self) -> None:
        half = len(_SMOOTHER) // 2
        before = np.repeat(self._controls[:1], half, axis=0)
        after = np.repeat(self._controls[-1:], half, axis=0)
        padded = np.concatenate([before, self._controls, after])
        for axis in range(3):
            self._controls[:, axis] = np.convolve(padded[:, axis], _SMOOTHER, "valid")

    def _weights(self, points: int) -> NDArray[np.void]:
        c = self._critics
        goal, yaw, follow = c["GoalCritic"], c["GoalAngleCritic"], c["PathFollowCritic"]
        align, angle = c["PathAlignCritic"], c["PathAngleCritic"]
        cost, forward, radius = c["CostCritic"], c["PreferForwardCritic"], c["ConstraintCritic"]
        # Near the end of the path there is nothing to keep to but its end.
        straight = align["cost_weight"] if points > align["offset_from_furthest"] else 0.0
        values = {
            "cost": cost["cost_weight"],
            "critical": cost["critical_cost"],
            "collision": cost["collision_cost"],
            "near_collision": cost["near_collision_cost"],
            "near_goal": cost["near_goal_distance"],
            "goal": goal["cost_weight"],
            "goal_within": goal["threshold_to_consider"],
            "yaw": yaw["cost_weight"],
            "yaw_within": yaw["threshold_to_consider"],
            "align": straight,
            "align_within": align["threshold_to_consider"],
            "align_offset": align["offset_from_furthest"],
            "follow": follow["cost_weight"],
            "follow_within": follow["threshold_to_consider"],
            "follow_offset": follow["offset_from_furthest"],
            "angle": angle["cost_weight"],
            "angle_within": angle["threshold_to_consider"],
            "angle_offset": angle["offset_from_furthest"],
            "angle_most": angle["max_angle_to_furthest"],
            "forward": forward["cost_weight"],
            "forward_within": forward["threshold_to_consider"],
            "twirl": c["TwirlingCritic"]["cost_weight"],
            "radius": radius["min_turning_r"] if self._options.motion_model == "Ackermann" else 0.0,
            "radius_weight": radius["cost_weight"],
        }
        row = tuple(values[name] for name in CRITIC_WEIGHTS.names or ())
        return np.array([row], CRITIC_WEIGHTS)


def _merged(
    options: MppiOptions, given: Mapping[str, Mapping[str, Any]]
) -> dict[str, dict[str, Any]]:
    """Return parameters of all critics; those that are not used weigh nothing."""
    held: dict[str, dict[str, Any]] = {}
    for name, defaults in MppiOptions.CRITICS.items():
        values = {**defaults, **given.get(name, {})}
        if name not in options.critics:
            values |= {key: 0.0 for key in values if key.endswith(("weight", "collision_cost"))}
        held[name] = values
    if "ObstaclesCritic" in options.critics and "CostCritic" not in options.critics:
        own = held["ObstaclesCritic"]
        held["CostCritic"] |= {
            "cost_weight": own["repulsion_weight"],
            "critical_cost": own["critical_weight"],
            "collision_cost": own["collision_cost"],
            "near_goal_distance": own["near_goal_distance"],
            "consider_footprint": own["consider_footprint"],
        }
    return held
