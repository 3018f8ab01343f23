"""Force-torque sensors: what joints carry, and what moves a link."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

# A mass of 2 kg half a metre out on an arm that turns about the vertical.
WORLD = """<sdf version="1.6"><world name="lab">{world_plugins}
  <model name="crane"><pose>0 0 2 0 0 0</pose>
    <link name="post"><inertial><mass>1</mass></inertial></link>
    <joint name="foot" type="fixed"><parent>world</parent><child>post</child></joint>
    <link name="arm"><pose>0 0 1 0 0 0</pose><inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass>
      <inertia><ixx>.01</ixx><iyy>.01</iyy><izz>.01</izz></inertia></inertial></link>
    <joint name="pivot" type="revolute"><parent>post</parent><child>arm</child>
      <axis><xyz>0 0 1</xyz></axis>{sensor}</joint>
    {plugin}
  </model></world></sdf>"""
SENSOR = """<sensor name="ft" type="force_torque"><update_rate>20</update_rate>{topic}
  <force_torque><frame>{frame}</frame><measure_direction>{direction}</measure_direction>
  </force_torque></sensor>"""
WEIGHT_N, ARM_M = 2 * 9.8, 0.5
GZ = '<plugin filename="gz-sim-forcetorque-system" name="gz::sim::systems::ForceTorque"/>'


def world(plugin: str = "", sensor: str = "", world_plugins: str = "") -> str:
    return WORLD.format(plugin=plugin, sensor=sensor, world_plugins=world_plugins)


def plugin(filename: str, keys: str) -> str:
    return f'<plugin name="p" filename="{filename}">{keys}</plugin>'


def vector(message: Any) -> list[float]:
    return [message.x, message.y, message.z]


@pytest.mark.parametrize(
    ("keys", "topic", "count"),
    [
        (
            "<robotNamespace>r</robotNamespace><jointName>pivot</jointName>"
            "<topicName>wrench_raw</topicName><updateRate>100</updateRate>",
            "/r/wrench_raw",
            20,
        ),
        (
            "<ros><namespace>/demo</namespace><remapping>wrench:=ft</remapping></ros>"
            "<joint_name>pivot</joint_name><update_rate>50</update_rate>",
            "/demo/ft",
            10,
        ),
    ],
)
def test_a_hanging_mass_pulls_down_with_its_lever(
    load: Load, listen: Listen, keys: str, topic: str, count: int
) -> None:
    sim = load(world(plugin("libgazebo_ros_ft_sensor.so", keys)))
    messages = listen(sim, topic)
    sim.run(seconds=0.2)
    wrench = messages[-1].wrench
    assert len(messages) == count
    assert messages[-1].header.frame_id == "arm"
    assert vector(wrench.force) == pytest.approx([0, 0, -WEIGHT_N], abs=1e-6)
    assert vector(wrench.torque) == pytest.approx([0, ARM_M * WEIGHT_N, 0], abs=1e-6)


def test_a_turning_mass_pulls_outwards(load: Load, listen: Listen) -> None:
    keys = "<jointName>pivot</jointName><topicName>ft</topicName>"
    sim = load(world(plugin("libgazebo_ros_ft_sensor.so", keys)))
    messages = listen(sim, "/ft")
    sim.joint("pivot").handle.set_state(velocity=3.0)
    sim.run(seconds=0.5)
    # m r w² along the arm, whichever way it points.
    assert vector(messages[-1].wrench.force) == pytest.approx(
        [2 * ARM_M * 9.0, 0, -WEIGHT_N], rel=1e-3
    )


def test_noise_of_the_plug_in_has_its_sigma(load: Load, listen: Listen) -> None:
    keys = "<jointName>pivot</jointName><topicName>ft</topicName>"
    keys += "<gaussianNoise>0.5</gaussianNoise>"
    sim = load(world(plugin("libgazebo_ros_ft_sensor.so", keys)))
    messages = listen(sim, "/ft")
    sim.run(seconds=2.0)
    values = np.array([vector(item.wrench.force) + vector(item.wrench.torque) for item in messages])
    assert len(values) == 2000
    assert values.std(axis=0) == pytest.approx([0.5] * 6, rel=0.08)


@pytest.mark.parametrize(
    ("filename", "keys", "topic"),
    [
        ("libgazebo_ros_f3d.so", "<bodyName>body</bodyName><topicName>f</topicName>", "/f"),
        (
            "libgazebo_ros_ft_sensor.so",
            "<ros/><body_name>body</body_name><update_rate>1000</update_rate>",
            "/wrench",
        ),
    ],
)
def test_all_force_on_a_link_is_mass_times_acceleration(
    load: Load, listen: Listen, filename: str, keys: str, topic: str
) -> None:
    model = f"""<sdf version="1.6"><model name="m"><pose>0 0 50 0 0 0</pose><link name="body">
      <inertial><mass>3</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.2</izz></inertia></inertial>
      </link>{plugin(filename, keys)}</model></sdf>"""
    sim = load(model, world=None)
    messages = listen(sim, topic)
    sim.run(seconds=0.1)
    assert vector(messages[-1].wrench.force) == pytest.approx([0, 0, -3 * 9.8])
    assert messages[-1].header.frame_id == "world"
    sim.link("body").apply_wrench(force_n=(6.0, 0.0, 3 * 9.8), torque_nm=(0.0, 0.0, 0.4))
    sim.run(seconds=0.1)
    assert vector(messages[-1].wrench.force) == pytest.approx([6.0, 0, 0], abs=1e-6)
    assert vector(messages[-1].wrench.torque) == pytest.approx([0, 0, 0.4], abs=1e-6)


def test_gz_joint_sensors_publish_by_themselves(load: Load, listen: Listen) -> None:
    sensor = SENSOR.format(topic="", frame="sensor", direction="parent_to_child")
    sim = load(world(sensor=sensor, world_plugins=GZ))
    messages = listen(sim, "/world/lab/model/crane/joint/pivot/sensor/ft/forcetorque")
    sim.run(seconds=0.5)
    assert len(messages) == 10
    assert vector(messages[-1].wrench.force) == pytest.approx([0, 0, WEIGHT_N])
    assert messages[-1].header.frame_id == "crane/pivot/ft"


def test_a_sensor_under_a_fixed_part_carries_what_stands_on_it(load: Load) -> None:
    scale = """<sdf version="1.6"><world name="w">
      <model name="scale"><pose>0 0 2 0 0 0</pose>
        <link name="base"><inertial><mass>1</mass></inertial></link>
        <joint name="a" type="fixed"><parent>world</parent><child>base</child></joint>
        <link name="plate"><pose>0 0 .1 0 0 0</pose><inertial><mass>2</mass></inertial>
          <collision name="c"><geometry><box><size>1 1 .1</size></box></geometry></collision></link>
        <joint name="b" type="fixed"><parent>base</parent><child>plate</child>
          <sensor name="ft" type="force_torque"/></joint></model>
      <model name="load"><pose>.3 0 2.25 0 0 0</pose><link name="l">
        <inertial><mass>5</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
        <collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision>
      </link></model></world></sdf>"""
    sim = load(scale)
    sim.run(seconds=2.0)
    force, torque = sim.sensor("ft").read()
    assert force == pytest.approx([0, 0, -7 * 9.8], rel=5e-3, abs=1e-3)
    assert torque == pytest.approx([0, 0.3 * 5 * 9.8, 0], rel=5e-3, abs=1e-3)


def test_a_force_torque_sensor_on_a_link_is_misplaced(load: Load) -> None:
    model = """<sdf version="1.6"><model name="m"><link name="a"/><link name="b">
      <sensor name="ft" type="force_torque"/></link>
      <joint name="j" type="fixed"><parent>a</parent><child>b</child>
        <sensor name="i" type="imu"/></joint></model></sdf>"""
    sim = load(model, world=None)
    first, second = sim.diagnostics.by_code("simulator.sensor-misplaced")
    assert "'ft' of type 'force_torque' sits on link 'b' and needs a joint" in first.message
    assert first.fix == "move it to joint 'j'"
    assert "'i' of type 'imu' sits in joint 'j' and needs a link" in second.message
    assert second.fix == "move it to a link, such as 'b'"


def test_a_fixed_joint_of_a_urdf_is_measured(load: Load, listen: Listen) -> None:
    links = "".join(
        f"<link name='{name}'><inertial><mass value='{mass}'/><inertia ixx='1' ixy='0' ixz='0'"
        " iyy='1' iyz='0' izz='1'/></inertial></link>"
        for name, mass in (("base", 1), ("hand", 2))
    )
    keys = "<jointName>wrist</jointName><topicName>ft</topicName>"
    robot = f"""<robot name="r"><link name="world"/>{links}
      <joint name="foot" type="fixed"><parent link="world"/><child link="base"/></joint>
      <joint name="wrist" type="fixed"><parent link="base"/><child link="hand"/></joint>
      <gazebo>{plugin("libgazebo_ros_ft_sensor.so", keys)}</gazebo></robot>"""
    sim = load(robot, world=None)
    messages = listen(sim, "/ft")
    sim.run(seconds=0.01)
    assert vector(messages[-1].wrench.force) == pytest.approx([0, 0, -2 * 9.8])


def test_the_foot_of_a_held_arm_carries_all_of_it(load: Load) -> None:
    arm = """<sdf version="1.6"><world name="w"><model name="m"><pose>0 0 2 0 0 0</pose>
      <link name="base"><inertial><mass>1</mass></inertial></link>
      <joint name="a" type="fixed"><parent>world</parent><child>base</child></joint>
      <link name="mount"><pose>.2 0 0 0 0 0</pose><inertial><mass>2</mass></inertial></link>
      <joint name="b" type="fixed"><parent>base</parent><child>mount</child>
        <pose>-.2 0 0 0 0 0</pose><sensor name="ft" type="force_torque"/></joint>
      <link name="arm"><pose>.2 0 0 0 0 0</pose><inertial><pose>.5 0 0 0 0 0</pose><mass>3</mass>
        <inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial></link>
      <joint name="c" type="revolute"><parent>mount</parent><child>arm</child>
        <axis><xyz>0 1 0</xyz></axis></joint></model></world></sdf>"""
    sim = load(arm)
    sim.joint("c").handle.lock_position(0.0)
    for _ in range(3):
        # Awake at first, asleep in the end.
        sim.run(seconds=1.0)
        force, torque = sim.sensor("ft").read()
        assert force == pytest.approx([0, 0, -5 * 9.8], rel=1e-4, abs=1e-4)
        assert torque == pytest.approx([0, (0.2 * 2 + 0.7 * 3) * 9.8, 0], rel=1e-4, abs=1e-4)
    sim.joint("c").release()
    sim.step()
    # Let go, it falls about its end: m g I / (I + m r²) is what is left to hold.
    left = 3 * 9.8 * 0.1 / (0.1 + 3 * 0.25)
    assert sim.sensor("ft").read().force_n[2] == pytest.approx(-(2 * 9.8 + left), rel=1e-3)
