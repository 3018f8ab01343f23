"""Parameters of local planners that sample velocities, and what these planners have in common.

They are DWA, DWB and base_local_planner's; a `Profile` is what the sampling controller sees of one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from gazelle.parameters.dataclass_tables import flag, integer, number, text, texts

__all__ = [
    "DwaOptions",
    "DwbOptions",
    "Profile",
    "TrajectoryPlannerOptions",
    "dwa_profile",
    "dwb_profile",
]


_PICTURE = "the clouds of costs and trajectories are not published; see local_plan"

_TRAJECTORY = "how long trajectories are looked ahead"

_STEP = "distance between points of a trajectory that are checked"

_TURN = "turn between points of a trajectory that are checked"


@dataclass(frozen=True, slots=True)
class DwaOptions:
    """``dwa_local_planner/DWAPlannerROS`` (ROS 1)."""

    max_vel_trans: float = number(0.55, "highest speed", "m/s", 0, aliases=("max_trans_vel",))
    min_vel_trans: float = number(0.1, "lowest speed", "m/s", aliases=("min_trans_vel",))
    max_vel_x: float = number(0.55, "highest velocity along x", "m/s")
    min_vel_x: float = number(0.0, "lowest velocity along x, negative for backwards", "m/s")
    max_vel_y: float = number(0.1, "highest velocity along y", "m/s")
    min_vel_y: float = number(-0.1, "lowest velocity along y", "m/s")
    max_vel_theta: float = number(1.0, "fastest turn", "rad/s", 0, aliases=("max_rot_vel",))
    min_vel_theta: float = number(0.4, "slowest turn", "rad/s", aliases=("min_rot_vel",))
    acc_lim_x: float = number(2.5, "acceleration along x", "m/s²", 0)
    acc_lim_y: float = number(2.5, "acceleration along y", "m/s²", 0)
    acc_lim_theta: float = number(3.2, "angular acceleration", "rad/s²", 0)
    xy_goal_tolerance: float = number(0.1, "how near the goal is near enough", "m", 0)
    yaw_goal_tolerance: float = number(0.1, "how well the direction has to fit", "rad", 0)
    trans_stopped_vel: float = number(0.1, "below it the robot stands", "m/s", 0)
    theta_stopped_vel: float = number(0.1, "below it the robot does not turn", "rad/s", 0,
                                      aliases=("rot_stopped_vel",))  # fmt: skip
    latch_xy_goal_tolerance: bool = flag(False, "once in the goal the robot only turns")
    prune_plan: bool = flag(False, "what was passed by a metre is forgotten")
    sim_time: float = number(1.7, _TRAJECTORY, "s", 0.01)
    sim_granularity: float = number(0.025, _STEP, "m", 1e-3)
    angular_sim_granularity: float = number(0.1, _TURN, "rad", 1e-3)
    path_distance_bias: float = number(0.6, "weight of keeping to the path", "", 0)
    goal_distance_bias: float = number(0.8, "weight of getting to the local goal", "", 0)
    occdist_scale: float = number(0.01, "weight of keeping away from obstacles", "", 0)
    twirling_scale: float = number(0.0, "weight of not turning", "", 0)
    oscillation_reset_dist: float = number(0.05, "distance after which it may reverse", "m", 0)
    oscillation_reset_angle: float = number(0.2, "turn after which it may reverse", "rad", 0)
    forward_point_distance: float = number(0.325, "how far ahead the nose is that is scored", "m")
    scaling_speed: float = number(0.25, "speed from which on the outline grows", "m/s", 0)
    max_scaling_factor: float = number(0.2, "growth of the outline at the highest speed", "", 0)
    vx_samples: int = integer(3, "velocities along x", 0)
    vy_samples: int = integer(10, "velocities along y", 0)
    vth_samples: int = integer(20, "turning velocities", 0)
    use_dwa: bool = flag(True, "only velocities that are reached within one period, else within "
                         "sim_time")  # fmt: skip
    sum_scores: bool = flag(False, "sum costs of obstacles along a trajectory, else the highest")
    cheat_factor: float = number(1.0, "nearness to the goal, in forward_point_distance², from "
                                 "which on the nose is free", "", 0)  # fmt: skip

    IDLE: ClassVar[Mapping[str, str]] = {
        "publish_traj_pc": _PICTURE,
        "publish_cost_grid_pc": _PICTURE,
        "global_frame_id": _PICTURE,
        "restore_defaults": "set the parameters themselves",
        "stop_time_buffer": "the original reads it and does not use it",
        "acc_lim_trans": "the original does not use it; acc_lim_x and acc_lim_y count",
        "acc_limit_trans": "the original does not use it; acc_lim_x and acc_lim_y count",
        "penalize_negative_x": "the original no longer has it; set min_vel_x to 0",
        "escape_vel": "it is TrajectoryPlannerROS's",
    }


@dataclass(frozen=True, slots=True)
class TrajectoryPlannerOptions:
    """``base_local_planner/TrajectoryPlannerROS`` (ROS 1).

    Defaults are those of ``BaseLocalPlanner.cfg``, which its node sets where a file says nothing.
    """

    max_vel_x: float = number(0.55, "highest velocity along x", "m/s", 0)
    min_vel_x: float = number(0.0, "lowest velocity along x", "m/s")
    max_vel_theta: float = number(1.0, "fastest turn", "rad/s", 0,
                                  aliases=("max_rotational_vel",))  # fmt: skip
    min_vel_theta: float = number(-1.0, "fastest turn to the right", "rad/s", high=0)
    min_in_place_vel_theta: float = number(0.4, "slowest turn on the spot", "rad/s", 0,
                                           aliases=("min_in_place_rotational_vel",))  # fmt: skip
    acc_lim_x: float = number(2.5, "acceleration along x", "m/s²", 0)
    acc_lim_y: float = number(2.5, "acceleration along y", "m/s²", 0)
    acc_lim_theta: float = number(3.2, "angular acceleration", "rad/s²", 0, aliases=("acc_lim_th",))
    escape_vel: float = number(-0.1, "velocity of backing up when nothing else is left", "m/s",
                               aliases=("backup_vel",))  # fmt: skip
    escape_reset_dist: float = number(0.1, "distance after which it drives ahead again", "m", 0)
    escape_reset_theta: float = number(1.5708, "turn after which it drives ahead again", "rad", 0)
    holonomic_robot: bool = flag(True, "the robot can drive sideways")
    y_vels: tuple[str, ...] = texts(
        ("-0.3", "-0.1", "0.1", "0.3"), "velocities along y that are tried, m/s"
    )
    xy_goal_tolerance: float = number(0.10, "how near the goal is near enough", "m", 0)
    yaw_goal_tolerance: float = number(0.05, "how well the direction has to fit", "rad", 0)
    trans_stopped_velocity: float = number(1e-2, "below it the robot stands", "m/s", 0)
    rot_stopped_velocity: float = number(1e-2, "below it the robot does not turn", "rad/s", 0)
    latch_xy_goal_tolerance: bool = flag(False, "once in the goal the robot only turns")
    prune_plan: bool = flag(True, "what was passed by a metre is forgotten")
    sim_time: float = number(1.7, _TRAJECTORY, "s", 0.01)
    sim_granularity: float = number(0.025, _STEP, "m", 1e-3)
    angular_sim_granularity: float = number(0.025, _TURN, "rad", 1e-3)
    vx_samples: int = integer(20, "velocities along x", 1)
    vtheta_samples: int = integer(20, "turning velocities", 1)
    path_distance_bias: float = number(0.6, "weight of keeping to the path", "", 0,
                                       aliases=("pdist_scale",))  # fmt: skip
    goal_distance_bias: float = number(0.8, "weight of getting to the local goal", "", 0,
                                       aliases=("gdist_scale",))  # fmt: skip
    occdist_scale: float = number(0.01, "weight of keeping away from obstacles", "", 0)
    oscillation_reset_dist: float = number(0.05, "distance after which it may turn back", "m", 0)
    heading_lookahead: float = number(0.325, "how far ahead turns on the spot are told apart", "m",
                                      0)  # fmt: skip
    heading_scoring: bool = flag(False, "trajectories are scored by where they look, and at one "
                                 "time instead of their end")  # fmt: skip
    heading_scoring_timestep: float = number(0.1, "that time", "s", 0)
    simple_attractor: bool = flag(False, "the goal attracts in a straight line, whatever the plan "
                                  "says")  # fmt: skip
    dwa: bool = flag(False, "only velocities that are reached within one period, else within "
                     "sim_time")  # fmt: skip
    meter_scoring: bool = flag(False, "weights of distances are per metre, else per cell; that of "
                               "obstacles, too, with pdist_scale and gdist_scale, as up to ROS "
                               "Lunar")  # fmt: skip

    IDLE: ClassVar[Mapping[str, str]] = {
        "publish_cost_grid_pc": _PICTURE,
        "global_frame_id": _PICTURE,
        "controller_frequency": "move_base's counts",
        "world_model": "the costmap is the world",
        "restore_defaults": "set the parameters themselves",
        "stop_time_buffer": "the original reads it and does not use it",
        "inscribed_radius": "the footprint says it",
        "circumscribed_radius": "the footprint says it",
    }


_DWB_CRITICS = (
    "RotateToGoal", "Oscillation", "BaseObstacle", "GoalAlign", "PathAlign", "PathDist", "GoalDist",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class DwbOptions:
    """``dwb_core::DWBLocalPlanner`` (Nav2). Parameters of critics are ``<critic>.<name>``."""

    min_vel_x: float = number(0.0, "lowest velocity along x", "m/s")
    min_vel_y: float = number(0.0, "lowest velocity along y", "m/s")
    max_vel_x: float = number(0.0, "highest velocity along x", "m/s")
    max_vel_y: float = number(0.0, "highest velocity along y", "m/s")
    max_vel_theta: float = number(0.0, "fastest turn", "rad/s", 0)
    min_speed_xy: float = number(0.0, "lowest speed", "m/s")
    max_speed_xy: float = number(0.0, "highest speed, 0 for any", "m/s")
    min_speed_theta: float = number(0.0, "slowest turn", "rad/s")
    acc_lim_x: float = number(0.0, "acceleration along x", "m/s²", 0)
    acc_lim_y: float = number(0.0, "acceleration along y", "m/s²", 0)
    acc_lim_theta: float = number(0.0, "angular acceleration", "rad/s²", 0)
    decel_lim_x: float = number(0.0, "deceleration along x, negative", "m/s²", None, 0)
    decel_lim_y: float = number(0.0, "deceleration along y, negative", "m/s²", None, 0)
    decel_lim_theta: float = number(0.0, "angular deceleration, negative", "rad/s²", None, 0)
    vx_samples: int = integer(20, "velocities along x", 1)
    vy_samples: int = integer(5, "velocities along y", 0)
    vtheta_samples: int = integer(20, "turning velocities", 1)
    sim_time: float = number(1.7, _TRAJECTORY, "s", 0.01)
    discretize_by_time: bool = flag(False, "points of a trajectory are time_granularity apart")
    time_granularity: float = number(0.5, "time between points of a trajectory", "s", 1e-3)
    linear_granularity: float = number(0.5, _STEP, "m", 1e-3)
    angular_granularity: float = number(0.025, _TURN, "rad", 1e-3)
    prune_plan: bool = flag(True, "what was passed is forgotten")
    prune_distance: float = number(2.0, "how far behind that begins", "m", 0)
    forward_prune_distance: float = number(2.0, "how far ahead the path is looked at", "m", 0)
    xy_goal_tolerance: float = number(0.25, "how near the goal RotateToGoal turns", "m", 0)
    trans_stopped_velocity: float = number(0.25, "below it RotateToGoal turns", "m/s", 0)
    trajectory_generator_name: str = text(
        "dwb_plugins::StandardTrajectoryGenerator",
        "that one tries velocities that sim_time reaches; dwb_plugins::LimitedAccelGenerator those "
        "that one period does, and holds them",
    )
    critics: tuple[str, ...] = texts(_DWB_CRITICS, "what trajectories are scored by")

    CRITICS: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "RotateToGoal": {"xy_goal_tolerance": 0.25, "trans_stopped_velocity": 0.25},
        "Oscillation": {
            "oscillation_reset_dist": 0.05,
            "oscillation_reset_angle": 0.2,
            "x_only_threshold": 0.05,
        },
        "BaseObstacle": {"scale": 1.0, "sum_scores": False},
        "ObstacleFootprint": {"scale": 1.0, "sum_scores": False},
        "GoalAlign": {"scale": 1.0, "forward_point_distance": 0.325},
        "PathAlign": {"scale": 1.0, "forward_point_distance": 0.325},
        "PathDist": {"scale": 1.0},
        "GoalDist": {"scale": 1.0},
        "PreferForward": {"scale": 1.0, "penalty": 1.0, "theta_scale": 10.0},
        "Twirling": {"scale": 0.0},
    }
    CRITICS_IDLE: ClassVar[Mapping[str, str]] = {
        "RotateToGoal.scale": "in the goal nothing else is scored",
        "RotateToGoal.slowing_factor": "in the goal the robot slows down as its limits allow",
        "RotateToGoal.lookahead_time": "the turn ends by the distance that is left",
        "Oscillation.scale": "what oscillates is refused, not scored",
        "Oscillation.oscillation_reset_time": "distance and turn count",
        "PreferForward.strafe_x": "strafing is not scored beyond the penalty",
        "PreferForward.strafe_theta": "strafing is not scored beyond the penalty",
        **{
            f"{name}.aggregation_type": "the last point of a trajectory counts"
            for name in ("GoalAlign", "PathAlign", "PathDist", "GoalDist")
        },
        "PathAlign.stop_on_failure": "the nose may hang over what the robot cannot stand on",
        "GoalAlign.stop_on_failure": "the nose may hang over what the robot cannot stand on",
    }
    IDLE: ClassVar[Mapping[str, str]] = {
        "stateful": "the goal checker's stateful counts",
        "debug_trajectory_details": "what was refused is told when nothing is left",
        "default_critic_namespaces": "critics are found by their names alone",
        "transform_tolerance": "the costmap's transform_tolerance counts",
        "shorten_transformed_plan": "the path is always cut at forward_prune_distance",
        "short_circuit_trajectory_evaluation": "all trajectories are scored, at once",
        "include_last_point": "the last point of a trajectory is one step before its end",
        "limit_vel_cmd_in_traj": "trajectories hold the velocity that is commanded",
        "publish_evaluation": _PICTURE,
        "publish_trajectories": _PICTURE,
        "publish_cost_grid_pc": _PICTURE,
        "publish_global_plan": _PICTURE,
        "publish_transformed_plan": _PICTURE,
        "publish_local_plan": _PICTURE,
        "marker_lifetime": _PICTURE,
    }


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
