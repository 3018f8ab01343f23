"""Zones and sensors from parameters; what is wrong with them is told all at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from gazelle.diagnostics import did_you_mean
from gazelle.navigation.costmap import Footprint
from gazelle.nodes.nav2.collision_monitor.parameters import BAND, SOURCE, ZONE
from gazelle.nodes.nav2.collision_monitor.polygons import Action, Band, Points, Zone
from gazelle.nodes.nav2.collision_monitor.sources import SOURCE_TYPES, SourceOptions
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["read_sources", "read_zones", "report_others"]

_ACTIONS = {one.name.lower(): one for one in Action}
_SHAPES = ("polygon", "circle", "velocity_polygon")


def read_zones(settings: ParameterReader) -> list[tuple[Zone, ParameterReader]]:
    """Return the zones of ``polygons`` with their settings; wrong ones are reported and left out.

    A polygon that a topic gives has no outline yet.
    """
    found = []
    for name, own in _below(settings, "polygons", ZONE):
        zone = _zone(name, own)
        own.report_unknown(*own.texts("velocity_polygons"))
        if zone is not None:
            found.append((zone, own))
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


def _zone(name: str, own: ParameterReader) -> Zone | None:
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
    zone = Zone(
        name, _ACTIONS[word], least=least, ratio=own.number("slowdown_ratio"),
        limits=(own.number("linear_limit"), own.number("angular_limit")),
        horizon_s=own.number("time_before_collision"), step_s=own.number("simulation_time_step"),
        sources=own.texts("sources_names"), enabled=own.flag("enabled"),
    )  # fmt: skip
    if shape == "circle":
        zone.radius_m = own.number("radius")
        return zone
    if shape == "velocity_polygon":
        zone.bands = tuple(_bands(own))
        return zone
    if own.has("points"):
        zone.outline = _outline(own)
        return None if zone.outline is None else zone
    if not own.text("polygon_sub_topic") and zone.action is not Action.APPROACH:
        text = "neither 'points' nor 'polygon_sub_topic' is given; the zone is left out"
        own.report("parameter.bad-value", text, "write points: '[[x1, y1], [x2, y2], [x3, y3]]'")
        return None
    return zone


def _bands(own: ParameterReader) -> Iterator[Band]:
    for _, below in _below(own, "velocity_polygons", BAND):
        outline, number = _outline(below), below.number
        below.report_unknown()
        if outline is not None:
            yield Band(
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
