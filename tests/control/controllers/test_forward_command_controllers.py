"""Controllers that pass commands on."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.plant import PlantJoint, make_controller, make_robot, run

from gazelle.control.controllers.forward_command_controllers import (
    JointCommandController,
    JointGroupCommandController,
    MultiInterfaceCommandController,
)
from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type

Float64 = message_type("std_msgs/Float64")
Array64 = message_type("std_msgs/Float64MultiArray")
ROWS = [PlantJoint("a", 2.0, position=0.1), PlantJoint("b", 4.0, position=0.2)]


def _command(robot: object, name: str) -> float:
    interface_values = robot.interface_values  # type: ignore[attr-defined]
    return float(interface_values.commands[interface_values.command_index[name]])


@pytest.mark.parametrize("interface", ["effort", "velocity", "position"])
def test_one_number_goes_to_the_joint_and_begins_at_rest(interface: str) -> None:
    robot, plant = make_robot(ROWS)
    type_name = f"{interface}_controllers/Joint{interface.capitalize()}Controller"
    controller, ports = make_controller(
        JointCommandController, robot, {"joint": "b"}, type_name=type_name
    )
    assert controller.commands == (f"b/{interface}",)
    controller.start(0)
    run(robot, controller, 10)
    assert plant.position[1] == pytest.approx(0.2)
    ports.send("~/command", Float64(data=0.5))
    run(robot, controller, 1000)
    moved = {"effort": 0.2 + 0.5 / 4.0 / 2.0, "velocity": 0.7, "position": 0.5}
    assert plant.position[1] == pytest.approx(moved[interface])
    controller.stop(0)
    assert _command(robot, f"b/{interface}") == 0.5


@pytest.mark.parametrize("interface", ["effort", "velocity", "position"])
def test_ros1_group_begins_at_rest_and_passes_arrays_on(interface: str) -> None:
    robot, _ = make_robot(ROWS)
    type_name = f"{interface}_controllers/JointGroup{interface.capitalize()}Controller"
    controller, ports = make_controller(
        JointGroupCommandController, robot, {"joints": ["b", "a"]}, type_name=type_name
    )
    controller.start(0)
    controller.update(0, 1)
    begin = [0.2, 0.1] if interface == "position" else [0.0, 0.0]
    assert [_command(robot, f"{name}/{interface}") for name in "ba"] == begin
    ports.send("~/command", Array64(data=[1.0, 2.0]))
    ports.send("~/command", Array64(data=[1.0]))
    controller.update(0, 1)
    assert [_command(robot, f"{name}/{interface}") for name in "ab"] == [2.0, 1.0]
    ((_, text),) = ports.lines
    assert "Dimension of command (1) does not match number of joints (2)! Not executing!" in text


@pytest.mark.parametrize("interface", ["effort", "velocity", "position"])
def test_ros2_group_waits_for_a_command_and_stops_with_zeros(interface: str) -> None:
    robot, _ = make_robot(ROWS, ros_version=2)
    type_name = f"{interface}_controllers/JointGroup{interface.capitalize()}Controller"
    controller, ports = make_controller(
        JointGroupCommandController, robot, {"joints": ["a", "b"]}, type_name=type_name
    )
    controller.start(0)
    controller.update(0, 1)
    assert math.isnan(_command(robot, f"a/{interface}"))
    ports.send("~/commands", Array64(data=[1.0, 2.0]))
    ports.send("~/commands", Array64(data=[1.0, 2.0, 3.0]))
    assert ports.lines == [
        ("error", "controller: command size (3) does not match number of interfaces (2)")
    ]
    controller.update(0, 1)
    assert _command(robot, f"b/{interface}") == 2.0
    controller.stop(0)
    assert _command(robot, f"b/{interface}") == (2.0 if interface == "position" else 0.0)
    controller.start(0)
    robot.interface_values.commands[:] = np.nan
    controller.update(0, 1)
    assert math.isnan(_command(robot, f"a/{interface}"))


def test_forward_command_controller_takes_the_interface_it_is_told() -> None:
    robot, _ = make_robot(ROWS, ros_version=2)
    kind = "forward_command_controller/ForwardCommandController"
    parameters = {"joints": ["a", "b"], "interface_name": "velocity"}
    controller, ports = make_controller(
        JointGroupCommandController, robot, parameters, type_name=kind
    )
    assert controller.commands == ("a/velocity", "b/velocity")
    controller.start(0)
    ports.send("~/commands", Array64(data=[1.0, 2.0]))
    controller.update(0, 1)
    controller.stop(0)
    assert _command(robot, "b/velocity") == 2.0
    with pytest.raises(ControllerError, match="no 'interface_name' given"):
        make_controller(JointGroupCommandController, robot, {"joints": ["a"]}, type_name=kind)
    with pytest.raises(ControllerError, match="'joints' parameter was empty"):
        make_controller(JointGroupCommandController, robot, {"joints": []}, type_name=kind)


def test_multi_interface_controller_commands_one_joint_in_several_ways() -> None:
    robot, _ = make_robot(ROWS, ros_version=2)
    parameters = {"joint": "b", "interface_names": ["position", "velocity"]}
    controller, ports = make_controller(MultiInterfaceCommandController, robot, parameters)
    assert controller.commands == ("b/position", "b/velocity")
    controller.start(0)
    controller.update(0, 1)
    assert math.isnan(_command(robot, "b/position"))
    ports.send("~/commands", Array64(data=[0.3, 0.4]))
    controller.update(0, 1)
    assert (_command(robot, "b/position"), _command(robot, "b/velocity")) == (0.3, 0.4)


def test_idle_interface_name_is_reported() -> None:
    robot, _ = make_robot(ROWS, ros_version=2)
    found = Diagnostics()
    parameters = {"joints": ["a"], "interface_name": "velocity"}
    make_controller(
        JointGroupCommandController,
        robot,
        parameters,
        type_name="effort_controllers/JointGroupEffortController",
        diagnostics=found,
    )
    (one,) = found.by_code("parameter.idle")
    assert "JointGroupEffortController commands effort" in one.message


def test_wrong_joint_names_the_nearest() -> None:
    robot, _ = make_robot([PlantJoint("left_wheel"), PlantJoint("right_wheel")])
    with pytest.raises(ControllerError, match="did you mean 'left_wheel'"):
        make_controller(
            JointCommandController,
            robot,
            {"joint": "left_whel"},
            type_name="effort_controllers/JointEffortController",
        )
