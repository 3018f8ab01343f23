"""Parameters of Nav2's Regulated Pure Pursuit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from gazelle.parameters.options import flag, number

__all__ = ["PursuitOptions"]


@dataclass(frozen=True, slots=True)
class PursuitOptions:
    """``nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController``."""

    desired_linear_vel: float = number(0.5, "speed on straight and open ground", "m/s", 0)
    lookahead_dist: float = number(0.6, "distance of the point that is steered for", "m", 0.01)
    min_lookahead_dist: float = number(0.3, "lower limit of it with velocity scaling", "m", 0.01)
    max_lookahead_dist: float = number(0.9, "upper limit of it with velocity scaling", "m", 0.01)
    lookahead_time: float = number(1.5, "distance by speed, with velocity scaling", "s", 0)
    use_velocity_scaled_lookahead_dist: bool = flag(False, "the distance grows with speed")
    rotate_to_heading_angular_vel: float = number(1.8, "speed of turns on the spot", "rad/s", 0)
    rotate_to_heading_min_angle: float = number(0.785, "angle to the path from which on the robot "
                                                "turns on the spot", "rad", 0)  # fmt: skip
    use_rotate_to_heading: bool = flag(True, "turn on the spot towards the path and in the goal")
    max_angular_accel: float = number(3.2, "of turns on the spot", "rad/s²", 0.01)
    min_approach_linear_velocity: float = number(0.05, "slowest speed near the goal", "m/s", 0)
    approach_velocity_scaling_dist: float = number(
        0.6, "length of the path that is left from which on the robot slows down", "m", 0
    )
    use_collision_detection: bool = flag(True, "stop before obstacles on the way")
    max_allowed_time_to_collision_up_to_carrot: float = number(
        1.0, "how long ahead obstacles are looked for", "s", 0
    )
    use_regulated_linear_velocity_scaling: bool = flag(True, "slow in curves")
    regulated_linear_scaling_min_radius: float = number(0.9, "radius below which that begins",
                                                        "m", 0.01)  # fmt: skip
    regulated_linear_scaling_min_speed: float = number(
        0.25, "lower limit of slowing down", "m/s", 0
    )
    use_cost_regulated_linear_velocity_scaling: bool = flag(True, "slow down near obstacles")
    cost_scaling_dist: float = number(0.6, "distance from obstacles below which that begins", "m",
                                      0.01)  # fmt: skip
    cost_scaling_gain: float = number(1.0, "how much, at most 1", "", 0.01)
    inflation_cost_scaling_factor: float = number(3.0, "that of the inflation layer", "1/m", 0.01)
    use_fixed_curvature_lookahead: bool = flag(False, "curves are measured at their own distance")
    curvature_lookahead_dist: float = number(0.6, "that distance", "m", 0.01)
    allow_reversing: bool = flag(False, "drive backwards where the path lies behind")
    max_robot_pose_search_dist: float = number(10.0, "how far along the path the robot is looked "
                                               "for", "m", 0)  # fmt: skip

    IDLE: ClassVar[Mapping[str, str]] = {
        "transform_tolerance": "the costmap's transform_tolerance counts",
        "use_cancel_deceleration": "a cancelled goal stops the robot at once",
        "cancel_deceleration": "a cancelled goal stops the robot at once",
        "interpolate_curvature_after_goal": "the path ends in the goal",
        "stateful": "the goal checker's stateful counts",
        "use_interpolation": "the point that is steered for is always interpolated",
    }
