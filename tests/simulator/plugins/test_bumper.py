"""Contact sensors and the bumper plug-ins."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

# The box lies on its side: the link's y axis points up.
WORLD = """<sdf version="1.6"><world name="lab">{world_plugins}
  <include><uri>model://ground_plane</uri></include>
  <model name="box"><pose>1 2 0.2 1.5707963267948966 0 0</pose><link name="body">
    <inertial><mass>5</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
    <collision name="hull"><geometry><box><size>.4 .4 .4</size></box></geometry></collision>
    <sensor name="touch" type="contact"><update_rate>{rate}</update_rate>
      <contact><collision>{collision}</collision>{topic}</contact>{plugin}</sensor>
  </link></model></world></sdf>"""
ROS1 = """<plugin name="bump" filename="libgazebo_ros_bumper.so"><robotNamespace>r</robotNamespace>
  <bumperTopicName>touched</bumperTopicName><frameName>body</frameName></plugin>"""
ROS2 = """<plugin name="bump" filename="libgazebo_ros_bumper.so">
  <ros><namespace>/demo</namespace><remapping>bumper_states:=touched</remapping></ros>
  <frame_name>body</frame_name></plugin>"""


def world(plugin: str = "", **options: Any) -> str:
    values = {"world_plugins": "", "rate": 50, "collision": "hull", "topic": "", "plugin": plugin}
    return WORLD.format(**{**values, **options})


@pytest.mark.parametrize(("plugin", "topic"), [(ROS1, "/r/touched"), (ROS2, "/demo/touched")])
def test_the_ground_carries_the_weight(load: Load, listen: Listen, plugin: str, topic: str) -> None:
    sim = load(world(plugin))
    messages = listen(sim, topic)
    sim.run(seconds=1.0)
    message = messages[-1]
    assert len(messages) == 50
    assert message.header.frame_id == "body"
    (state,) = message.states
    assert state.collision1_name == "box::body::hull"
    assert state.collision2_name == "ground_plane::link::collision"
    assert "my geom:box::body::hull" in state.info
    # Wrenches are in the link's axes, whose y points up; points and normals are the world's.
    force, torque = state.total_wrench.force, state.total_wrench.torque
    assert (force.x, force.y, force.z) == pytest.approx((0, 5 * 9.8, 0), abs=0.5)
    assert (torque.x, torque.y, torque.z) == pytest.approx((0, 0, 0), abs=0.2)
    assert sum(wrench.force.y for wrench in state.wrenches) == pytest.approx(force.y)
    assert len(state.wrenches) == len(state.contact_positions) == len(state.depths) == 4
    for position, normal in zip(state.contact_positions, state.contact_normals, strict=True):
        assert abs(position.x - 1) == pytest.approx(0.2, abs=0.01)
        assert (normal.x, normal.y, normal.z) == pytest.approx((0, 0, 1), abs=1e-3)


def test_nothing_touched_is_a_message_without_states(load: Load, listen: Listen) -> None:
    sim = load(world(ROS1).replace("1 2 0.2", "1 2 9"))
    messages = listen(sim, "/r/touched")
    sim.run(seconds=0.1)
    assert [len(message.states) for message in messages] == [0] * 5


def test_contacts_are_not_computed_while_nobody_listens(load: Load) -> None:
    sim = load(world(ROS1))
    asked: list[int] = []
    read = sim.server.sensors.measurements.contacts
    sim.server.sensors.measurements.contacts = lambda place: asked.append(1) or read(place)  # type: ignore[method-assign]
    sim.run(seconds=0.2)
    assert asked == []


def test_gz_worlds_publish_contacts_while_there_are_some(load: Load, listen: Listen) -> None:
    system = '<plugin filename="gz-sim-contact-system" name="gz::sim::systems::Contact"/>'
    sim = load(world(world_plugins=system, topic="<topic>felt</topic>"))
    messages = listen(sim, "/felt")
    sim.run(seconds=0.5)
    (contact,) = messages[-1].contacts
    assert contact.collision1.name == "box::body::hull"
    pushed = sum(item.body_1_wrench.force.z for item in contact.wrenches)
    assert pushed == pytest.approx(5 * 9.8, rel=0.02)
    sim.model("box").pose = sim.model("box").pose.__class__((0.0, 0.0, 50.0))
    sim.step()
    count = len(messages)
    sim.run(seconds=0.1)
    assert len(messages) == count


def test_a_contact_sensor_is_read_on_demand(load: Load) -> None:
    sim = load(world())
    sim.run(seconds=0.5)
    record = sim.sensor("touch").read()
    assert record.force_n == pytest.approx([0, 0, 49.0], abs=0.5)
    # Two thirds of the weight lifted: two thirds less on the ground.
    sim.link("body").apply_wrench(force_n=(0.0, 0.0, 5 * 9.8 * 2 / 3))
    sim.run(seconds=0.5)
    assert sim.sensor("touch").read().force_n[2] == pytest.approx(49.0 / 3, rel=0.02)


def test_a_mistyped_collision_is_reported(load: Load) -> None:
    sim = load(world(ROS1, collision="hul"))
    (found,) = sim.diagnostics.by_code("simulator.no-such-collision")
    assert "watches collision 'hul', which link 'body' does not have" in found.message
    assert "did you mean 'hull'" in found.fix
    assert math.isclose(float(np.linalg.norm(sim.sensor("touch").read().force_n)), 0.0)
