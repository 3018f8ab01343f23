"""The example of plug-ins in Python: wind carries balloons as the drag law says."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import gazelle
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "own_plugin_ws"
WORLD = EXAMPLE / "src" / "gust_plugins" / "worlds" / "gust.world"
# ½ ρ c A / m of a ball of 0.2 m radius and 50 g.
DRAG_PER_M = 0.5 * 1.2 * 0.47 * math.pi * 0.2**2 / 0.05


@pytest.fixture
def sim() -> Iterator[gazelle.Simulation]:
    workspace = Workspace.discover(environ={}, cwd="/", extra=[EXAMPLE])
    with gazelle.Simulation.load(world=WORLD, workspace=workspace) as opened:
        yield opened


def test_nothing_about_it_needs_a_finding(sim: gazelle.Simulation) -> None:
    assert [str(item) for item in sim.diagnostics] == []


@pytest.mark.parametrize(("name", "wind_m_s"), [("slow", 1.0), ("fast", 3.0)])
def test_a_balloon_takes_up_the_wind(sim: gazelle.Simulation, name: str, wind_m_s: float) -> None:
    # dv/dt = k (w - v)² from rest: v = w (1 - 1 / (1 + k w t)).
    for seconds in (0.5, 1.0):
        sim.run(seconds=0.5)
        wanted = wind_m_s * (1 - 1 / (1 + DRAG_PER_M * wind_m_s * seconds))
        speed = sim.model(name).link("skin").linear_velocity_m_s[0]
        assert speed == pytest.approx(wanted, rel=5e-3)


def test_its_topics_say_what_happens(sim: gazelle.Simulation) -> None:
    heard: dict[str, list[Any]] = {"/leader": [], "/fast/alarm": [], "/slow/alarm": []}
    for topic, messages in heard.items():
        sim.subscribe(topic, messages.append)
    sim.run(seconds=2.0)
    assert len(heard["/leader"]) == 20
    assert {message.data for message in heard["/leader"]} == {"fast"}
    # k w² is 6.4 m/s² at first for the fast one, below the threshold for the slow one.
    assert [message.data for message in heard["/fast/alarm"]] == [True, False]
    assert [message.data for message in heard["/slow/alarm"]] == [False]


def test_the_wind_is_a_topic(sim: gazelle.Simulation) -> None:
    sim.publish("/slow/wind", message_type("geometry_msgs/Vector3")(x=0.0, y=-4.0, z=0.0))
    sim.run(seconds=3.0)
    assert sim.model("slow").link("skin").linear_velocity_m_s[1] < -3.0
