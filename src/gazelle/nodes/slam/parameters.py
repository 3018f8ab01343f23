"""The SLAM nodes of ROS by their parameters: names and defaults are theirs.

gmapping (wiki.ros.org/gmapping), slam_karto (wiki.ros.org/slam_karto), hector_mapping
(wiki.ros.org/hector_mapping), slam_toolbox (its README and ``mapper_params_online_async.yaml``),
cartographer (its Lua files).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from gazelle.mapping.slam import SlamParameters
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader

__all__ = [
    "CARTOGRAPHER",
    "GMAPPING",
    "HECTOR",
    "KARTO",
    "SLAM_NODES",
    "TOOLBOX",
    "SlamNode",
    "SlamOptions",
    "options_of",
    "used",
]


_ENGINE = frozenset(one.name for one in fields(SlamParameters))

_MAX_DISTANCE_M = 30.0
"""Fields of all that is seen would be too large, and beams that long err by their angle."""
_NO_PARTICLES = "the map is a graph of poses, not a filter with particles"
_OWN_MATCHER = "matching is Gazelle's own: its windows follow from odometry's errors"
_OWN_SOLVER = "the graph is solved by Gazelle's own sparse least squares"
_GROWS = "the map grows where the robot goes"
_SHOWS = "drawings and timings of the original's inside"

_KARTO_IDLE = (
    *refused(_OWN_MATCHER, "use_scan_matching", "use_scan_barycenter",
             "scan_buffer_maximum_scan_distance", "link_match_minimum_response_fine",
             "link_scan_maximum_distance", "correlation_search_space_dimension",
             "correlation_search_space_resolution", "correlation_search_space_smear_deviation",
             "distance_variance_penalty", "angle_variance_penalty", "fine_search_angle_offset",
             "coarse_search_angle_offset", "coarse_angle_resolution", "minimum_angle_penalty",
             "minimum_distance_penalty", "use_response_expansion"),
    *refused("places are found by branch and bound and believed when several agree",
             "loop_search_maximum_distance",
             "loop_match_minimum_chain_size", "loop_match_maximum_variance_coarse",
             "loop_match_minimum_response_coarse", "loop_match_minimum_response_fine",
             "loop_search_space_dimension", "loop_search_space_resolution",
             "loop_search_space_smear_deviation"),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class SlamOptions:
    """Options of a SLAM node.

    Attributes:
        base_frame, odom_frame, map_frame: ends of transforms.
        scan_topic: of the lidar.
        map_period_s: between two maps, 0 for one per kept scan.
        tf_period_s: between two transforms, 0 for none.
        tf_ahead_s: how far transforms are dated ahead.
        throttle: every so many-th scan is used.
        least_interval_s: between two scans that are used.
        resolution_m: of the map.
        occupied_share: of beams that end in an occupied cell.
        range_limit_m: longer ranges say nothing.
        publishes_tf: whether the transform from the map is sent.
        mode: ``mapping``, or ``localization`` in a map that stays as it is.
        map_file: graph of poses to begin with.
        start_pose: where the robot is in it, (x, y, yaw).
        slam: of the engine.
    """

    base_frame: str = "base_link"
    odom_frame: str = "odom"
    map_frame: str = "map"
    scan_topic: str = "scan"
    map_period_s: float = 5.0
    tf_period_s: float = 0.05
    tf_ahead_s: float = 0.05
    throttle: int = 1
    least_interval_s: float = 0.0
    resolution_m: float = 0.05
    occupied_share: float = 0.25
    range_limit_m: float = 1e9
    publishes_tf: bool = True
    mode: str = "mapping"
    map_file: str = ""
    start_pose: tuple[float, ...] = ()
    slam: SlamParameters = field(default_factory=SlamParameters)


_DEFAULTS = SlamOptions()


@dataclass(frozen=True, slots=True)
class SlamNode:
    """One package's SLAM node.

    Attributes:
        table: its parameters.
        uses: which option each of them is.
        base: options that it has and no parameter tells.
        services: it answers as slam_toolbox does.
    """

    table: ParameterTable
    uses: Mapping[str, str]
    base: SlamOptions = SlamOptions()
    services: bool = False


def used(
    key: str, default: Any, option: str, meaning: str, low: float | None = None, unit: str = ""
) -> tuple[Parameter, str]:
    """Return the row of a parameter that is an option, and that option."""
    kind = {str: "text", bool: "flag", int: "integer", list: "numbers"}.get(type(default), "number")
    return Parameter(key, kind, default, meaning, unit, low), option  # type: ignore[arg-type]


_KARTO_USES = (
    used("odom_frame", "odom", "odom_frame", "odometry's frame"),
    used("map_frame", "map", "map_frame", "the map's frame"),
    used("map_update_interval", 5.0, "map_period_s", "between two maps", 0.0, "s"),
    used("throttle_scans", 1, "throttle", "every so many-th scan is used", 1),
    used("resolution", 0.05, "resolution_m", "side of a cell of the map", 0.001, "m"),
    used("transform_publish_period", 0.05, "tf_period_s", "between two transforms", 0.0, "s"),
    used("do_loop_closing", True, "loop_closing", "whether places are recognised"),
    used("scan_buffer_size", 70, "submap_scans", "scans are matched with so many kept ones", 1),
)


def options_of(slam_node: SlamNode, settings: ParameterReader) -> SlamOptions:
    """Return the options that parameters name; others keep the engine's values."""
    own: dict[str, Any] = {}
    engine: dict[str, Any] = {}
    for key, option in slam_node.uses.items():
        row = slam_node.table.row(key)
        value = settings.value(row)
        (engine if option in _ENGINE else own)[option] = value
    for frame in ("base_frame", "odom_frame", "map_frame"):
        if frame in own:
            own[frame] = str(own[frame]).removeprefix("/")
    if "max_range_m" in engine:
        engine["max_range_m"] = min(_MAX_DISTANCE_M, engine["max_range_m"])
    slam = replace(slam_node.base.slam, **engine)
    return replace(slam_node.base, slam=slam, **own)


def _slam_node(
    family: str,
    types: tuple[str, ...],
    uses: tuple[tuple[Parameter, str], ...],
    idle: tuple[Parameter, ...],
    base: SlamOptions = _DEFAULTS,
    *,
    services: bool = False,
) -> SlamNode:
    rows = (*(row for row, _ in uses), *idle)
    table = ParameterTable(family, f"SLAM under the names of {family}.", types, rows)
    return SlamNode(table, {row.key: option for row, option in uses}, base, services)


_GMAPPING = _slam_node(
    "gmapping",
    ("gmapping/slam_gmapping",),
    (
        used("base_frame", "base_link", "base_frame", "the robot's frame"),
        used("map_frame", "map", "map_frame", "the map's frame"),
        used("odom_frame", "odom", "odom_frame", "odometry's frame"),
        used("map_update_interval", 5.0, "map_period_s", "between two maps", 0.0, "s"),
        used("maxUrange", 80.0, "max_range_m", "longest beams that count, at most 30", 0.1, "m"),
        used("maxRange", 1e9, "range_limit_m", "ranges from there on say nothing", 0.0, "m"),
        used("throttle_scans", 1, "throttle", "every so many-th scan is used", 1),
        used("linearUpdate", 1.0, "keyframe_m", "a scan is kept after so long a way", 0.0, "m"),
        used("angularUpdate", 0.5, "keyframe_rad", "or after such a turn", 0.0, "rad"),
        used("transform_publish_period", 0.05, "tf_period_s", "between two transforms", 0.0, "s"),
        used("tf_delay", 0.05, "tf_ahead_s", "transforms are dated so far ahead", 0.0, "s"),
        used("delta", 0.05, "resolution_m", "side of a cell of the map", 0.001, "m"),
        used("occ_thresh", 0.25, "occupied_share", "share of beams that end in a cell", 0.0),
        used("srr", 0.1, "odometry_m_per_m", "odometry's error of a way, per way", 0.0),
        used("stt", 0.2, "odometry_rad_per_rad", "of a turn, per turn", 0.0),
        used("str", 0.1, "odometry_rad_per_m", "of the heading, per way", 0.0, "rad/m"),
    ),
    (
        *refused(_NO_PARTICLES, "particles", "resampleThreshold", "llsamplerange",
                 "llsamplestep", "lasamplerange", "lasamplestep", "temporalUpdate"),
        *refused(_OWN_MATCHER, "sigma", "kernelSize", "lstep", "astep", "iterations", "lsigma",
                 "ogain", "lskip", "minimumScore", "srt"),
        *refused(_GROWS, "xmin", "ymin", "xmax", "ymax"),
        *refused("the scan's frame tells how the lidar is mounted", "inverted_laser"),
    ),
)  # fmt: skip

_KARTO = _slam_node(
    "slam_karto",
    ("slam_karto/slam_karto",),
    (
        *_KARTO_USES,
        used("base_frame", "base_link", "base_frame", "the robot's frame"),
        used("minimum_travel_distance", 0.2, "keyframe_m", "a scan is kept after it", 0.0, "m"),
        used("minimum_travel_heading", 0.174, "keyframe_rad", "or after it", 0.0, "rad"),
    ),
    _KARTO_IDLE,
)

_HECTOR = _slam_node(
    "hector_mapping",
    ("hector_mapping/hector_mapping",),
    (
        used("base_frame", "base_link", "base_frame", "the robot's frame"),
        used("map_frame", "map_link", "map_frame", "the map's frame"),
        used("odom_frame", "odom", "odom_frame", "odometry's frame"),
        used("scan_topic", "scan", "scan_topic", "of the lidar"),
        used("map_resolution", 0.025, "resolution_m", "side of a cell of the map", 0.001, "m"),
        used("map_pub_period", 2.0, "map_period_s", "between two maps", 0.0, "s"),
        used("map_update_distance_thresh", 0.4, "keyframe_m", "a scan is kept after it", 0.0, "m"),
        used("map_update_angle_thresh", 0.9, "keyframe_rad", "or after it", 0.0, "rad"),
        used("laser_max_dist", 30.0, "range_limit_m", "ranges from there on say nothing", 0.0, "m"),
        used("pub_map_odom_transform", True, "publishes_tf", "whether the transform is sent"),
    ),
    (
        *refused(_GROWS, "map_size", "map_start_x", "map_start_y", "map_multi_res_levels"),
        *refused(_OWN_MATCHER, "use_tf_scan_transformation", "use_tf_pose_start_estimate",
                 "update_factor_free", "update_factor_occupied", "laser_z_min_value",
                 "laser_z_max_value", "laser_min_dist", "scan_subscriber_queue_size"),
        *refused(_SHOWS, "pub_map_scanmatch_transform", "tf_map_scanmatch_transform_frame_name",
                 "output_timing", "pub_drawings", "pub_debug_output", "pub_odometry",
                 "advertise_map_service"),
    ),
)  # fmt: skip

_TOOLBOX = _slam_node(
    "slam_toolbox",
    tuple(
        f"slam_toolbox/{name}_slam_toolbox_node"
        for name in ("sync", "async", "localization", "lifelong")
    ),
    (
        *_KARTO_USES,
        used("base_frame", "base_footprint", "base_frame", "the robot's frame"),
        used("scan_topic", "/scan", "scan_topic", "of the lidar"),
        used("mode", "mapping", "mode", "mapping or localization"),
        used("max_laser_range", 20.0, "max_range_m", "longest beams, at most 30", 0.1, "m"),
        used("minimum_travel_distance", 0.5, "keyframe_m", "a scan is kept after it", 0.0, "m"),
        used("minimum_travel_heading", 0.5, "keyframe_rad", "or after it", 0.0, "rad"),
        used("minimum_time_interval", 0.5, "least_interval_s", "between two scans", 0.0, "s"),
        used("transform_timeout", 0.2, "tf_ahead_s", "transforms are dated so far ahead", 0.0, "s"),
        used("map_file_name", "", "map_file", "graph of poses to begin with"),
        used("map_start_pose", [], "start_pose", "where the robot is in it: x, y, yaw"),
    ),
    (
        *_KARTO_IDLE,
        *refused(_OWN_SOLVER, "solver_plugin", "ceres_linear_solver", "ceres_preconditioner",
                 "ceres_trust_strategy", "ceres_dogleg_type", "ceres_loss_function"),
        *refused("no graph is drawn for editing", "enable_interactive_mode",
                 "interactive_mode", "debug_logging"),
        *refused("tf is kept as long as scans wait", "tf_buffer_duration", "stack_size_to_use"),
        *refused("the robot begins where map_start_pose says", "map_start_at_dock"),
        *refused("save_map is always offered", "use_map_saver"),
        *refused(_OWN_MATCHER, "min_laser_range", "min_pass_through", "occupancy_threshold",
                 "scan_queue_size", "lifelong_search_use_tree",
                 "lifelong_minimum_score", "lifelong_iou_match", "lifelong_node_removal_score",
                 "lifelong_overlap_score_scale", "lifelong_constraint_multiplier",
                 "lifelong_nearby_penalty", "lifelong_candidates_scale",
                 "position_covariance_scale", "yaw_covariance_scale",
                 "check_min_dist_and_heading_precisely",
                 "restamp_tf", "use_lifecycle_manager"),
    ),
    services=True,
)  # fmt: skip

_CARTOGRAPHER = _slam_node(
    "cartographer",
    ("cartographer_ros/cartographer_node",),
    (
        used("tracking_frame", "base_link", "base_frame", "the robot's frame"),
        used("published_frame", "odom", "odom_frame", "child of the map's frame"),
        used("map_frame", "map", "map_frame", "the map's frame"),
        used("max_range", 30.0, "max_range_m", "longest beams that count, at most 30", 0.1, "m"),
        used("resolution", 0.05, "resolution_m", "side of a cell of the map", 0.001, "m"),
        used("submap_publish_period_sec", 0.3, "map_period_s", "between two maps", 0.0, "s"),
        used("publish_to_tf", True, "publishes_tf", "whether the transform is sent"),
        used("pose_publish_period_sec", 5e-3, "tf_period_s", "between two transforms", 0.0, "s"),
    ),
    (
        *refused(
            _OWN_MATCHER, "TRAJECTORY_BUILDER_2D", "TRAJECTORY_BUILDER", "use_pose_extrapolator"
        ),
        *refused(_OWN_SOLVER, "POSE_GRAPH", "MAP_BUILDER"),
        *refused(
            "odometry comes by tf from published_frame to tracking_frame; without any, let "
            "both be the robot's frame",
            "use_odometry",
            "provide_odom_frame",
            "odom_frame",
        ),
        *refused(
            "one lidar in the plane is used, on the topic scan",
            "use_nav_sat",
            "use_landmarks",
            "num_laser_scans",
            "num_multi_echo_laser_scans",
            "num_subdivisions_per_laser_scan",
            "num_point_clouds",
        ),
        *refused(
            "every scan is used as soon as tf knows where it was taken",
            "lookup_transform_timeout_sec",
            "rangefinder_sampling_ratio",
            "odometry_sampling_ratio",
            "fixed_frame_pose_sampling_ratio",
            "imu_sampling_ratio",
            "landmarks_sampling_ratio",
        ),
        *refused("the transform lies in the plane always", "publish_frame_projected_to_2d"),
        *refused(_SHOWS, "trajectory_publish_period_sec", "publish_tracked_pose"),
    ),
    replace(_DEFAULTS, map_period_s=1.0),
)

SLAM_NODES = {
    "gmapping": _GMAPPING,
    "slam_karto": _KARTO,
    "hector_mapping": _HECTOR,
    "slam_toolbox": _TOOLBOX,
    "cartographer": _CARTOGRAPHER,
}
"""By family."""
GMAPPING = _GMAPPING.table
KARTO = _KARTO.table
HECTOR = _HECTOR.table
TOOLBOX = _TOOLBOX.table
CARTOGRAPHER = _CARTOGRAPHER.table
