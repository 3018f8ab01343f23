"""Position controllers with a PID, against integrations written down here."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.plant import MS, Plant, PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controllers.joint_error import JointRange
from gazelle.control.controllers.ros1_effort_velocity_controllers import (
    JointGroupPositionController,
    JointPositionController,
)
from gazelle.control.errors import ControllerError
from gazelle.control.resource_manager import JointLimits
from gazelle.description.model import JointType
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type

EFFORT = "effort_controllers/JointPositionController"
VELOCITY = "velocity_controllers/JointPositionController"
Float64 = message_type("std_msgs/Float64")
Array64 = message_type("std_msgs/Float64MultiArray")


def _reference(
    steps: int, *, inertia: float, p: float, d: float, goal: float, limit: float, load: float = 0.0
) -> np.ndarray[Any, Any]:
    """PD with a limited effort on an inertia: exact between the samples of 1 ms."""
    x, v, last, found = 0.0, 0.0, 0.0, []
    for _ in range(steps):
        error = goal - x
        effort = p * error + d * (error - last) / 0.001
        last = error
        a = (min(max(effort, -limit), limit) + load) / inertia
        x, v = x + 0.001 * v + 0.5e-6 * a, v + 0.001 * a
        found.append(x)
    return np.array(found)


def _positions(robot: Any, controller: Any, steps: int, joint: int = 0) -> np.ndarray[Any, Any]:
    plant: Plant = robot.components[0]
    found: list[float] = []
    run(robot, controller, steps, after=lambda t: found.append(float(plant.position[joint])))
    return np.array(found)


def test_effort_controller_moves_an_inertia_as_the_same_pid_does() -> None:
    limits = JointLimits(True, -0.2, 0.2, max_effort=0.1)
    robot, _ = make_robot([PlantJoint("roll_joint", 0.0015, limits=limits)])
    parameters = {"joint": "roll_joint", "pid": {"p": 1.0, "i": 1.0, "d": 0.05}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=EFFORT
    )
    controller.start(0)
    ports.send("~/command", Float64(data=0.15))
    # i has no effect: there is no i_clamp.
    wanted = _reference(1500, inertia=0.0015, p=1.0, d=0.05, goal=0.15, limit=0.1)
    assert _positions(robot, controller, 1500) == pytest.approx(wanted, abs=1e-12)
    assert wanted[-1] == pytest.approx(0.15, abs=1e-3)


def test_live_gains_change_the_response_from_then_on() -> None:
    robot, plant = make_robot([PlantJoint("a", 1.0)])
    parameters = {"joint": "a", "pid": {"p": 4.0}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=EFFORT
    )
    controller.start(0)
    ports.send("~/command", Float64(data=1.0))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(4.0)
    names = ["p", "i", "d", "i_clamp_min", "i_clamp_max", "antiwindup"]
    assert [row.name for row in ports.live["pid"].rows] == names
    ports.set_live("pid", p=100.0, d=1.0)
    before = float(plant.position[0])
    run(robot, controller, 1, time_ns=MS)
    slope = -(before - 0.0) / 0.001
    assert plant.effort[0] == pytest.approx(100.0 * (1.0 - before) + 1.0 * slope)
    ports.set_live("pid", i_clamp_min=1.0, i_clamp_max=-1.0)
    assert ports.lines == [
        ("error", "controller/pid: received i_min > i_max (1 > -1), skip new gains")
    ]
    assert ports.live["pid"].values["i_clamp_min"] == 0.0


def test_velocity_controller_approaches_exponentially() -> None:
    robot, _ = make_robot([PlantJoint("a")])
    parameters = {"joint": "a", "pid": {"p": 5.0}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=VELOCITY
    )
    assert controller.commands == ("a/velocity",)
    controller.start(0)
    ports.send("~/command", Float64(data=1.0))
    found = _positions(robot, controller, 1000)
    assert found == pytest.approx(1.0 - (1.0 - 0.005) ** np.arange(1, 1001), abs=1e-12)


def test_it_holds_the_joint_where_it_begins_within_the_limits() -> None:
    for position, held in ((0.3, 0.3), (2.0, 1.0)):
        limits = JointLimits(True, -1.0, 1.0)
        robot, _ = make_robot([PlantJoint("a", position=position, limits=limits)])
        parameters = {"joint": "a", "pid": {"p": 1.0}}
        controller, _ = make_controller(
            JointPositionController, robot, parameters, type_name=EFFORT
        )
        controller.start(0)
        assert isinstance(controller, JointPositionController)
        assert controller.command == held


def test_commands_beyond_the_limits_are_cut() -> None:
    limits = JointLimits(True, -1.0, 0.5)
    robot, _ = make_robot([PlantJoint("a", limits=limits)])
    parameters = {"joint": "a", "pid": {"p": 1.0}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=EFFORT
    )
    controller.start(0)
    ports.send("~/command", Float64(data=7.0))
    run(robot, controller, 1)
    state = ports.publishers["~/state"].last
    assert (state.set_point, state.error, state.command) == (0.5, 0.5, 0.5)


def test_continuous_joint_turns_the_shorter_way() -> None:
    robot, plant = make_robot([PlantJoint("a", position=3.0, is_continuous=True)])
    parameters = {"joint": "a", "pid": {"p": 1.0}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=EFFORT
    )
    controller.start(0)
    ports.send("~/command", Float64(data=-3.0))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(2.0 * math.pi - 6.0)


def test_revolute_joint_turns_the_shorter_way_only_within_its_limits() -> None:
    wide = JointRange(JointType.REVOLUTE, -2.0 * math.pi, 2.0 * math.pi)
    assert wide.error(3.0, -3.0) == pytest.approx(2.0 * math.pi - 6.0)
    narrow = JointRange(JointType.REVOLUTE, -3.1, 3.1)
    assert narrow.error(3.0, -3.0) == pytest.approx(-6.0)
    assert narrow.clip(9.0) == 3.1
    assert JointRange(JointType.PRISMATIC, -9.0, 9.0).error(4.0, -4.0) == -8.0
    assert JointRange(JointType.CONTINUOUS).error(0.0, -math.pi) == pytest.approx(math.pi)


def test_state_comes_every_tenth_update_and_only_to_somebody() -> None:
    robot, _ = make_robot([PlantJoint("a", velocity=0.25)])
    parameters = {"joint": "a", "pid": {"p": 2.0, "i": 1.0, "i_clamp": 3.0, "antiwindup": True}}
    controller, ports = make_controller(
        JointPositionController, robot, parameters, type_name=EFFORT
    )
    controller.start(0)
    run(robot, controller, 25)
    messages = ports.publishers["~/state"].messages
    assert [m.header.stamp.nanosec // MS for m in messages] == [0, 10, 20]
    first = messages[0]
    assert (first.p, first.i, first.d, first.i_clamp) == (2.0, 1.0, 0.0, 3.0)
    assert first.antiwindup and first.time_step == 0.001 and first.process_value_dot == 0.25
    quiet, silent = make_controller(
        JointPositionController,
        robot,
        {"joint": "a", "pid": {"p": 2.0, "publish_state": True}},
        ports=RecordingPorts(subscribed=False),
        type_name=EFFORT,
    )
    quiet.start(0)
    run(robot, quiet, 25)
    assert not any(publisher.messages for publisher in silent.publishers.values())


def test_pid_state_tells_terms_that_add_up() -> None:
    robot, _ = make_robot([PlantJoint("a")])
    pid = {"p": 2.0, "i": 5.0, "d": 0.1, "i_clamp": 3.0, "publish_state": True}
    controller, ports = make_controller(
        JointPositionController, robot, {"joint": "a", "pid": pid}, type_name=EFFORT
    )
    controller.start(0)
    ports.send("~/command", Float64(data=1.0))
    run(robot, controller, 5)
    messages = ports.publishers["~/pid/state"].messages
    assert len(messages) == 5
    last = messages[-1]
    assert last.p_term + last.i_term + last.d_term == pytest.approx(last.output)
    assert last.timestep.nanosec == MS and last.header.stamp.nanosec == 4 * MS
    assert last.i_term == pytest.approx(5.0 * last.i_error) and last.i_max == 3.0


def test_missing_gain_and_missing_joint_are_errors_of_the_original() -> None:
    robot, _ = make_robot([PlantJoint("roll_joint")])
    with pytest.raises(ControllerError, match=r"No p gain specified for pid.  Namespace: /c.*/pid"):
        make_controller(JointPositionController, robot, {"joint": "roll_joint"}, type_name=EFFORT)
    with pytest.raises(ControllerError, match="did you mean 'roll_joint'"):
        parameters = {"joint": "rol_joint", "pid": {"p": 1.0}}
        make_controller(JointPositionController, robot, parameters, type_name=EFFORT)


def test_integral_without_clamp_is_said_once() -> None:
    robot, _ = make_robot([PlantJoint("a")])
    found = Diagnostics()
    parameters = {"joint": "a", "pid": {"p": 1.0, "i": 1.0, "d": 0.0}}
    make_controller(JointPositionController, robot, parameters, type_name=EFFORT, diagnostics=found)
    code = "control.integral-without-clamp"
    (one,) = found.by_code(code)
    assert "'/controller/pid.i' is 1 and there is no i_clamp" in one.message
    assert "i has no effect" in one.message


def test_group_holds_every_joint_as_a_single_controller_would() -> None:
    limits = JointLimits(True, -1.0, 1.0)
    rows = [
        PlantJoint("a", 0.5, limits=limits),
        PlantJoint("b", 2.0, is_continuous=True, position=3.0),
    ]
    gains = {"a": {"p": 10.0, "d": 1.0}, "b": {"p": 30.0, "i": 4.0, "d": 2.0, "i_clamp": 1.0}}
    goals = {"a": 5.0, "b": -3.0}
    robot, plant = make_robot(rows)
    parameters: dict[str, Any] = {"joints": ["a", "b"]}
    parameters |= {name: {"pid": pid} for name, pid in gains.items()}
    group, ports = make_controller(JointGroupPositionController, robot, parameters)
    group.start(0)
    ports.send("~/command", Array64(data=list(goals.values())))
    run(robot, group, 300)
    single_robot, single_plant = make_robot(rows)
    singles = []
    for name, pid in gains.items():
        one, its_ports = make_controller(
            JointPositionController, single_robot, {"joint": name, "pid": pid}, type_name=EFFORT
        )
        one.start(0)
        its_ports.send("~/command", Float64(data=goals[name]))
        singles.append(one)
    run(single_robot, singles, 300)
    assert plant.position == pytest.approx(single_plant.position, abs=1e-12)
    assert plant.position[1] > 3.0


def test_group_takes_no_array_of_the_wrong_length() -> None:
    robot, plant = make_robot([PlantJoint("a", position=0.5)])
    parameters = {"joints": ["a"], "a": {"pid": {"p": 1.0}}}
    controller, ports = make_controller(JointGroupPositionController, robot, parameters)
    controller.start(0)
    ports.send("~/command", Array64(data=[1.0, 2.0]))
    run(robot, controller, 1)
    assert plant.effort[0] == 0.0
    ((level, text),) = ports.lines
    assert level == "error"
    assert "Dimension of command (2) does not match number of joints (1)! Not executing!" in text
    ports.set_live("a/pid", p=3.0)
    ports.send("~/command", Array64(data=[1.0]))
    run(robot, controller, 1)
    assert plant.effort[0] == pytest.approx(1.5)


def test_it_tells_what_its_effort_loses_per_position_and_velocity() -> None:
    robot, _ = make_robot([PlantJoint("a", 2.0)])
    parameters = {"joint": "a", "pid": {"p": 8.0, "d": 1.0}}
    controller, _ = make_controller(JointPositionController, robot, parameters, type_name=EFFORT)
    controller.start(0)
    run(robot, controller, 1)
    place = robot.interface_values.command_index["a/effort"]
    assert (robot.interface_values.stiffness[place], robot.interface_values.damping[place]) == (
        8.0,
        1.0,
    )
