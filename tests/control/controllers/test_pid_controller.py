"""ROS 2's pid_controller."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.plant import MS, PlantJoint, make_controller, make_robot, run

from gazelle.control.controllers.pid_controller import PidController
from gazelle.control.errors import ControllerError
from gazelle.interfaces import message_type, service_type

Reference = message_type("control_msgs/MultiDOFCommand")
ONE = {
    "dof_names": ["a"],
    "command_interface": "effort",
    "reference_and_state_interfaces": ["position"],
}
TWO = {**ONE, "reference_and_state_interfaces": ["position", "velocity"]}


def _make(robot: Any, parameters: dict[str, Any], **gains: Any) -> Any:
    return make_controller(PidController, robot, {**parameters, "gains": {"a": gains}})


def _reference(position: float, velocity: float | None = None) -> Any:
    dots = [] if velocity is None else [velocity]
    return Reference(dof_names=["a"], values=[position], values_dot=dots)


def test_one_interface_is_a_pid_of_its_error() -> None:
    robot, plant = make_robot([PlantJoint("a", 0.5)], ros_version=2)
    controller, ports = _make(robot, ONE, p=40.0, i=3.0, d=4.0, i_clamp_max=1.0, i_clamp_min=-1.0)
    controller.start(0)
    ports.send("~/reference", _reference(1.0))
    found: list[float] = []
    run(robot, controller, 800, after=lambda t: found.append(float(plant.position[0])))
    x = v = last = total = 0.0
    wanted = []
    for _ in range(800):
        error = 1.0 - x
        total += error * 0.001
        effort = 40.0 * error + float(np.clip(3.0 * total, -1, 1)) + 4.0 * (error - last) / 0.001
        last, a = error, effort / 0.5
        x, v = x + 0.001 * v + 0.5e-6 * a, v + 0.001 * a
        wanted.append(x)
    assert found == pytest.approx(wanted, abs=1e-9)


def test_two_interfaces_take_the_rate_as_it_is_measured() -> None:
    robot, plant = make_robot([PlantJoint("a", velocity=0.5)], ros_version=2)
    controller, ports = _make(robot, TWO, p=2.0, d=3.0, feedforward_gain=10.0)
    controller.start(0)
    ports.send("~/reference", _reference(1.0, 0.25))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(2.0 * 1.0 + 3.0 * (0.25 - 0.5))
    request = service_type("std_srvs/SetBool").Request(data=True)
    response = ports.call(
        "~/set_feedforward_control", request, service_type("std_srvs/SetBool").Response()
    )
    assert response.success
    x, v = float(plant.position[0]), float(plant.velocity[0])
    run(robot, controller, 1, time_ns=MS)
    assert plant.effort[0] == pytest.approx(2.0 * (1.0 - x) + 3.0 * (0.25 - v) + 2.5)
    controller.changed({"gains.a.feedforward_gain": 0.0})
    x, v = float(plant.position[0]), float(plant.velocity[0])
    run(robot, controller, 1, time_ns=2 * MS)
    assert plant.effort[0] == pytest.approx(2.0 * (1.0 - x) + 3.0 * (0.25 - v))


def test_it_holds_where_it_begins_or_waits() -> None:
    robot, plant = make_robot([PlantJoint("a", position=0.7)], ros_version=2)
    controller, _ = _make(robot, ONE, p=5.0)
    controller.start(0)
    run(robot, controller, 2)
    assert plant.position[0] == 0.7
    robot, _ = make_robot([PlantJoint("a", position=0.7)], ros_version=2)
    waiting = {**ONE, "set_current_state_as_first_setpoint": False}
    controller, ports = _make(robot, waiting, p=5.0)
    controller.start(0)
    controller.update(0, MS)
    assert math.isnan(
        robot.interface_values.commands[robot.interface_values.command_index["a/effort"]]
    )
    ports.send("~/reference", Reference(dof_names=[], values=[1.0]))
    controller.update(0, MS)
    assert robot.interface_values.commands[
        robot.interface_values.command_index["a/effort"]
    ] == pytest.approx(1.5)


def test_wrapped_angles_and_saturated_commands() -> None:
    robot, plant = make_robot([PlantJoint("a", position=3.0)], ros_version=2)
    controller, ports = _make(robot, ONE, p=10.0, angle_wraparound=True, u_clamp_max=2.0)
    controller.start(0)
    ports.send("~/reference", _reference(-3.0))
    run(robot, controller, 1)
    assert plant.effort[0] == 2.0
    state = ports.publishers["~/controller_state"].last.dof_states[0]
    assert state.error == pytest.approx(2.0 * math.pi - 6.0)
    assert (state.name, state.reference, state.feedback, state.output) == ("a", -3.0, 3.0, 2.0)
    assert state.time_step == pytest.approx(0.001)


def test_states_may_come_from_a_topic() -> None:
    robot, plant = make_robot([PlantJoint("a")], ros_version=2)
    controller, ports = _make(robot, {**ONE, "use_external_measured_states": True}, p=2.0)
    assert controller.states == ()
    controller.start(0)
    ports.send("~/reference", _reference(1.0))
    run(robot, controller, 1)
    assert plant.effort[0] == 0.0
    ports.send("~/measured_state", _reference(0.25))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(1.5)


def test_references_are_sorted_by_name_and_wrong_ones_refused() -> None:
    robot, _ = make_robot([PlantJoint("a"), PlantJoint("b")], ros_version=2)
    parameters = {**ONE, "dof_names": ["a", "b"], "gains": {"a": {"p": 1.0}, "b": {"p": 1.0}}}
    controller, ports = make_controller(PidController, robot, parameters)
    controller.start(0)
    ports.send("~/reference", Reference(dof_names=["b", "a"], values=[2.0, 1.0]))
    ports.send("~/reference", Reference(dof_names=["b", "x"], values=[2.0, 1.0]))
    ports.send("~/reference", Reference(dof_names=["b"], values=[2.0]))
    controller.update(0, MS)
    assert list(
        robot.interface_values.commands[robot.interface_values.command_indices(controller.commands)]
    ) == [1.0, 2.0]
    first, second = (text for _, text in ports.lines)
    assert "DoF name 'a' not found" in first
    assert (
        "Size of input data names (1) and/or values (1) is not matching the expected size (2)"
        in second
    )


def test_gains_change_live_and_integral_is_kept_over_a_restart() -> None:
    robot, plant = make_robot([PlantJoint("a")], ros_version=2)
    controller, ports = _make(robot, ONE, p=0.0, i=2.0, activate_state_publisher=True)
    controller.start(0)
    ports.send("~/reference", _reference(1.0))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(0.002)
    assert ports.publishers["~/a/pid_state"].last.i_error == pytest.approx(0.001)
    controller.start(0)
    assert controller.pids[0].errors[1] == pytest.approx(0.001)
    ports.set_live("gains.a", p=7.0, i=0.0)
    ports.send("~/reference", _reference(1.0))
    x = float(plant.position[0])
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(7.0 * (1.0 - x))


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"dof_names": []}, "at least one"),
        ({"reference_and_state_dof_names": ["a", "b"]}, "has to be the same"),
        ({"reference_and_state_interfaces": ["position", "velocity", "effort"]}, "one interface"),
        ({"command_interface": "torque"}, "'a' has position, velocity, effort"),
    ],
)
def test_wrong_parameters_are_refused(changes: dict[str, Any], text: str) -> None:
    robot, _ = make_robot([PlantJoint("a")], ros_version=2)
    with pytest.raises(ControllerError, match=text):
        make_controller(PidController, robot, {**ONE, **changes})
