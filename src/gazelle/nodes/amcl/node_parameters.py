"""The parameters of amcl: those of the filter and those of the node."""

from __future__ import annotations

from gazelle.navigation.localization import AmclOptions
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.dataclass_tables import table_of

__all__ = ["AMCL", "NAV2_AMCL"]

_LIVE = (
    "min_particles",
    "max_particles",
    "kld_err",
    "kld_z",
    "update_min_d",
    "update_min_a",
    "resample_interval",
    "recovery_alpha_slow",
    "recovery_alpha_fast",
    "do_beamskip",
    "beam_skip_distance",
    "beam_skip_threshold",
    "laser_min_range",
    "laser_max_range",
    "laser_max_beams",
    "laser_z_hit",
    "laser_z_short",
    "laser_z_max",
    "laser_z_rand",
    "laser_sigma_hit",
    "laser_lambda_short",
    "laser_likelihood_max_dist",
    "laser_model_type",
    "odom_model_type",
    "odom_alpha1",
    "odom_alpha2",
    "odom_alpha3",
    "odom_alpha4",
    "odom_alpha5",
)

_SHARED = (
    Parameter("odom_frame_id", "text", "odom", "frame of odometry"),
    Parameter("global_frame_id", "text", "map", "frame of the map"),
    Parameter("tf_broadcast", "flag", True, "publish the transform from map to odometry"),
    Parameter("first_map_only", "flag", False, "maps after the first one are not looked at"),
    Parameter(
        "save_pose_rate",
        "number",
        0.5,
        "how often the pose is kept as the parameters "
        "initial_pose_* for the next start; −1 for never",
        "Hz",
    ),
)
_ROS1 = (
    Parameter("base_frame_id", "text", "base_link", "frame of the robot"),
    Parameter("transform_tolerance", "number", 0.1, "how far ahead the transform is dated", "s", 0),
    Parameter(
        "use_map_topic", "flag", False, "take maps from the topic map; else ask static_map once"
    ),
    Parameter(
        "force_update_after_initialpose",
        "flag",
        False,
        "the first scan after initialpose counts although the robot stands",
    ),
    Parameter("force_update_after_set_map", "flag", False, "the same after set_map"),
)
_ROS2 = (
    Parameter("base_frame_id", "text", "base_footprint", "frame of the robot"),
    Parameter("transform_tolerance", "number", 1.0, "how far ahead the transform is dated", "s", 0),
    Parameter("scan_topic", "text", "scan", "topic of the scans"),
    Parameter("map_topic", "text", "map", "topic of the map"),
    Parameter(
        "set_initial_pose", "flag", False, "begin at initial_pose; else wait for initialpose"
    ),
    Parameter("initial_pose.x", "number", 0.0, "where the robot is at the start", "m"),
    Parameter("initial_pose.y", "number", 0.0, "where the robot is at the start", "m"),
    Parameter("initial_pose.yaw", "number", 0.0, "where it looks at the start", "rad"),
)

_SUMMARY = "Finds the robot in a map by its lidar, with a particle filter."
_NAV2_NAMES = {
    "initial_pose_x": "initial_pose.x",
    "initial_pose_y": "initial_pose.y",
    "initial_pose_a": "initial_pose.yaw",
}
_CLOUDS = refused("the cloud is published at every update", "gui_publish_rate")
_IDLE_ROS1 = refused("set the parameters themselves", "restore_defaults")
_IDLE_ROS2 = (
    *refused("services are not introspected", "introspection_mode", "service_introspection_mode"),
    *refused("random poses come from all free cells", "freespace_downsampling"),
    *refused("the ground is flat", "initial_pose.z"),
    *refused("activating goes on with the particles", "always_reset_initial_pose"),
    *refused("the node's name is the seed, so two runs are alike", "random_seed"),
)

AMCL = table_of(AmclOptions, "amcl", _SUMMARY, ("amcl/amcl",), live=_LIVE).plus(
    (*_SHARED, *_ROS1, *_CLOUDS, *_IDLE_ROS1)
)
_NAV2 = table_of(AmclOptions, "nav2_amcl", "", defaults=AmclOptions.NAV2_DEFAULTS, live=_LIVE)
NAV2_AMCL = ParameterTable(
    "nav2_amcl",
    f"{_SUMMARY} A managed node.",
    ("nav2_amcl/amcl",),
    (
        *(row for row in _NAV2.rows if row.key not in _NAV2_NAMES),
        *_SHARED,
        *_ROS2,
        *_CLOUDS,
        *_IDLE_ROS2,
        *(Parameter(key, "refused", None, f"Nav2 reads {own}") for key, own in _NAV2_NAMES.items()),
    ),
)
