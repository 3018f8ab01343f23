"""The parameters of ``collision_monitor``: polygons and sensors, all that is wrong told at once."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from gazelle.diagnostics import did_you_mean
from gazelle.navigation.costmap import Footprint
from gazelle.nodes.nav2.collision_monitor.polygons import Action, Points, Polygon, SubPolygon
from gazelle.nodes.nav2.collision_monitor.sources import SOURCE_TYPES, SourceOptions
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader

__all__ = [
    "COLLISION_MONITOR",
    "POLYGON",
    "SOURCE",
    "SUB_POLYGON",
    "read_polygons",
    "read_sources",
    "report_others",
]


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

POLYGON = ParameterTable(
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

SUB_POLYGON = ParameterTable(
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
_ACTIONS = {one.name.lower(): one for one in Action}
_SHAPES = ("polygon", "circle", "velocity_polygon")


def read_polygons(settings: ParameterReader) -> list[tuple[Polygon, ParameterReader]]:
    """Return the zones of ``polygons`` with their settings; wrong ones are reported and left out.

    A polygon that a topic gives has no outline yet.
    """
    found = []
    for name, own in _below(settings, "polygons", POLYGON):
        polygon = _polygon(name, own)
        own.report_unknown(*own.texts("velocity_polygons"))
        if polygon is not None:
            found.append((polygon, own))
    return found


def read_sources(settings: ParameterReader) -> list[SourceOptions]:
    """Return the sensors of ``observation_sources``; wrong ones are reported and left out."""
    found = []
    for name, own in _below(settings, "observation_sources", SOURCE):
        kind = own.text("type")
        own.report_unknown()
        if kind not in SOURCE_TYPES:
            text = f"sensor '{name}' is of type '{kind}'; there are {', '.join(SOURCE_TYPES)}"
            hint = did_you_mean(kind, SOURCE_TYPES)
            own.report("navigation.unknown-plugin", f"{text}. It is left out", hint)
            continue
        timeout_s = own.number("source_timeout", settings.number("source_timeout"))
        number = own.number
        found.append(
            SourceOptions(
                name, kind, own.text("topic"), timeout_s, own.flag("enabled"),
                (number("min_height"), number("max_height")), number("min_range"),
                number("obstacles_angle"), number("sampling_distance"),
            )
        )  # fmt: skip
    return found


def report_others(settings: ParameterReader) -> None:
    """Tell of parameters of the node that are not known, and of zones that nobody names."""
    named = {*settings.texts("polygons"), *settings.texts("observation_sources")}
    idle = [
        name
        for name, below in settings.tree.items()
        if isinstance(below, Mapping) and "type" in below and name not in named
    ]
    for name in idle:
        text = f"'{name}' has parameters and is not one of polygons or observation_sources"
        settings.report("parameter.idle", text, "add it, or leave it out")
    settings.report_unknown(*named, *idle)


def _below(
    settings: ParameterReader, key: str, table: ParameterTable
) -> Iterator[tuple[str, ParameterReader]]:
    for name in settings.texts(key):
        below = settings.tree.get(name)
        tree = below if isinstance(below, Mapping) else {}
        yield name, settings.with_table(table, tree, name)


def _polygon(name: str, own: ParameterReader) -> Polygon | None:
    shape, word = own.text("type"), own.text("action_type")
    for what, given, known in (("type", shape, _SHAPES), ("action_type", word, _ACTIONS)):
        if given not in known:
            text = f"parameter '{what}' is '{given}'; there are {', '.join(known)}"
            hint = did_you_mean(given, known)
            own.report("parameter.bad-value", f"{text}. The zone is left out", hint)
            return None
    least = own.integer("min_points")
    if own.has("max_points") and not own.has("min_points"):
        least = own.integer("max_points") + 1
    polygon = Polygon(
        name, _ACTIONS[word], least=least, ratio=own.number("slowdown_ratio"),
        limits=(own.number("linear_limit"), own.number("angular_limit")),
        horizon_s=own.number("time_before_collision"), step_s=own.number("simulation_time_step"),
        sources=own.texts("sources_names"), enabled=own.flag("enabled"),
    )  # fmt: skip
    if shape == "circle":
        polygon.radius_m = own.number("radius")
        return polygon
    if shape == "velocity_polygon":
        polygon.sub_polygons = tuple(_sub_polygons(own))
        return polygon
    if own.has("points"):
        polygon.outline = _outline(own)
        return None if polygon.outline is None else polygon
    if not own.text("polygon_sub_topic") and polygon.action is not Action.APPROACH:
        text = "neither 'points' nor 'polygon_sub_topic' is given; the zone is left out"
        own.report("parameter.bad-value", text, "write points: '[[x1, y1], [x2, y2], [x3, y3]]'")
        return None
    return polygon


def _sub_polygons(own: ParameterReader) -> Iterator[SubPolygon]:
    for _, below in _below(own, "velocity_polygons", SUB_POLYGON):
        outline, number = _outline(below), below.number
        below.report_unknown()
        if outline is not None:
            yield SubPolygon(
                outline,
                (number("linear_min"), number("linear_max")),
                (number("theta_min"), number("theta_max")),
                (number("direction_start_angle"), number("direction_end_angle")),
                own.flag("holonomic"),
            )


def _outline(own: ParameterReader) -> Points | None:
    value: Any = own.raw("points")
    if isinstance(value, list | tuple) and value and not isinstance(value[0], list | tuple):
        # Humble has x and y one after the other.
        value = [list(value[at : at + 2]) for at in range(0, len(value), 2)]
    try:
        return np.array(Footprint.parse(value).corners, float)
    except ValueError as error:
        fix = "write points: '[[x1, y1], [x2, y2], [x3, y3]]'"
        own.report("parameter.bad-value", f"parameter 'points': {error}; it is left out", fix)
        return None
