"""What the sampling controllers have in common, and how each of them sees it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.navigation.controllers.options import DwaOptions, DwbOptions

__all__ = ["Profile", "dwa_profile", "dwb_profile"]

Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Profile:
    """Limits, samples and weights of a controller that scores sampled velocities.

    Attributes:
        name: what messages call it.
        low, high: velocities along x, y (m/s) and around z (rad/s).
        acceleration, deceleration: their limits, both positive.
        slowest_m_s, slowest_rad_s: a velocity below both is not tried, negative for any.
        fastest_m_s: highest speed, negative for any.
        counts: samples along x, y, around z.
        sim_time_s: duration of trajectories.
        step_m, step_rad: between points of a trajectory; with step_m 0 step_rad is seconds.
        holds: trajectories hold a velocity that is reached within one period.
        arrives: trajectories that do not are no faster than what gets to the goal in their time.
        path, goal, nose_goal, nose_path: weights of distances.
        per_resolution: these weights are multiplied by so many times the resolution.
        obstacles, turning, backwards: weights.
        nose_m: how far ahead the nose is.
        free_nose_m2: squared distance to the goal below which the nose need not be on the path.
        outlined: the whole outline must be free, else the centre.
        sums: costs of obstacles are summed along a trajectory.
        growth_from_m_s, growth: the outline grows with speed.
        tolerance_m, tolerance_rad: of the goal.
        stopped_m_s, stopped_rad_s: below them the robot stands.
        latches: once in the goal the robot only turns.
        behind_m, ahead_m: how much of the path is looked at.
        reset_m, reset_rad, slow_m_s: of `Oscillation`; infinite reset_m for none.
    """

    name: str
    low: Triple
    high: Triple
    acceleration: Triple
    deceleration: Triple
    slowest_m_s: float
    slowest_rad_s: float
    fastest_m_s: float
    counts: tuple[int, int, int]
    sim_time_s: float
    step_m: float
    step_rad: float
    path: float
    goal: float
    nose_goal: float
    nose_path: float
    per_resolution: float
    obstacles: float
    tolerance_m: float
    tolerance_rad: float
    stopped_m_s: float
    stopped_rad_s: float
    nose_m: float = 0.325
    free_nose_m2: float = 0.0
    turning: float = 0.0
    backwards: float = 0.0
    outlined: bool = True
    sums: bool = False
    holds: bool = True
    arrives: bool = True
    latches: bool = False
    growth_from_m_s: float = math.inf
    growth: float = 0.0
    behind_m: float = math.inf
    ahead_m: float = math.inf
    reset_m: float = 0.05
    reset_rad: float = 0.2
    slow_m_s: float = 0.0
    oscillates: bool = False


def dwa_profile(o: DwaOptions) -> Profile:
    """Return how ``DWAPlannerROS`` drives."""
    acceleration = (o.acc_lim_x, o.acc_lim_y, o.acc_lim_theta)
    return Profile(
        name="DWA planner",
        low=(o.min_vel_x, o.min_vel_y, -o.max_vel_theta),
        high=(o.max_vel_x, o.max_vel_y, o.max_vel_theta),
        acceleration=acceleration,
        deceleration=acceleration,
        slowest_m_s=o.min_vel_trans,
        slowest_rad_s=o.min_vel_theta,
        fastest_m_s=o.max_vel_trans,
        counts=(max(o.vx_samples, 1), max(o.vy_samples, 1), max(o.vth_samples, 1)),
        sim_time_s=o.sim_time,
        step_m=o.sim_granularity,
        step_rad=o.angular_sim_granularity,
        holds=o.use_dwa,
        path=o.path_distance_bias,
        goal=o.goal_distance_bias,
        nose_goal=o.goal_distance_bias,
        nose_path=o.path_distance_bias,
        per_resolution=1.0,
        obstacles=o.occdist_scale,
        turning=o.twirling_scale,
        nose_m=o.forward_point_distance,
        free_nose_m2=o.forward_point_distance**2 * o.cheat_factor,
        sums=o.sum_scores,
        growth_from_m_s=o.scaling_speed,
        growth=o.max_scaling_factor,
        tolerance_m=o.xy_goal_tolerance,
        tolerance_rad=o.yaw_goal_tolerance,
        stopped_m_s=o.trans_stopped_vel,
        stopped_rad_s=o.theta_stopped_vel,
        latches=o.latch_xy_goal_tolerance,
        behind_m=1.0 if o.prune_plan else math.inf,
        reset_m=o.oscillation_reset_dist,
        reset_rad=o.oscillation_reset_angle,
        slow_m_s=o.min_vel_trans,
    )


def dwb_profile(o: DwbOptions, critics: Mapping[str, Mapping[str, Any]]) -> Profile:
    """Return how ``DWBLocalPlanner`` drives.

    Args:
        o: its parameters.
        critics: parameters of critics by name; what is missing has the default.
    """
    used = _used_critics(o, critics)

    def of(critic: str, key: str, default: float = 0.0) -> float:
        return float(used.get(critic, {}).get(key, default))

    outlined = "ObstacleFootprint" in used
    obstacle = "ObstacleFootprint" if outlined else "BaseObstacle"
    rotates = "RotateToGoal" in used
    return Profile(
        name="DWB controller",
        **_dwb_limits(o),
        path=of("PathDist", "scale"),
        goal=of("GoalDist", "scale"),
        nose_goal=of("GoalAlign", "scale"),
        nose_path=of("PathAlign", "scale"),
        per_resolution=0.5,
        obstacles=of(obstacle, "scale"),
        turning=of("Twirling", "scale"),
        backwards=of("PreferForward", "scale") * of("PreferForward", "penalty"),
        nose_m=of("PathAlign", "forward_point_distance", of("GoalAlign", "forward_point_distance")),
        free_nose_m2=of("PathAlign", "forward_point_distance") ** 2,
        outlined=outlined,
        sums=bool(of(obstacle, "sum_scores")),
        tolerance_m=of("RotateToGoal", "xy_goal_tolerance") if rotates else 0.0,
        tolerance_rad=0.05,
        stopped_m_s=of("RotateToGoal", "trans_stopped_velocity", 0.25),
        stopped_rad_s=math.inf,
        behind_m=o.prune_distance if o.prune_plan else math.inf,
        ahead_m=o.forward_prune_distance,
        reset_m=of("Oscillation", "oscillation_reset_dist", math.inf),
        reset_rad=of("Oscillation", "oscillation_reset_angle", math.inf),
        slow_m_s=of("Oscillation", "x_only_threshold"),
        oscillates="Oscillation" not in used,
    )


def _used_critics(
    o: DwbOptions, critics: Mapping[str, Mapping[str, Any]]
) -> dict[str, dict[str, Any]]:
    names = (item.rpartition("::")[2].removesuffix("Critic") for item in o.critics)
    return {
        name: {**DwbOptions.CRITICS[name], **critics.get(name, {})}
        for name in names
        if name in DwbOptions.CRITICS
    }


def _dwb_limits(o: DwbOptions) -> dict[str, Any]:
    return {
        "low": (o.min_vel_x, o.min_vel_y, -o.max_vel_theta),
        "high": (o.max_vel_x, o.max_vel_y, o.max_vel_theta),
        "acceleration": (o.acc_lim_x, o.acc_lim_y, o.acc_lim_theta),
        "deceleration": (-o.decel_lim_x, -o.decel_lim_y, -o.decel_lim_theta),
        "slowest_m_s": o.min_speed_xy,
        "slowest_rad_s": o.min_speed_theta,
        "fastest_m_s": o.max_speed_xy if o.max_speed_xy > 0 else -1.0,
        "counts": (o.vx_samples, o.vy_samples, o.vtheta_samples),
        "sim_time_s": o.sim_time,
        "step_m": 0.0 if o.discretize_by_time else o.linear_granularity,
        "step_rad": o.time_granularity if o.discretize_by_time else o.angular_granularity,
    }
