"""Joints that cannot do what their numbers promise."""

from __future__ import annotations

from tests.description.checks.pain import finding, place

from gazelle.diagnostics import Severity


def test_massless_arm_takes_its_hand_along() -> None:
    item = finding("pain_04_massless/arm.urdf")
    assert item.code == "inertia.missing"
    assert item.message == (
        "link 'arm' moves and has no <inertial>: Gazebo drops it with all that hangs on it: "
        "'hand' vanishes"
    )
    assert place(item) == '<link name="arm">'
    assert '<mass value="0.75"/>' in item.fix
    assert "has no <inertial> block defined" in item.phrase


def test_massless_root_takes_the_whole_robot_along() -> None:
    item = finding("pain_04_massless/root.urdf")
    assert item.code == "inertia.missing"
    assert "link 'base_link' moves and has no <inertial>" in item.message
    assert item.message.endswith("with it the whole robot: nothing appears")


def test_root_with_inertia_gets_a_dummy_to_paste() -> None:
    item = finding("pain_04_massless/root_inertia.urdf")
    assert (item.code, item.severity) == ("robot.root-inertia", Severity.INFO)
    assert "the root link 'base_link' has an inertia" in item.message
    assert place(item) == "<inertial>"
    assert '<link name="base_footprint"/>' in item.fix
    assert '<child link="base_link"/>' in item.fix
    assert "KDL does not support a root link with an inertia" in item.phrase


def test_start_outside_the_limits_comes_with_the_spawner_s_words() -> None:
    item = finding("pain_15_contact/start_outside.urdf")
    assert (item.code, item.severity) == ("robot.start-outside-limits", Severity.INFO)
    assert "'shoulder' starts at 0 rad, outside its limits 0.5 … 1.5" in item.message
    assert item.fix == "spawn with: -J shoulder 1"


def test_damping_that_eats_the_motor_is_reported() -> None:
    item = finding("pain_15_contact/held_by_damping.urdf")
    assert item.code == "robot.joint-held"
    assert "its 20 N·m drive it at 0.04 rad/s at most, its limit says 2 rad/s" in item.message
    assert item.fix == "write damping 1, or raise <limit effort>"
    assert place(item).startswith('<joint name="shoulder"')


def test_friction_beyond_the_motor_is_reported() -> None:
    item = finding("pain_15_contact/held_by_friction.urdf")
    assert item.code == "robot.joint-held"
    assert "friction of 25 N·m and an effort limit of 20 N·m" in item.message
