"""Idle robots stay where they are, or are told of."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.doctor.probes.worlds import block, ground, probed, robot

from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor.probes import run_probes
from gazelle.simulator.description_sources import world_from
from gazelle.workspace import Workspace


def test_block_on_level_ground_is_still() -> None:
    sections, found = probed(ground(), block(0.1))
    assert sections["probe_idle_drift"].rows == (("cube", "0 mm", "0°", "block (0 mm)", "still"),)
    assert list(found) == []


def test_rover_on_its_wheels_is_still() -> None:
    sections, found = probed(ground(), robot("pain_15_contact/clean/rover.urdf", 0.001))
    assert sections["probe_idle_drift"].rows[0][4] == "still"
    assert list(found) == []


def test_block_on_a_slippery_slope_is_told_with_its_contact() -> None:
    sections, found = probed(ground(roll_rad=0.2), block(0.12, mu=0.02))
    (item,) = found
    assert item.code == "probe.idle-drift"
    assert item.message.startswith("robot 'cube' moved 1")
    assert "in 10 s without a command; link 'block' moved most" in item.message
    assert item.message.endswith("it touches 'block::c' and 'ground::link::collision'")
    assert sections["probe_idle_drift"].rows[0][4] == "moves"


def test_soft_wheel_creeps() -> None:
    _, found = probed(ground(), robot("pain_15_contact/broken/soft.urdf", 0.001))
    (item,) = found
    assert item.code == "probe.idle-drift"
    assert "'left_wheel::left_wheel_collision' and 'ground::link::collision'" in item.message
    assert item.span is not None
    assert item.span.file.endswith("soft.urdf")


def test_robot_without_ground_falls() -> None:
    _, found = probed(block(0.1))
    (item,) = found
    assert (item.code, item.severity) == ("probe.falls", Severity.ERROR)
    # 9.8 m/s² from 2.2 s to 12.2 s.
    assert item.message == "robot 'cube' falls: 706 m in 10 s, and nothing touches it"
    assert pytest.approx(706, abs=1) == 9.8 / 2 * (12.201**2 - 2.201**2)
    assert item.fix.startswith("put a ground plane into the world")


def test_robot_falls_along_gravity_whichever_way_that_is() -> None:
    _, found = probed(block(0.1), gravity_m_s2=(9.8, 0.0, 0.0))
    assert [item.code for item in found] == ["probe.thrown", "probe.falls"]


def test_what_feels_no_gravity_may_float_away(examples_dir: Path) -> None:
    """Wind of a plug-in carries the balloons of the example."""
    found = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd="/", extra=[examples_dir / "own_plugin_ws"])
    file = workspace.package("gust_plugins").path / "worlds" / "gust.world"
    world = world_from(str(file), workspace, found)
    sections = run_probes(world, workspace=workspace, diagnostics=found)
    (drift,) = [item for item in sections if item.name == "probe_idle_drift"]
    assert [(row[0], row[4]) for row in drift.rows] == [("slow", "floats"), ("fast", "floats")]
    assert list(found) == []


def test_falling_robot_is_not_told_to_drive() -> None:
    sections, found = probed(robot("pain_14_wheels/broken/swapped.urdf"))
    assert [item.code for item in found] == ["probe.falls"]
    assert set(sections) == {"probe_spawn", "probe_idle_drift"}
    assert sections["probe_idle_drift"].rows[0][4] == "falls"
