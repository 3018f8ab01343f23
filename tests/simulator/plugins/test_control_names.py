"""Mistyped names in controllers' parameters, through whole simulations of both generations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.simulator.plugins import test_ros2_control as ros2
from tests.simulator.plugins import test_ros_control as ros1

from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Severity
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]

ROS1_YAML = """bot:
  mistyped: {type: effort_controllers/JointPositonController, joint: elbow, pid: {p: 1.0}}
  lift:
    type: effort_controllers/JointPositionController
    joint: elbwo
    pid: {p: 1.0}
  hand: {type: effort_controllers/JointGroupEffortController, joints: [bare, welded, elbow]}
  pose: {type: position_controllers/JointPositionController, joint: elbow}
"""
ROS2_YAML = """controller_manager:
  ros__parameters:
    update_rate: 200
    mistyped: {type: forward_command_controller/ForwardComandController}
    lift: {type: forward_command_controller/ForwardCommandController}
    hand: {type: forward_command_controller/ForwardCommandController}
    pose: {type: forward_command_controller/ForwardCommandController}
    old: {type: position_controllers/JointTrajectoryController}
lift:
  ros__parameters:
    joints: [elbwo]
    interface_name: position
hand: {ros__parameters: {joints: [bare, welded, elbow], interface_name: position}}
pose: {ros__parameters: {joints: [elbow], interface_name: effort}}
old: {ros__parameters: {joints: [elbow]}}
"""
# A joint without a transmission or a place in a <ros2_control> block, and a fixed one.
EXTRA = "".join(
    f"""<link name="{name}_link"><inertial><mass value="1"/>
    <inertia ixx="0.5" iyy="0.5" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="{name}" type="{kind}"><parent link="world"/><child link="{name}_link"/>
    <axis xyz="0 0 1"/></joint>"""
    for name, kind in (("bare", "continuous"), ("welded", "fixed"))
)
TABLE = """robot, hardware, controllers and MoveIt do not mean the same joints:
name    URDF        hardware  controllers  MoveIt
elbwo   –           –         lift         –       the robot has no such joint; \
did you mean 'elbow'?
bare    continuous  –         hand         –       no transmission or <ros2_control> gives it to \
controllers
welded  fixed       –         hand         –       the joint is fixed"""


@pytest.fixture
def classic(load: Load, tmp_path: Path) -> Simulation:
    path = tmp_path / "controllers.yaml"
    path.write_text(ROS1_YAML)
    return load(ros1.robot(ros1.joint("elbow"), EXTRA), parameters=path)


@pytest.fixture(params=[ros2.CLASSIC, ros2.GZ], ids=["gazebo_ros2_control", "gz_ros2_control"])
def modern(load: Load, tmp_path: Path, request: pytest.FixtureRequest) -> Simulation:
    path = tmp_path / "controllers.yaml"
    path.write_text(ROS2_YAML)
    text = ros2.robot(request.param, f"<parameters>{path}</parameters>", extra=EXTRA)
    return load(text.replace('name="j"', 'name="elbow"'))


def refusal(sim: Simulation, controller: str) -> str:
    with pytest.raises(ControllerError) as caught:
        sim.controller_manager().spawn(controller)
    return str(caught.value)


def table_is_told(sim: Simulation) -> None:
    (found,) = sim.diagnostics.by_code("control.names-disagree")
    assert found.message == TABLE
    assert found.severity is Severity.WARNING
    assert found.fix == "use one name everywhere"
    assert "Could not find resource in hardware_interface" in found.phrase
    assert sim.time_ns == 0
    # It is a warning: what is right runs.
    sim.run(seconds=0.01)


def test_ros1_tells_the_table_of_names_before_the_first_step(classic: Simulation) -> None:
    table_is_told(classic)


def test_ros2_tells_the_table_of_names_before_the_first_step(modern: Simulation) -> None:
    table_is_told(modern)
    (found,) = modern.diagnostics.by_code("control.names-disagree")
    assert found.span is not None
    assert found.span.line == ROS2_YAML.splitlines().index("    joints: [elbwo]") + 1


def test_ros1_refuses_in_the_originals_words_with_the_nearest_names(classic: Simulation) -> None:
    text = refusal(classic, "mistyped")
    assert text.startswith(
        "Could not load class 'effort_controllers/JointPositonController': Could not load "
        "controller 'mistyped' because controller type 'effort_controllers/JointPositonController'"
        " does not exist"
    )
    assert "did you mean 'effort_controllers/JointPositionController'" in text
    assert refusal(classic, "lift") == (
        "controller 'lift': the hardware has no joint or sensor 'elbwo'; did you mean 'elbow'? "
        "(Could not find resource 'elbwo')"
    )
    assert refusal(classic, "hand") == (
        "controller 'hand': the hardware has no joint or sensor 'bare'; the robot has it, but no "
        "<transmission> gives it to controllers (Could not find resource 'bare')"
    )
    assert refusal(classic, "pose") == (
        "controller 'pose' needs command interface 'elbow/position'; 'elbow' has effort "
        "(Could not find resource 'elbow' in 'hardware_interface::PositionJointInterface')"
    )
    assert refusal(classic, "lfit") == (
        "Could not load controller 'lfit' because the type was not specified. Did you load the "
        "controller configuration on the parameter server (namespace: '/bot/lfit')? "
        "did you mean 'lift'?"
    )


def test_ros2_refuses_in_the_originals_words_with_the_nearest_names(modern: Simulation) -> None:
    text = refusal(modern, "mistyped")
    kind = "forward_command_controller/ForwardComandController"
    assert text.startswith(f"Loader for controller 'mistyped' (type '{kind}') not found")
    assert "did you mean 'forward_command_controller/ForwardCommandController'" in text
    assert refusal(modern, "lift") == (
        "controller 'lift': the hardware has no joint or sensor 'elbwo'; did you mean 'elbow'?"
    )
    assert refusal(modern, "hand") == (
        "controller 'hand': the hardware has no joint or sensor 'bare'; the robot has it, but no "
        "<ros2_control> block gives it to controllers"
    )
    assert refusal(modern, "pose") == (
        "controller 'pose' needs command interface 'elbow/effort'; 'elbow' has position"
    )
    assert refusal(modern, "lfit") == (
        "The 'type' param was not defined for 'lfit'; did you mean 'lift'?"
    )
    text = refusal(modern, "old")
    assert "type 'position_controllers/JointTrajectoryController' is ROS 1's" in text
    assert "ROS 2 has joint_trajectory_controller/JointTrajectoryController" in text
