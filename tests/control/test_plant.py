"""The tests' own plant obeys the laws it stands for."""

from __future__ import annotations

import math

import pytest
from tests.control.plant import MS, PlantJoint, make_robot


def test_constant_effort_falls_like_a_stone() -> None:
    robot, plant = make_robot([PlantJoint("a", 2.0), PlantJoint("b", 2.0, damping=4.0)])
    robot.interface_values.commands[
        robot.interface_values.command_indices(["a/effort", "b/effort"])
    ] = 3.0
    robot.write(0, MS)
    for _ in range(1000):
        plant.step(0.001)
    assert plant.position[0] == pytest.approx(0.5 * 1.5)
    assert plant.velocity[0] == pytest.approx(1.5)
    assert plant.velocity[1] == pytest.approx(0.75 * (1.0 - math.exp(-2.0)))


def test_velocity_and_position_commands_are_obeyed() -> None:
    robot, plant = make_robot([PlantJoint("a"), PlantJoint("b")])
    interface_values = robot.interface_values
    interface_values.commands[interface_values.command_index["a/velocity"]] = 0.5
    interface_values.commands[interface_values.command_index["b/position"]] = 0.2
    robot.write(0, MS)
    plant.step(0.1)
    robot.read(0, MS)
    assert plant.position == pytest.approx([0.05, 0.2])
    assert interface_values.states[interface_values.state_index["a/velocity"]] == 0.5
