"""Model Predictive Path Integral control (Williams and others 2017), as in Nav2."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.controller import Command, NoCommand, RobotState
from gazelle.navigation.controllers.followed_plan import FollowedPlan, angle_between
from gazelle.navigation.controllers.rollout_arguments import (
    CRITIC_WEIGHTS,
    Limits,
    PlanarState,
    Variations,
    Way,
)
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.costmap.footprint import Footprint
from gazelle.parameters.dataclass_tables import flag, integer, number, text, texts

__all__ = ["MppiController", "MppiOptions"]


_CRITICS = (
    "ConstraintCritic", "CostCritic", "GoalCritic", "GoalAngleCritic", "PathAlignCritic",
    "PathFollowCritic", "PathAngleCritic", "PreferForwardCritic",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class MppiOptions:
    """``nav2_mppi_controller::MPPIController``. Parameters of critics are ``<critic>.<name>``."""

    model_dt: float = number(0.05, "time between points of a trajectory", "s", 1e-3)
    time_steps: int = integer(56, "points of a trajectory", 2, 1000)
    batch_size: int = integer(1000, "trajectories", 1, 100_000)
    iteration_count: int = integer(1, "rounds per command", 1, 100)
    temperature: float = number(0.3, "how much worse trajectories still count", "", 1e-6)
    gamma: float = number(0.015, "weight of keeping to the last solution", "", 0)
    motion_model: str = text("DiffDrive", "DiffDrive, Omni or Ackermann")
    vx_max: float = number(0.5, "highest velocity along x", "m/s")
    vx_min: float = number(-0.35, "lowest velocity along x", "m/s")
    vy_max: float = number(0.5, "highest velocity along y, Omni only", "m/s", 0)
    wz_max: float = number(1.9, "fastest turn", "rad/s", 0)
    ax_max: float = number(3.0, "acceleration", "m/s²", 0)
    ax_min: float = number(-3.0, "deceleration, negative", "m/s²", None, 0)
    ay_max: float = number(3.0, "acceleration along y", "m/s²", 0)
    ay_min: float = number(-3.0, "deceleration along y, negative", "m/s²", None, 0)
    az_max: float = number(3.5, "angular acceleration", "rad/s²", 0)
    vx_std: float = number(0.2, "spread of sampled velocities along x", "m/s", 1e-6)
    vy_std: float = number(0.2, "spread of sampled velocities along y", "m/s", 1e-6)
    wz_std: float = number(0.4, "spread of sampled turns", "rad/s", 1e-6)
    retry_attempt_limit: int = integer(1, "rounds more when every trajectory hits something", 0, 10)
    regenerate_noises: bool = flag(False, "new samples every time")
    open_loop: bool = flag(False, "begin with the last command, not with odometry")
    prune_distance: float = number(1.5, "how far ahead the path is looked at", "m", 0.1)
    critics: tuple[str, ...] = texts(_CRITICS, "what trajectories are scored by")

    CRITICS: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "ConstraintCritic": {"min_turning_r": 0.2, "cost_weight": 4.0},
        "CostCritic": {
            "cost_weight": 3.81, "critical_cost": 300.0, "collision_cost": 1_000_000.0,
            "near_collision_cost": 253, "near_goal_distance": 0.5, "consider_footprint": False,
        },
        "ObstaclesCritic": {
            "repulsion_weight": 1.5, "critical_weight": 20.0, "collision_cost": 100_000.0,
            "near_goal_distance": 0.5, "consider_footprint": False,
        },
        "GoalCritic": {"cost_weight": 5.0, "threshold_to_consider": 1.4},
        "GoalAngleCritic": {"cost_weight": 3.0, "threshold_to_consider": 0.5},
        "PathAlignCritic": {
            "cost_weight": 10.0, "threshold_to_consider": 0.5, "offset_from_furthest": 20,
        },
        "PathFollowCritic": {
            "cost_weight": 5.0, "threshold_to_consider": 1.4, "offset_from_furthest": 6,
        },
        "PathAngleCritic": {
            "cost_weight": 2.2, "threshold_to_consider": 0.5, "offset_from_furthest": 4,
            "max_angle_to_furthest": 0.785,
        },
        "PreferForwardCritic": {"cost_weight": 5.0, "threshold_to_consider": 0.5},
        "TwirlingCritic": {"cost_weight": 10.0},
    }  # fmt: skip
    CRITICS_IDLE: ClassVar[Mapping[str, str]] = {
        "cost_power": "costs count as they are, power 1",
        "enabled": "leave a critic out of critics",
        "trajectory_point_step": "every second point is looked at",
        "max_path_occupancy_ratio": "the path is kept to around obstacles as well",
        "use_path_orientations": "paths are followed by their points",
        "inflation_layer_name": "costs are those of the costmap",
        "cost_scaling_factor": "costs are those of the costmap",
        "inflation_radius": "costs are those of the costmap",
        "collision_margin_distance": "cost 253 is the margin",
        "symmetric_yaw_tolerance": "the goal has one direction",
        "forward_preference": "see PreferForwardCritic",
        "mode": "see PreferForwardCritic",
    }
    IDLE: ClassVar[Mapping[str, str]] = {
        "visualize": "the best trajectory is published as local_plan",
        "publish_optimal_trajectory": "the best trajectory is published as local_plan",
        "publish_critics_stats": "critics are not published",
        "reset_period": "every goal begins anew",
        "transform_tolerance": "the costmap's transform_tolerance counts",
        "max_robot_pose_search_dist": "the robot is looked for along the path in the costmap",
        "enforce_path_inversion": "paths of planners that are there do not turn back",
        "inversion_xy_tolerance": "paths of planners that are there do not turn back",
        "inversion_yaw_tolerance": "paths of planners that are there do not turn back",
        "TrajectoryVisualizer": "the best trajectory is published as local_plan",
        "TrajectoryValidator": "the best trajectory is always checked",
    }


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
        from gazelle.navigation.controllers.mppi_kernels import score_batch

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
        from gazelle.navigation.controllers.mppi_kernels import roll_out

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
