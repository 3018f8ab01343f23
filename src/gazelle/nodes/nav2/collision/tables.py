"""The parameters of ``collision_monitor``."""

from __future__ import annotations

import math

from gazelle.nodes.navigation.table import Row, Table, refused

__all__ = ["BAND", "COLLISION_MONITOR", "SOURCE", "ZONE"]

COLLISION_MONITOR = Table(
    "collision_monitor",
    "Slows or stops velocity commands by what sensors see close to the robot.",
    ("nav2_collision_monitor/collision_monitor",),
    (
        Row("cmd_vel_in_topic", "text", "cmd_vel_smoothed", "topic of commands"),
        Row("cmd_vel_out_topic", "text", "cmd_vel", "topic of what is left of them"),
        Row("state_topic", "text", "", "topic of nav2_msgs/CollisionMonitorState; none when empty"),
        Row("base_frame_id", "text", "base_footprint", "frame of the robot"),
        Row("odom_frame_id", "text", "odom", "frame in which the robot's motion is known"),
        Row("transform_tolerance", "number", 0.1, "age of transforms that is tolerated", "s", 0),
        Row("source_timeout", "number", 2.0, "older data stops the robot; 0: they are left out",
            "s", 0),
        Row("base_shift_correction", "flag", True, "move points by the robot's way since they "
            "were seen"),
        Row("stop_pub_timeout", "number", 1.0, "how long zero is sent to a robot that stands",
            "s", 0),
        Row("polygons", "texts", (), "names of zones"),
        Row("observation_sources", "texts", (), "names of sensors"),
        Row("enable_stamped_cmd_vel", "flag", False, "TwistStamped in place of Twist"),
        *refused("threads have the priority of the process", "use_realtime_priority"),
        *refused("nodes that end are seen by the graph itself", "bond_timeout",
                 "bond_heartbeat_period"),
        *refused("services have one queue", "service_introspection_mode", "introspection_mode"),
    ),
)  # fmt: skip

ZONE = Table(
    "zone of collision_monitor",
    "An area around the robot and what happens when something is in it.",
    (),
    (
        Row("type", "text", "", "polygon, circle or velocity_polygon"),
        Row("action_type", "text", "", "stop, slowdown, limit, approach or none"),
        Row("enabled", "flag", True, "whether it counts", live=True),
        Row("points", "any", None, "corners: '[[x1, y1], [x2, y2], …]', or a flat list (Humble)",
            "m"),
        Row("radius", "number", 0.0, "of a circle", "m", 0),
        Row("min_points", "integer", 4, "so many points in it count as something", "", 1),
        Row("max_points", "integer", 3, "the same, one less (Humble)", "", 0),
        Row("slowdown_ratio", "number", 0.5, "share of the speed that slowdown leaves", "", 0, 1),
        Row("linear_limit", "number", 0.5, "speed that limit leaves", "m/s", 0),
        Row("angular_limit", "number", 0.5, "turn that limit leaves", "rad/s", 0),
        Row("time_before_collision", "number", 2.0, "how far approach looks ahead", "s", 0.001),
        Row("simulation_time_step", "number", 0.1, "and how finely", "s", 0.001),
        Row("footprint_topic", "text", "local_costmap/published_footprint", "outline of approach"),
        Row("polygon_sub_topic", "text", "", "topic of an outline in place of points"),
        Row("polygon_subscribe_transient_local", "flag", False, "that topic's last message counts"),
        Row("visualize", "flag", False, "publish the outline"),
        Row("polygon_pub_topic", "text", "", "on this topic, the zone's name when empty"),
        Row("sources_names", "texts", (), "sensors that count, all when empty"),
        Row("velocity_polygons", "texts", (), "names of outlines by command"),
        Row("holonomic", "flag", False, "outlines go by the amount and direction of the speed"),
    ),
)  # fmt: skip

BAND = Table(
    "outline of a velocity_polygon",
    "The outline of a zone for a range of commands; the first that fits counts.",
    (),
    (
        Row("points", "any", None, "corners: '[[x1, y1], [x2, y2], …]'", "m"),
        Row("linear_min", "number", 0.0, "least speed", "m/s"),
        Row("linear_max", "number", 0.0, "most speed", "m/s"),
        Row("theta_min", "number", 0.0, "least turn", "rad/s"),
        Row("theta_max", "number", 0.0, "most turn", "rad/s"),
        Row("direction_start_angle", "number", -math.pi, "first direction of travel", "rad"),
        Row("direction_end_angle", "number", math.pi, "last direction of travel", "rad"),
    ),
)

SOURCE = Table(
    "sensor of collision_monitor",
    "What sees the points that zones count.",
    (),
    (
        Row("type", "text", "scan", "scan, pointcloud, range or polygon"),
        Row("topic", "text", "scan", "its topic"),
        Row("enabled", "flag", True, "whether it counts", live=True),
        Row("source_timeout", "number", 2.0, "that of the node for this sensor", "s", 0),
        Row("min_height", "number", 0.05, "lower points of a cloud are left out", "m"),
        Row("max_height", "number", 0.5, "and higher ones", "m"),
        Row("min_range", "number", 0.0, "and points of a cloud nearer to the sensor", "m", 0),
        Row("obstacles_angle", "number", math.pi / 180, "between points of a range's cone", "rad",
            1e-4),
        Row("sampling_distance", "number", 0.1, "between points of a polygon's edges", "m", 1e-3),
        *refused("heights are those in the robot's frame", "use_global_height"),
    ),
)  # fmt: skip
