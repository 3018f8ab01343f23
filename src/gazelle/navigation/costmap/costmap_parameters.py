"""Parameters of ``costmap_2d`` and ``nav2_costmap_2d``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from gazelle.parameters.dataclass_tables import flag, integer, number, text, texts

__all__ = [
    "LAYER_TYPES",
    "REFUSED_LAYERS",
    "CostmapOptions",
    "InflationOptions",
    "ObstacleOptions",
    "SourceOptions",
    "StaticOptions",
    "VoxelOptions",
]

_ENABLED = "whether the layer does anything"


@dataclass(frozen=True, slots=True)
class CostmapOptions:
    """A costmap as a whole."""

    global_frame: str = text("map", "frame of the costmap")
    robot_base_frame: str = text("base_link", "frame of the robot")
    transform_tolerance: float = number(
        0.3,
        "age of the robot's pose that is tolerated; Nav2 tells of older ones and uses them",
        "s",
        0,
    )
    update_frequency: float = number(5.0, "how often the costmap is updated", "Hz", 0)
    publish_frequency: float = number(0.0, "how often it is published, 0 for never", "Hz", 0)
    rolling_window: bool = flag(False, "the costmap moves along with the robot")
    always_send_full_costmap: bool = flag(False, "publish all of it, not what changed")
    width: float = number(10.0, "width of a costmap without a static map", "m", 0)
    height: float = number(10.0, "height of a costmap without a static map", "m", 0)
    resolution: float = number(0.05, "side of a cell of a costmap without a static map", "m", 1e-3)
    origin_x: float = number(0.0, "x of the lower left corner", "m")
    origin_y: float = number(0.0, "y of the lower left corner", "m")
    track_unknown_space: bool = flag(False, "what nobody has seen is unknown, else free")
    footprint: str = text("[]", "outline of the robot, [[x, y], …], m")
    robot_radius: float = number(0.46, "radius of a round robot without a footprint", "m", 0)
    footprint_padding: float = number(0.01, "added to the outline", "m")
    footprint_topic: str = text("footprint", "topic that gives another outline")
    plugins: tuple[str, ...] = texts((), "layers, in the order in which they write")

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {
        "width": 5.0,
        "height": 5.0,
        "resolution": 0.1,
        "robot_radius": 0.1,
        "publish_frequency": 1.0,
        "plugins": ("static_layer", "obstacle_layer", "inflation_layer"),
    }
    IDLE: ClassVar[Mapping[str, str]] = {
        "filters": "costmap filters (keep-out, speed) are not there; draw walls into the map",
        "initial_transform_timeout": "a costmap waits for its transforms as long as it takes, "
        "and says which one is missing",
        "map_vis_z": "the picture of a costmap lies on the ground",
        "published_footprint_topic": "the outline is published as 'footprint'",
        "oriented_footprint_topic": "the outline is published as 'footprint'",
        "map_type": "layers say themselves whether they are costmap or voxel",
        "restart_timeout": "costmaps are updated at their rate from the first transform on",
    }


@dataclass(frozen=True, slots=True)
class StaticOptions:
    """A layer that is a map."""

    enabled: bool = flag(True, _ENABLED)
    map_topic: str = text("map", "topic of the map")
    first_map_only: bool = flag(False, "maps after the first one are not looked at")
    subscribe_to_updates: bool = flag(False, "also listen to MAP_updates")
    track_unknown_space: bool = flag(True, "unknown cells of the map stay unknown, else free")
    use_maximum: bool = flag(False, "raise costs of layers before, else replace them")
    lethal_cost_threshold: int = integer(100, "occupancy from which on a cell is lethal", 0, 100)
    unknown_cost_value: int = integer(-1, "value of unknown cells in the map", -1, 255)
    trinary_costmap: bool = flag(True, "cells are free, lethal or unknown, nothing between")
    footprint_clearing_enabled: bool = flag(False, "cells under the robot are free (Nav2)")

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {"track_unknown_space": False}
    IDLE: ClassVar[Mapping[str, str]] = {
        "map_subscribe_transient_local": "a map that was published before arrives in either case",
        "transform_tolerance": "the costmap's own transform_tolerance counts",
        "restore_footprint": "cells under the robot are the map's again when it has gone on",
    }


@dataclass(frozen=True, slots=True)
class SourceOptions:
    """A sensor of an obstacle layer."""

    topic: str = text("", "topic; the source's name when empty")
    sensor_frame: str = text("", "frame of the sensor; that of the messages when empty")
    data_type: str = text("LaserScan", "LaserScan, PointCloud or PointCloud2")
    observation_persistence: float = number(0.0, "how long it counts; 0 for the last one", "s", 0)
    expected_update_rate: float = number(0.0, "longest time between two; 0 for any", "s", 0)
    min_obstacle_height: float = number(0.0, "lowest point that counts", "m")
    max_obstacle_height: float = number(2.0, "highest point that counts", "m")
    inf_is_valid: bool = flag(False, "beams of infinite range clear")
    marking: bool = flag(True, "points are obstacles")
    clearing: bool = flag(False, "the way to points is free")
    obstacle_range: float = number(2.5, "farthest point that is an obstacle", "m", 0,
                                   aliases=("obstacle_max_range",))  # fmt: skip
    obstacle_min_range: float = number(0.0, "nearest point that is an obstacle", "m", 0)
    raytrace_range: float = number(3.0, "how far is cleared", "m", 0,
                                   aliases=("raytrace_max_range",))  # fmt: skip
    raytrace_min_range: float = number(0.0, "from where on is cleared", "m", 0)

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {"max_obstacle_height": 0.0}
    IDLE: ClassVar[Mapping[str, str]] = {
        "transport_type": "point clouds arrive uncompressed",
    }


@dataclass(frozen=True, slots=True)
class ObstacleOptions:
    """A layer of what sensors see."""

    enabled: bool = flag(True, _ENABLED)
    observation_sources: str = text("", "names of the sensors, with spaces between")
    footprint_clearing_enabled: bool = flag(True, "there is nothing under the robot")
    min_obstacle_height: float = number(0.0, "lowest point that counts", "m")
    max_obstacle_height: float = number(2.0, "highest point that counts", "m", 0)
    combination_method: int = integer(1, "0 replaces costs of layers before, 1 raises them, 2 "
                                      "raises only what is known", 0, 2)  # fmt: skip
    obstacle_range: float = number(2.5, "of sensors that do not say", "m", 0)
    raytrace_range: float = number(3.0, "of sensors that do not say", "m", 0)
    track_unknown_space: bool = flag(False, "of the costmap by default")

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {}
    IDLE: ClassVar[Mapping[str, str]] = {
        "tf_message_filter_tolerance": "messages wait for their transform until 50 wait",
    }


@dataclass(frozen=True, slots=True)
class VoxelOptions(ObstacleOptions):
    """A layer of what sensors see in three dimensions; its columns are seen from above."""

    origin_z: float = number(0.0, "height of the lowest voxel", "m")
    z_resolution: float = number(0.2, "height of a voxel", "m", 0)
    z_voxels: int = integer(10, "voxels in a column; what is higher than all of them does not "
                            "count", 0, 32)  # fmt: skip

    IDLE: ClassVar[Mapping[str, str]] = {
        **ObstacleOptions.IDLE,
        "unknown_threshold": "columns are kept flat: a cell is marked or it is not",
        "mark_threshold": "columns are kept flat: one voxel marks a cell",
        "publish_voxel_map": "columns are kept flat, there is no voxel map",
    }


@dataclass(frozen=True, slots=True)
class InflationOptions:
    """A layer that raises costs near what is lethal."""

    enabled: bool = flag(True, _ENABLED)
    inflation_radius: float = number(0.55, "how far costs are raised", "m", 0)
    cost_scaling_factor: float = number(10.0, "how fast they fall with distance", "1/m", 0)
    inflate_unknown: bool = flag(False, "also raise costs of unknown cells")
    inflate_around_unknown: bool = flag(False, "also inflate what is unknown (Nav2)")

    NAV2_DEFAULTS: ClassVar[Mapping[str, Any]] = {}
    IDLE: ClassVar[Mapping[str, str]] = {}


LAYER_TYPES: Mapping[str, type] = {
    f"{prefix}{name}": kind
    for prefix in ("costmap_2d::", "costmap_2d/", "nav2_costmap_2d::", "nav2_costmap_2d/")
    for name, kind in (
        ("StaticLayer", StaticOptions),
        ("ObstacleLayer", ObstacleOptions),
        ("VoxelLayer", VoxelOptions),
        ("InflationLayer", InflationOptions),
    )
}
"""Options by the name of a layer's type in parameter files."""

REFUSED_LAYERS: Mapping[str, str] = {
    "range_sensor_layer::RangeSensorLayer": "sonar layers are not there; use a LaserScan source",
    "nav2_costmap_2d::RangeSensorLayer": "sonar layers are not there; use a LaserScan source",
    "nav2_costmap_2d::DenoiseLayer": "single cells of noise stay; scans of the simulator have none",
    "nav2_costmap_2d::KeepoutFilter": "costmap filters are not there; draw walls into the map",
    "nav2_costmap_2d::SpeedFilter": "costmap filters are not there; set /speed_limit instead",
    "nav2_costmap_2d::BinaryFilter": "costmap filters are not there",
    "nav2_costmap_2d::PluginContainerLayer": "layers of layers are not there; list them in plugins",
    "social_navigation_layers::ProxemicLayer": "it is a package of its own, compiled",
    "spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer": "it is a package of its own, "
    "compiled; costmap_2d's VoxelLayer takes the same sensors",
}
"""Why a layer's type is not there."""
