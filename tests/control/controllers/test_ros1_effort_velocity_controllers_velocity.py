"""effort_controllers/JointVelocityController."""

from __future__ import annotations

import numpy as np
import pytest
from tests.control.plant import PlantJoint, make_controller, make_robot, run

from gazelle.control.controllers.ros1_effort_velocity_controllers import JointVelocityController
from gazelle.interfaces import message_type


def test_velocity_of_an_inertia_approaches_as_a_first_order_lag() -> None:
    robot, plant = make_robot([PlantJoint("a", 2.0)])
    parameters = {"joint": "a", "pid": {"p": 8.0}}
    controller, ports = make_controller(JointVelocityController, robot, parameters)
    controller.start(0)
    ports.send("~/command", message_type("std_msgs/Float64")(data=3.0))
    found: list[float] = []
    run(robot, controller, 500, after=lambda t: found.append(float(plant.velocity[0])))
    assert found == pytest.approx(3.0 * (1.0 - (1.0 - 0.004) ** np.arange(1, 501)))
    state = ports.publishers["~/state"].messages[1]
    assert state.set_point == 3.0 and state.process_value == pytest.approx(found[9])
    assert state.error == pytest.approx(3.0 - found[9])


def test_it_begins_with_velocity_zero_again() -> None:
    robot, plant = make_robot([PlantJoint("a", velocity=0.5)])
    controller, ports = make_controller(
        JointVelocityController, robot, {"joint": "a", "pid": {"p": 2.0}}
    )
    controller.start(0)
    ports.send("~/command", message_type("std_msgs/Float64")(data=3.0))
    controller.stop(0)
    controller.start(0)
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(-1.0)


def test_it_tells_what_its_effort_loses_per_velocity() -> None:
    robot, _ = make_robot([PlantJoint("a", 2.0)])
    parameters = {"joint": "a", "pid": {"p": 8.0, "d": 1.0}}
    controller, _ = make_controller(JointVelocityController, robot, parameters)
    controller.start(0)
    run(robot, controller, 1)
    place = robot.interface_values.command_index["a/effort"]
    assert (robot.interface_values.stiffness[place], robot.interface_values.damping[place]) == (
        0.0,
        8.0,
    )
    robot.switch(frozenset(), frozenset({"a/effort"}))
    assert robot.interface_values.damping[place] == 0.0
