"""Shapes that do not roll."""

from __future__ import annotations

from tests.description.checks.pain import FIXTURES, examined, place


def test_box_for_a_wheel_gets_a_cylinder_of_its_size() -> None:
    found = examined(FIXTURES / "pain_14_wheels/broken/box.urdf")
    (item,) = found.by_code("robot.wheel-box")
    assert "the collision of wheel 'left_wheel' is a box" in item.message
    assert place(item) == "<collision>"
    assert item.fix == 'use <cylinder radius="0.05" length="0.03"/>'
