"""Wheels judged by geometry."""

from __future__ import annotations

import numpy as np
import pytest
from tests.description.checks.pain import FIXTURES, finding, place

from gazelle.description.checks.wheels import wheels_of
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics


def test_drive_wheels_are_told_from_casters() -> None:
    path = FIXTURES / "pain_14_wheels/clean/rover.urdf"
    (model,) = load_models(path, workspace=None, diagnostics=Diagnostics())
    wheels = wheels_of(model)
    assert [(wheel.link.name, wheel.is_caster) for wheel in wheels] == [
        ("left_wheel", False),
        ("right_wheel", False),
    ]
    assert np.allclose(wheels[0].axis, (0.0, 1.0, 0.0))


def test_axes_against_each_other_name_the_one_to_turn() -> None:
    item = finding("pain_14_wheels/opposed.urdf")
    assert item.code == "robot.wheel-axes-opposed"
    assert "'left_wheel_joint' (0, 1, 0) and 'right_wheel_joint' (0, -1, 0)" in item.message
    assert place(item).startswith('<joint name="right_wheel_joint"')
    assert item.fix == "write <axis xyz=\"0 1 0\"/> in joint 'right_wheel_joint'"


@pytest.mark.parametrize(("file", "axis"), [("axis", "(1, 0, 0)"), ("upright", "(0, 0, 1)")])
def test_axis_across_the_wheel_s_cylinder_is_reported(file: str, axis: str) -> None:
    item = finding(f"pain_14_wheels/{file}.urdf")
    assert item.code == "robot.wheel-axis"
    assert f"joint 'left_wheel_joint' turns about {axis} of the model" in item.message
    assert "90° off" in item.message
    # Where no axis is written, URDF takes 1 0 0.
    assert place(item).startswith('<joint name="left_wheel_joint"' if file == "axis" else "<axis")
    assert item.fix.startswith('write <axis xyz="0 1 0"/>')


def test_wheel_beside_its_axle_is_reported() -> None:
    item = finding("pain_14_wheels/off_centre.urdf")
    assert item.code == "robot.wheel-off-centre"
    assert "is centred 10 mm beside the axis of joint 'left_wheel_joint'" in item.message
    assert "origin" in item.fix


def test_wheel_without_collision_is_reported() -> None:
    item = finding("pain_15_contact/wheel_unseen_by_physics.urdf")
    assert item.code == "robot.wheel-without-collision"
    assert "wheel 'left_wheel' has a <visual> and no <collision>" in item.message
    assert place(item) == '<link name="left_wheel">'
