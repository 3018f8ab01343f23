"""Parameters of ``amcl`` (ROS 1) and ``nav2_amcl`` (ROS 2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

from gazelle.parameters.dataclass_tables import flag, integer, number, text

__all__ = ["AmclOptions"]

_NOISE = "noise of {} from {}"
_COVARIANCE = "spread of the initial pose"


@dataclass(frozen=True, slots=True)
class AmclOptions:
    """The filter."""

    min_particles: int = integer(100, "fewest particles", 1)
    max_particles: int = integer(5000, "most particles", 1, 1_000_000)
    kld_err: float = number(0.01, "error of the distribution that is allowed", "", 1e-6,
                            aliases=("pf_err",))  # fmt: skip
    kld_z: float = number(0.99, "quantile of that error", "", 0, aliases=("pf_z",))
    update_min_d: float = number(0.2, "way after which a scan counts", "m", 0)
    update_min_a: float = number(pi / 6, "turn after which a scan counts", "rad", 0)
    resample_interval: int = integer(2, "updates per resampling", 1)
    recovery_alpha_slow: float = number(0.0, "rate of the slow average of weights; 0 for no "
                                        "random poses", "", 0, 1)  # fmt: skip
    recovery_alpha_fast: float = number(0.0, "rate of the fast average of weights", "", 0, 1)
    selective_resampling: bool = flag(False, "resample only when few particles carry the weight")
    do_beamskip: bool = flag(False, "leave out beams that fit few particles; "
                             "likelihood_field_prob only")  # fmt: skip
    beam_skip_distance: float = number(0.5, "how near to a wall a beam fits", "m", 0)
    beam_skip_threshold: float = number(0.3, "share of particles that a beam has to fit", "", 0, 1)
    beam_skip_error_threshold: float = number(0.9, "share of beams left out from which on all "
                                              "count", "", 0, 1)  # fmt: skip
    laser_min_range: float = number(-1.0, "shortest range that counts, −1 for the lidar's", "m")
    laser_max_range: float = number(-1.0, "longest range that counts, −1 for the lidar's", "m",
                                    aliases=())  # fmt: skip
    laser_max_beams: int = integer(30, "beams that are looked at", 2, aliases=("max_beams",))
    laser_z_hit: float = number(0.95, "weight of hits", "", 0, 1, aliases=("z_hit",))
    laser_z_short: float = number(0.1, "weight of what stands before walls", "", 0, 1,
                                  aliases=("z_short",))  # fmt: skip
    laser_z_max: float = number(0.05, "weight of the longest range", "", 0, 1, aliases=("z_max",))
    laser_z_rand: float = number(0.05, "weight of anything", "", 0, 1, aliases=("z_rand",))
    laser_sigma_hit: float = number(0.2, "spread of hits", "m", 1e-6, aliases=("sigma_hit",))
    laser_lambda_short: float = number(0.1, "decay of what stands before walls", "1/m", 0,
                                       aliases=("lambda_short",))  # fmt: skip
    laser_likelihood_max_dist: float = number(2.0, "how far from walls hits are told apart", "m",
                                              1e-3)  # fmt: skip
    laser_model_type: str = text("likelihood_field", "beam, likelihood_field or "
                                 "likelihood_field_prob")  # fmt: skip
    odom_model_type: str = text("diff", "diff, omni, diff-corrected or omni-corrected; "
                                "nav2_amcl::DifferentialMotionModel or nav2_amcl::OmniMotionModel",
                                aliases=("robot_model_type",))  # fmt: skip
    odom_alpha1: float = number(0.2, _NOISE.format("turns", "turns"), "", 0, aliases=("alpha1",))
    odom_alpha2: float = number(0.2, _NOISE.format("turns", "ways"), "", 0, aliases=("alpha2",))
    odom_alpha3: float = number(0.2, _NOISE.format("ways", "ways"), "", 0, aliases=("alpha3",))
    odom_alpha4: float = number(0.2, _NOISE.format("ways", "turns"), "", 0, aliases=("alpha4",))
    odom_alpha5: float = number(0.2, "noise sideways, omni only", "", 0, aliases=("alpha5",))
    initial_pose_x: float = number(0.0, "where the robot is at the start", "m")
    initial_pose_y: float = number(0.0, "where the robot is at the start", "m")
    initial_pose_a: float = number(0.0, "where it looks at the start", "rad")
    initial_cov_xx: float = number(0.25, _COVARIANCE, "m²", 0)
    initial_cov_yy: float = number(0.25, _COVARIANCE, "m²", 0)
    initial_cov_aa: float = number((pi / 12) ** 2, _COVARIANCE, "rad²", 0)

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {
        "min_particles": 500,
        "max_particles": 2000,
        "kld_err": 0.05,
        "update_min_d": 0.25,
        "update_min_a": 0.2,
        "resample_interval": 1,
        "laser_max_range": 100.0,
        "laser_max_beams": 60,
        "laser_z_hit": 0.5,
        "laser_z_short": 0.05,
        "laser_z_rand": 0.5,
        "odom_model_type": "nav2_amcl::DifferentialMotionModel",
    }
