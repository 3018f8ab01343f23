"""Preserved joints of links without mass; sdformat 9 and 12.3 drop the same."""

from __future__ import annotations

from tests.description.checks.pain import finding, place


def test_preserved_dummy_root_lets_the_robot_vanish() -> None:
    item = finding("pain_04_massless/preserved_root.urdf")
    assert item.code == "robot.preserved-massless"
    assert item.message == (
        "the fixed joint 'base_joint' is preserved, but 'base_footprint' has no <inertial>: "
        "Gazebo drops that link, and with it the whole robot: nothing appears; here it is kept"
    )
    assert place(item) == '<joint name="base_joint" type="fixed">'
    assert item.fix.startswith("remove <preserveFixedJoint>")
    assert "not modeled in sdf" in item.phrase


def test_preserved_frame_is_dropped_alone() -> None:
    item = finding("pain_04_massless/preserved_frame.urdf")
    assert item.code == "robot.preserved-massless"
    assert item.message.endswith(
        "'camera_frame' has no <inertial>: Gazebo drops that link; here it is kept"
    )
