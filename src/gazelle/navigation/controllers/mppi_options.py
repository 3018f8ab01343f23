"""Parameters of Nav2's MPPI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from gazelle.parameters.options import flag, integer, number, text, texts

__all__ = ["MppiOptions"]

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
