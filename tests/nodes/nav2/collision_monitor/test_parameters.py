"""Zones and sensors from parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.nav2.collision_monitor.parameters import (
    COLLISION_MONITOR,
    read_polygons,
    read_sources,
)
from gazelle.nodes.nav2.collision_monitor.polygons import Action
from gazelle.nodes.parameters import node_reader
from gazelle.parameters.reader import ParameterReader

_CIRCLE = {"type": "circle", "action_type": "stop", "radius": 0.3}


def _settings(**values: Any) -> tuple[ParameterReader, Diagnostics]:
    diagnostics = Diagnostics()
    return node_reader(COLLISION_MONITOR, values, "/collision_monitor", diagnostics), diagnostics


def _said(diagnostics: Diagnostics) -> str:
    return "\n".join(map(str, diagnostics))


@pytest.mark.parametrize(
    "points",
    ["[[0.3, 0.2], [0.3, -0.2], [-0.3, 0.0]]", [0.3, 0.2, 0.3, -0.2, -0.3, 0.0]],
    ids=["Iron and later", "Humble"],
)
def test_points_of_both_forms(points: Any) -> None:
    polygon = {"type": "polygon", "action_type": "slowdown", "points": points}
    settings, diagnostics = _settings(polygons=["slow"], slow=polygon)
    ((found, _),) = read_polygons(settings)
    assert not list(diagnostics)
    assert found.outline is not None
    np.testing.assert_array_equal(found.outline, [[0.3, 0.2], [0.3, -0.2], [-0.3, 0.0]])
    assert (found.action, found.ratio, found.least) == (Action.SLOWDOWN, 0.5, 4)


def test_max_points_of_humble_is_one_less_than_min_points() -> None:
    settings, _ = _settings(polygons=["stop"], stop={**_CIRCLE, "max_points": 7})
    assert read_polygons(settings)[0][0].least == 8


def test_bands_are_read_in_their_order() -> None:
    box = "[[0.3, 0.3], [0.3, -0.3], [-0.3, -0.3], [-0.3, 0.3]]"
    limits = {"linear_min": 0.0, "linear_max": 1.0, "theta_min": -1.0, "theta_max": 1.0}
    polygon = {
        "type": "velocity_polygon", "action_type": "stop", "holonomic": False,
        "velocity_polygons": ["on", "back"], "on": {"points": box, **limits},
        "back": {"points": box, **limits, "linear_min": -1.0, "linear_max": 0.0},
    }  # fmt: skip
    settings, diagnostics = _settings(polygons=["v"], v=polygon)
    sub_polygons = read_polygons(settings)[0][0].sub_polygons
    assert [sub_polygon.linear for sub_polygon in sub_polygons] == [
        (0.0, 1.0),
        (-1.0, 0.0),
    ]
    assert not list(diagnostics)


@pytest.mark.parametrize(
    ("polygon", "says"),
    [
        ({"type": "squere", "action_type": "stop"}, "there are polygon, circle, velocity_polygon"),
        ({"type": "circle", "action_type": "halt"}, "there are none, stop, slowdown, approach"),
        ({"type": "polygon", "action_type": "stop"}, "neither 'points' nor 'polygon_sub_topic'"),
        (
            {"type": "polygon", "action_type": "stop", "points": "[[0, 0], [1, 0]]"},
            "a footprint has at least 3 corners, this has 2",
        ),
    ],
)
def test_wrong_zones_are_told_and_left_out(polygon: dict[str, Any], says: str) -> None:
    settings, diagnostics = _settings(polygons=["bad", "stop"], bad=polygon, stop=_CIRCLE)
    assert [one.name for one, _ in read_polygons(settings)] == ["stop"]
    assert says in _said(diagnostics)


def test_sensors_have_the_timeout_of_the_node_unless_they_say_one() -> None:
    settings, diagnostics = _settings(
        source_timeout=1.0, observation_sources=["front", "rear", "odd"], front={"type": "scan"},
        rear={"type": "scan", "topic": "/rear", "source_timeout": 0.2}, odd={"type": "scam"},
    )  # fmt: skip
    found = read_sources(settings)
    assert [(one.name, one.topic, one.timeout_s) for one in found] == [
        ("front", "scan", 1.0), ("rear", "/rear", 0.2),
    ]  # fmt: skip
    assert "sensor 'odd' is of type 'scam'; there are scan, pointcloud" in _said(diagnostics)
    assert "did you mean 'scan'?" in _said(diagnostics)
