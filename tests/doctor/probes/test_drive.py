"""Velocity commands and what robots make of them."""

from __future__ import annotations

import pytest
from tests.doctor.probes.worlds import ground, probed, robot

from gazelle.diagnostics import Diagnostic
from gazelle.doctor.probes.drive import twist_topics


def _driven(name: str) -> tuple[tuple[str, ...], list[Diagnostic]]:
    sections, found = probed(ground(), robot(f"pain_14_wheels/{name}.urdf", 0.001))
    (row,) = sections["probe_drive"].rows
    return row, list(found)


def test_rover_drives_as_it_is_told() -> None:
    row, found = _driven("clean/rover")
    assert row[:3] == ("fixture", "/cmd_vel", "0.2 m/s, 0.5 rad/s")
    ahead, turn = row[3].split(", ")
    assert float(ahead.split()[0]) == pytest.approx(0.2, rel=0.02)
    assert float(turn.split()[0]) == pytest.approx(0.5, rel=0.05)
    assert row[4] == "good"
    assert found == []


def test_exchanged_joints_turn_the_robot_right() -> None:
    row, (item,) = _driven("broken/swapped")
    assert item.code == "probe.turns-wrong"
    assert "told on /cmd_vel to turn left with 0.5 rad/s, turns right: -0.5" in item.message
    assert "exchange the left and right joints of the drive" in item.fix
    assert item.span is not None
    assert item.span.file.endswith("swapped.urdf")
    assert row[4] == "turns the wrong way"


def test_axes_to_the_right_drive_the_robot_back() -> None:
    row, (item,) = _driven("broken/backwards")
    assert item.code == "probe.drives-wrong"
    assert "told on /cmd_vel to drive ahead with 0.2 m/s, drives back: -0.2 m/s" in item.message
    assert row[4] == "drives backwards"


def test_opposed_axes_turn_the_robot_on_the_spot() -> None:
    row, (item,) = _driven("broken/opposed")
    assert item.code == "probe.drives-wrong"
    assert "to drive straight on with 0.2 m/s, turns with -1.3" in item.message
    assert row[4] == "does not drive straight"


def test_radius_for_a_diameter_drives_twice_as_fast() -> None:
    row, (item,) = _driven("broken/radius_as_diameter")
    assert item.code == "probe.speed-differs"
    assert "told on /cmd_vel to drive 0.2 m/s, drives 0.4 m/s" in item.message
    assert "set wheel diameter" in item.fix
    assert row[4] == "2.00 times as fast"


def test_wheels_in_the_air_drive_nothing() -> None:
    model = robot("pain_15_contact/broken/hanging.urdf", 0.02)
    _, found = probed(ground(), model)
    (item,) = found.by_code("probe.does-not-drive")
    assert "does not move" in item.message
    assert "wheels spin but robot does not move" in item.phrase


def test_topics_of_velocity_commands_are_known_by_their_types() -> None:
    heard = {
        "/cmd_vel": "geometry_msgs/msg/Twist",
        "/base/cmd_vel": "geometry_msgs/TwistStamped",
        "/joint_states": "sensor_msgs/JointState",
        "/any": "",
    }
    assert twist_topics(heard) == {
        "/cmd_vel": "geometry_msgs/msg/Twist",
        "/base/cmd_vel": "geometry_msgs/msg/TwistStamped",
    }
