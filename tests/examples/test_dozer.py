"""The playground's bulldozer drives, pushes, and knocks the whole row of dominoes over."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import gazelle
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "playground_ws"
PACKAGE = EXAMPLE / "src" / "dozer_robot"
_DOMINOES = [f"domino_{number}" for number in range(1, 19)]


@pytest.fixture
def playground() -> Iterator[gazelle.Simulation]:
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "dozer.urdf.xacro",
        world=PACKAGE / "worlds" / "playground.world",
        workspace=Workspace.discover(extra=[EXAMPLE]),
    ) as sim:
        yield sim


def _drive(
    sim: gazelle.Simulation, linear_m_s: float, angular_rad_s: float, seconds: float
) -> None:
    twist: Any = message_type("geometry_msgs/msg/Twist")()
    twist.linear.x, twist.angular.z = linear_m_s, angular_rad_s
    sim.publish("/cmd_vel", twist)
    sim.run(seconds=seconds)


def _heights(sim: gazelle.Simulation) -> list[float]:
    return [sim.model(name).pose.position_m[2] for name in _DOMINOES]


def test_all_stands_until_something_is_pushed(playground: gazelle.Simulation) -> None:
    playground.run(seconds=2.0)
    assert _heights(playground) == pytest.approx([0.18] * 18, abs=2e-3)
    assert [str(item) for item in playground.diagnostics if item.severity.name != "INFO"] == []


def test_one_push_knocks_every_domino_over(playground: gazelle.Simulation) -> None:
    # As scripts/knock.py drives.
    _drive(playground, 0.5, 0.0, 1.5)
    _drive(playground, -0.25, 0.0, 3.0)
    _drive(playground, 0.0, 0.0, 1.0)
    assert max(_heights(playground)) < 0.15


def test_it_turns_and_pushes_crates(playground: gazelle.Simulation) -> None:
    before = playground.model("crate_1").pose.position_m
    _drive(playground, 0.0, -1.5, 1.6)
    assert playground.model("dozer").pose.rpy_rad[2] < -0.7
    _drive(playground, 0.5, 0.0, 4.0)
    after = playground.model("crate_1").pose.position_m
    assert abs(after[0] - before[0]) + abs(after[1] - before[1]) > 0.05
