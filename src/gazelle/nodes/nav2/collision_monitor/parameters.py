"""The parameters of ``collision_monitor``."""

from __future__ import annotations

import math

from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["BAND", "COLLISION_MONITOR", "SOURCE", "ZONE"]

COLLISION_MONITOR = ParameterTable(
    "collision_monitor",
    "Slows or stops velocity commands by what sensors see close to the robot.",
    ("nav2_collision_monitor/collision_monitor",),
    (
        Parameter("cmd_vel_in_topic", "text", "cmd_vel_smoothed", "topic of commands"),
        Parameter("cmd_vel_out_topic", "text", "cmd_vel", "topic of what is left of them"),
        Parameter("state_topic", "text", "",
                  "topic of nav2_msgs/CollisionMonitorState; none when empty"),
        Parameter("base_frame_id", "text", "base_footprint", "frame of the robot"),
        Parameter("odom_frame_id", "text", "odom", "frame in which the robot's motion is known"),
        Parameter("transform_tolerance", "number", 0.1, "age of transforms that is tolerated", "s",
                  0),
        Parameter("source_timeout", "number", 2.0,
                  "older data stops the robot; 0: they are left out",
            "s", 0),
        Parameter("base_shift_correction", "flag", True,
                  "move points by the robot's way since they "
            "were seen"),
        Parameter("stop_pub_timeout", "number", 1.0, "how long zero is sent to a robot that stands",
            "s", 0),
        Parameter("polygons", "words", (), "names of zones"),
        Parameter("observation_sources", "words", (), "names of sensors"),
        Parameter("enable_stamped_cmd_vel", "flag", False, "TwistStamped in place of Twist"),
        *refused("threads have the priority of the process", "use_realtime_priority"),
        *refused("nodes that end are seen by the graph itself", "bond_timeout",
                 "bond_heartbeat_period"),
        *refused("services have one queue", "service_introspection_mode", "introspection_mode"),
    ),
)  # fmt: skip

ZONE = ParameterTable(
    "zone of collision_monitor",
    "An area around the robot and what happens when something is in it.",
    (),
    (
        Parameter("type", "text", "", "polygon, circle or velocity_polygon"),
        Parameter("action_type", "text", "", "stop, slowdown, limit, approach or none"),
        Parameter("enabled", "flag", True, "whether it counts", live=True),
        Parameter("points", "any", None,
                  "corners: '[[x1, y1], [x2, y2], …]', or a flat list (Humble)",
            "m"),
        Parameter("radius", "number", 0.0, "of a circle", "m", 0),
        Parameter("min_points", "integer", 4, "so many points in it count as something", "", 1),
        Parameter("max_points", "integer", 3, "the same, one less (Humble)", "", 0),
        Parameter("slowdown_ratio", "number", 0.5, "share of the speed that slowdown leaves", "",
                  0, 1),
        Parameter("linear_limit", "number", 0.5, "speed that limit leaves", "m/s", 0),
        Parameter("angular_limit", "number", 0.5, "turn that limit leaves", "rad/s", 0),
        Parameter("time_before_collision", "number", 2.0, "how far approach looks ahead", "s",
                  0.001),
        Parameter("simulation_time_step", "number", 0.1, "and how finely", "s", 0.001),
        Parameter("footprint_topic", "text", "local_costmap/published_footprint",
                  "outline of approach"),
        Parameter("polygon_sub_topic", "text", "", "topic of an outline in place of points"),
        Parameter("polygon_subscribe_transient_local", "flag", False,
                  "that topic's last message counts"),
        Parameter("visualize", "flag", False, "publish the outline"),
        Parameter("polygon_pub_topic", "text", "", "on this topic, the zone's name when empty"),
        Parameter("sources_names", "words", (), "sensors that count, all when empty"),
        Parameter("velocity_polygons", "words", (), "names of outlines by command"),
        Parameter("holonomic", "flag", False,
                  "outlines go by the amount and direction of the speed"),
    ),
)  # fmt: skip

BAND = ParameterTable(
    "outline of a velocity_polygon",
    "The outline of a zone for a range of commands; the first that fits counts.",
    (),
    (
        Parameter("points", "any", None, "corners: '[[x1, y1], [x2, y2], …]'", "m"),
        Parameter("linear_min", "number", 0.0, "least speed", "m/s"),
        Parameter("linear_max", "number", 0.0, "most speed", "m/s"),
        Parameter("theta_min", "number", 0.0, "least turn", "rad/s"),
        Parameter("theta_max", "number", 0.0, "most turn", "rad/s"),
        Parameter("direction_start_angle", "number", -math.pi, "first direction of travel", "rad"),
        Parameter("direction_end_angle", "number", math.pi, "last direction of travel", "rad"),
    ),
)

SOURCE = ParameterTable(
    "sensor of collision_monitor",
    "What sees the points that zones count.",
    (),
    (
        Parameter("type", "text", "scan", "scan, pointcloud, range or polygon"),
        Parameter("topic", "text", "scan", "its topic"),
        Parameter("enabled", "flag", True, "whether it counts", live=True),
        Parameter("source_timeout", "number", 2.0, "that of the node for this sensor", "s", 0),
        Parameter("min_height", "number", 0.05, "lower points of a cloud are left out", "m"),
        Parameter("max_height", "number", 0.5, "and higher ones", "m"),
        Parameter("min_range", "number", 0.0, "and points of a cloud nearer to the sensor", "m", 0),
        Parameter("obstacles_angle", "number", math.pi / 180, "between points of a range's cone",
                  "rad",
            1e-4),
        Parameter("sampling_distance", "number", 0.1, "between points of a polygon's edges", "m",
                  1e-3),
        *refused("heights are those in the robot's frame", "use_global_height"),
    ),
)  # fmt: skip
