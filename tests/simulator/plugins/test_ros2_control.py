"""``gazebo_ros2_control`` and ``gz_ros2_control`` in a simulation."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import needs_shared

from gazelle.description.xacro.expander import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type
from gazelle.simulator import Simulation
from gazelle.workspace import Workspace

Load = Callable[..., Simulation]

CLASSIC = '<plugin name="gazebo_ros2_control" filename="libgazebo_ros2_control.so">{}</plugin>'
GZ = (
    '<plugin name="gz_ros2_control::GazeboSimROS2ControlPlugin" '
    'filename="gz_ros2_control-system">{}</plugin>'
)
SYSTEMS = {CLASSIC: "gazebo_ros2_control/GazeboSystem", GZ: "gz_ros2_control/GazeboSimSystem"}
YAML = """
controller_manager:
  ros__parameters:
    update_rate: 200
    forward: {type: forward_command_controller/ForwardCommandController}
forward:
  ros__parameters: {joints: [j], interface_name: position}
"""


def robot(plugin: str = CLASSIC, keys: str = "", body: str = "", extra: str = "") -> str:
    own = f"""<ros2_control name="hw" type="system"><hardware><plugin>{SYSTEMS[plugin]}</plugin>
      </hardware><joint name="j"><command_interface name="position"/>
      <state_interface name="position"><param name="initial_value">0.2</param></state_interface>
      <state_interface name="velocity"/><state_interface name="effort"/></joint>{body}
      </ros2_control>"""
    return f"""<robot name="bot"><link name="world"/><link name="arm"><inertial>
      <origin xyz="0.5 0 0"/><mass value="2"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="j" type="revolute"><parent link="world"/><child link="arm"/>
      <origin xyz="0 0 1"/><axis xyz="0 1 0"/>
      <limit lower="-3" upper="3" effort="100" velocity="4"/></joint>{own}{extra}
      <gazebo>{plugin.format(keys)}</gazebo></robot>"""


@pytest.fixture
def yaml_file(tmp_path: Path) -> Path:
    path = tmp_path / "controllers.yaml"
    path.write_text(YAML)
    return path


def numbers(*values: float) -> Any:
    return message_type("std_msgs/Float64MultiArray")(data=list(values))


def found(sim: Simulation, code: str) -> str:
    (finding,) = sim.diagnostics.by_code(code)
    return f"{finding.message} {finding.fix}"


@pytest.mark.parametrize("plugin", [CLASSIC, GZ])
def test_a_controller_of_the_parameter_file_moves_the_joint(
    load: Load, yaml_file: Path, plugin: str
) -> None:
    sim = load(robot(plugin, f"<parameters>{yaml_file}</parameters>"))
    assert sim.joint("j").position == 0.2
    sim.run(seconds=0.5)
    assert sim.joint("j").position == pytest.approx(0.2, abs=1e-3)
    manager = sim.controller_manager()
    assert manager.load("forward").update_rate_hz == 200.0
    manager.start("forward")
    sim.run(seconds=0.1)
    assert sim.joint("j").position == pytest.approx(0.2, abs=1e-3)
    sim.publish("/forward/commands", numbers(0.5))
    sim.run(seconds=1.0)
    assert sim.joint("j").position == pytest.approx(0.5, abs=2e-3)


def test_a_later_parameter_file_wins(load: Load, yaml_file: Path, tmp_path: Path) -> None:
    second = tmp_path / "more.yaml"
    second.write_text("controller_manager: {ros__parameters: {update_rate: 50}}")
    keys = f"<parameters>{yaml_file}</parameters><parameters>{second}</parameters>"
    sim = load(robot(keys=keys))
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(50.0)


def test_parameter_file_that_is_not_there_is_told_where_it_is_named(load: Load) -> None:
    sim = load(robot(keys="<parameters>/nowhere/c.yaml</parameters>"))
    (item,) = sim.diagnostics.by_code("control.parameter-file")
    assert "'/nowhere/c.yaml' cannot be read: No such file or directory" in item.message
    assert item.span is not None


def test_files_for_nodes_of_another_namespace_are_reported(load: Load, yaml_file: Path) -> None:
    keys = f"<parameters>{yaml_file}</parameters><ros><namespace>left</namespace></ros>"
    text = found(load(robot(keys=keys)), "control.parameters-of-others")
    assert "are for /controller_manager, /forward, and the controller manager is" in text
    assert "/left/controller_manager: none" in text and "'/**/controller_manager:'" in text


@pytest.mark.parametrize("name", ["/**/controller_manager:", "/left/controller_manager:", "/**:"])
def test_files_with_a_node_of_the_namespace_are_not(load: Load, tmp_path: Path, name: str) -> None:
    path = tmp_path / "controllers.yaml"
    path.write_text(YAML.replace("controller_manager:", name))
    keys = f"<parameters>{path}</parameters><ros><namespace>left</namespace></ros>"
    assert not load(robot(keys=keys)).diagnostics.by_code("control.parameters-of-others")


def test_parameter_files_among_the_arguments_of_the_node_count(load: Load, yaml_file: Path) -> None:
    arguments = "".join(
        f"<argument>{word}</argument>" for word in ("--ros-args", "--params-file", yaml_file)
    )
    sim = load(robot(keys=f"<robot_sim_type>x</robot_sim_type><ros>{arguments}</ros>"))
    assert not sim.diagnostics.by_code("control.no-parameter-file")
    assert not sim.diagnostics.by_code("parameter.unknown")
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(200.0)


def test_no_parameter_file_is_reported_and_the_rate_is_100_hz(load: Load) -> None:
    sim = load(robot())
    assert "No parameter file provided" in found(sim, "control.no-parameter-file")
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(100.0)


def test_parameters_given_by_a_program_count(load: Load, yaml_file: Path) -> None:
    sim = load(robot(), parameters=yaml_file)
    assert not sim.diagnostics.by_code("control.no-parameter-file")
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(200.0)
    sim.controller_manager().load("forward")


def test_namespace_name_and_remappings_of_the_plugin_count(load: Load, tmp_path: Path) -> None:
    path = tmp_path / "controllers.yaml"
    path.write_text(
        YAML.replace("controller_manager:", "/left/boss:").replace("\nforward:", "\n/**/forward:")
    )
    keys = f"""<parameters>{path}</parameters>
      <controller_manager_name>boss</controller_manager_name>
      <ros><namespace>/left</namespace><remapping>forward/commands:=targets</remapping></ros>"""
    sim = load(robot(keys=keys))
    assert "/left/boss/list_controllers" in sim.server.node.services
    manager = sim.controller_manager("/left")
    manager.load("forward")
    manager.start("forward")
    sim.publish("/left/targets", numbers(0.4))
    sim.run(seconds=0.5)
    assert sim.joint("j").position == pytest.approx(0.4, abs=1e-3)


@pytest.mark.parametrize("plugin", [CLASSIC, GZ])
def test_hold_joints_false_lets_the_arm_fall(load: Load, plugin: str) -> None:
    sim = load(robot(plugin, "<hold_joints>false</hold_joints>"))
    sim.run(seconds=0.5)
    assert sim.joint("j").position > 0.6


def test_the_gain_of_gz_is_the_plugins(load: Load, yaml_file: Path) -> None:
    keys = f"<parameters>{yaml_file}</parameters>"
    keys += "<position_proportional_gain>0.5</position_proportional_gain>"
    sim = load(robot(GZ, keys).replace('effort="100"', 'effort="1e6"'))
    manager = sim.controller_manager()
    manager.load("forward")
    manager.start("forward")
    sim.publish("/forward/commands", numbers(0.3))
    sim.step(5)
    errors = []
    for _ in range(6):
        sim.step(5)
        errors.append(0.3 - sim.joint("j").position)
    ratios = [after / before for before, after in itertools.pairwise(errors)]
    assert ratios == pytest.approx([0.5] * 5, abs=0.02)


def test_gains_in_the_parameters_of_the_plugins_node_count(load: Load, tmp_path: Path) -> None:
    path = tmp_path / "controllers.yaml"
    path.write_text(
        YAML + "gazebo_ros2_control:\n  ros__parameters:\n    pid_gains:\n      position:\n"
        "        j: {kp: 300.0, ki: 0.0, kd: 30.0}\n"
    )
    sim = load(robot(keys=f"<parameters>{path}</parameters>"))
    manager = sim.controller_manager()
    manager.load("forward")
    manager.start("forward")
    sim.publish("/forward/commands", numbers(0.0))
    sim.run(seconds=3.0)
    # A PID without an integral gives way to the load: m g r / kp.
    assert sim.joint("j").position == pytest.approx(2 * 9.8 * 0.5 / 300.0, rel=0.02)


def test_a_bad_update_rate_is_reported(load: Load, tmp_path: Path) -> None:
    path = tmp_path / "controllers.yaml"
    path.write_text("controller_manager: {ros__parameters: {update_rate: fast}}")
    sim = load(robot(keys=f"<parameters>{path}</parameters>"))
    assert "update_rate of the controller manager is 'fast'" in found(sim, "parameter.bad-value")
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(100.0)


SDF = """<sdf version="1.9"><model name="bot">
  <link name="arm"><inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass>
  <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
  <joint name="j" type="revolute"><parent>world</parent><child>arm</child>
  <axis><xyz>0 1 0</xyz></axis></joint>{}</model></sdf>"""


@pytest.mark.parametrize(
    "place", ["/left/robot_state_publisher/robot_description", "/robot_description"]
)
def test_model_from_sdf_takes_its_blocks_from_the_parameter(load: Load, place: str) -> None:
    text = SDF.format(GZ.format("<ros><namespace>left</namespace></ros>"))
    sim = load(text, parameters={place: robot(GZ)})
    assert not sim.diagnostics.by_code("control.ros2-control-missing")
    assert sim.joint("j").position == 0.2
    assert sorted(sim.server.controls.manager("left").robot.joints) == ["j"]


def test_parameter_of_another_robot_does_not_count(load: Load) -> None:
    other = robot(GZ).replace('name="j"', 'name="other"')
    sim = load(SDF.format(GZ.format("")), parameters={"/robot_description": other})
    assert "no ros2_control tag" in found(sim, "control.ros2-control-missing")
    assert not sim.server.controls.manager().robot.joints


SENSORS = """<gazebo reference="arm"><sensor name="imu" type="imu"><update_rate>100</update_rate>
  </sensor></gazebo><gazebo reference="j"><sensor name="ft" type="force_torque">
  <force_torque><frame>child</frame><measure_direction>child_to_parent</measure_direction>
  </force_torque></sensor></gazebo>"""
STATES = """<sensor name="imu"><state_interface name="angular_velocity.y"/>
  <state_interface name="linear_acceleration.z"/></sensor>
  <sensor name="ft"><state_interface name="force.x"/><state_interface name="force.z"/>
  <state_interface name="torque.y"/></sensor>"""


def test_sensors_of_the_block_measure_the_arm(load: Load) -> None:
    sim = load(robot(body=STATES, extra=SENSORS).replace(">0.2<", ">0.0<"))
    known = sim.server.controls.manager().robot
    names = [name for item in known.sensors.values() for name in item]
    places = known.interface_values.state_indices(names)
    sim.run(seconds=0.5)
    values = dict(zip(names, known.interface_values.states[places], strict=True))
    # Held level: the joint carries the weight of 2 kg at 0.5 m.
    assert values["imu/linear_acceleration.z"] == pytest.approx(9.8, rel=1e-3)
    assert values["imu/angular_velocity.y"] == pytest.approx(0.0, abs=1e-4)
    assert values["ft/force.z"] == pytest.approx(-2 * 9.8, rel=1e-3)
    assert values["ft/force.x"] == pytest.approx(0.0, abs=1e-3)
    assert abs(values["ft/torque.y"]) == pytest.approx(2 * 9.8 * 0.5, rel=1e-3)
    assert known.sensor_frames == {"imu": "arm", "ft": "arm"}


def test_reading_of_a_sensor_stands_for_a_period_of_its_rate(load: Load, tmp_path: Path) -> None:
    path = tmp_path / "fast.yaml"
    path.write_text("controller_manager: {ros__parameters: {update_rate: 1000}}")
    keys = f"<parameters>{path}</parameters><hold_joints>false</hold_joints>"
    sim = load(robot(keys=keys, body=STATES, extra=SENSORS))
    known = sim.server.controls.manager().robot
    places = known.interface_values.state_indices(["imu/angular_velocity.y"])
    values = []
    for _ in range(100):
        sim.step()
        values.append(float(known.interface_values.states[places[0]]))
    assert len(set(values)) == 11
    assert [len(list(group)) for _, group in itertools.groupby(values)][1:-1] == [10] * 9


@pytest.mark.parametrize("plugin", [CLASSIC, GZ])
def test_after_a_reset_the_arm_is_at_its_initial_value_and_holds(load: Load, plugin: str) -> None:
    sim = load(robot(plugin, ""))
    interface_values = sim.server.controls.manager().robot
    interface_values.switch(frozenset(["j/position"]), frozenset())
    interface_values.interface_values.commands[:] = 0.6
    sim.run(seconds=0.5)
    sim.reset()
    assert sim.joint("j").position == 0.2
    sim.run(seconds=0.5)
    assert sim.joint("j").position == pytest.approx(0.2, abs=1e-3)


@pytest.fixture
def heron(load: Load, examples_dir: Path) -> Callable[..., Simulation]:
    """The arm of the examples as its launch file makes it."""
    workspace = Workspace.discover(environ={}, cwd=examples_dir / "arm_ws")
    file = workspace.package("heron_description").path / "urdf" / "heron.urdf.xacro"

    def bring_up(hardware: str = "gazebo_ros2_control/GazeboSystem") -> Simulation:
        expanded = expand_xacro(file, workspace=workspace, diagnostics=Diagnostics())
        assert expanded is not None
        text = expanded.text.replace("gazebo_ros2_control/GazeboSystem", hardware)
        return load(text, workspace=workspace, world=None)

    return bring_up


def test_heron_does_not_fall_and_its_controllers_run(heron: Callable[..., Simulation]) -> None:
    sim = heron()
    names = [f"joint_{number}" for number in range(1, 7)]
    start = [sim.joint(name).position for name in names]
    sim.run(seconds=1.0)
    assert [sim.joint(name).position for name in names] == pytest.approx(start, abs=1e-5)
    manager = sim.controller_manager()
    for name in ("joint_state_broadcaster", "arm_controller"):
        manager.load(name)
        manager.start(name)
    sim.run(seconds=1.0)
    assert [sim.joint(name).position for name in names] == pytest.approx(start, abs=1e-5)
    assert "/arm_controller/follow_joint_trajectory" in sim.server.controls.actions


def test_heron_has_mock_hardware_without_simulation(heron: Callable[..., Simulation]) -> None:
    sim = heron("mock_components/GenericSystem")
    (component,) = sim.server.controls.manager().robot.components
    assert component.plugin == "mock_components/GenericSystem"
    assert "moves nothing" in found(sim, "control.hardware-plugin-other")


@pytest.fixture
def luck(load: Load, workspaces_dir: Path) -> Callable[..., Simulation]:
    """The LUCK arm as its launch file makes it: xacro, then the parameter file put in."""
    source = workspaces_dir / "ros2_ws" / "src"
    workspace = Workspace.discover(environ={}, cwd=Path("/"), extra=[source])
    config = source / "luck_robot" / "config"

    def bring_up(**mappings: str) -> Simulation:
        given = {"initial_positions_file": str(config / "initial_positions.yaml"), **mappings}
        expanded = expand_xacro(
            config / "luck_description.urdf.xacro",
            mappings=given,
            workspace=workspace,
            diagnostics=Diagnostics(),
        )
        assert expanded is not None
        begin = '<plugin filename="libgazebo_ros2_control.so" name="gazebo_ros2_control">'
        assert f"{begin}\n        </plugin>" in expanded.text
        yaml = source / "luck_gazebo" / "config" / "controllers.yaml"
        text = expanded.text.replace(begin, f"{begin}<parameters>{yaml}</parameters>")
        return load(text, workspace=workspace, world=None)

    return bring_up


@needs_shared
@pytest.mark.tutorial
def test_luck_does_not_fall_and_its_controllers_run(luck: Callable[..., Simulation]) -> None:
    sim = luck()
    names = [f"joint_{number}" for number in range(1, 7)]
    sim.run(seconds=1.0)
    assert [sim.joint(name).position for name in names] == pytest.approx([0.0] * 6, abs=1e-5)
    manager = sim.controller_manager()
    for name in ("joint_state_broadcaster", "test_group_controller"):
        manager.load(name)
        manager.start(name)
    sim.run(seconds=1.0)
    assert [sim.joint(name).position for name in names] == pytest.approx([0.0] * 6, abs=1e-5)
    assert "/test_group_controller/follow_joint_trajectory" in sim.server.controls.actions


@needs_shared
@pytest.mark.tutorial
def test_luck_has_mock_hardware_without_simulation(luck: Callable[..., Simulation]) -> None:
    sim = luck(use_sim="false")
    (component,) = sim.server.controls.manager().robot.components
    assert component.plugin == "mock_components/GenericSystem"
    assert "moves nothing" in found(sim, "control.hardware-plugin-other")
