"""Contact sensors as ``gz topic`` of Gazebo Classic shows them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.graph.gazebo_names import hidden_transport_name, shown_transport_name
from gazelle.simulator import Simulation

Run = Callable[..., Any]

# The sensor names the foot as sdformat calls it once it is lumped into the leg.
LEGGED = """<robot name="dog-1">
  <link name="leg"><inertial><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="ankle" type="fixed"><parent link="leg"/><child link="foot"/></joint>
  <link name="foot"><inertial><mass value="0.1"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <gazebo reference="leg"><sensor name="touch" type="contact"><update_rate>100</update_rate>
    <contact><collision>leg_fixed_joint_lump__foot_collision</collision></contact>
  </sensor></gazebo>
</robot>"""
TOPIC = "/gazebo/default/dog-1/leg/touch"


@pytest.fixture
def standing(world: Simulation) -> Simulation:
    server = world.server
    pose = Pose((4.0, 0.0, 0.1))
    server.commands.call(lambda: world.spawn(LEGGED, pose=pose))
    server.unpause()
    return world


def test_each_contact_sensor_has_its_topics(standing: Simulation, gz: Run) -> None:
    listed = gz("topic", "-l").out.splitlines()
    assert {TOPIC, f"{TOPIC}/contacts", "/gazebo/default/physics/contacts"} <= set(listed)
    assert gz("topic", "-i", "~/dog-1/leg/touch").out.startswith("Type: gazebo.msgs.Contacts\n")
    topics = standing.server.node.graph.topics()  # type: ignore[attr-defined]
    assert not [one.name for one in topics if "touch" in one.name]


@pytest.mark.parametrize("topic", [TOPIC, f"{TOPIC}/contacts"])
def test_a_standing_foot_tells_its_contacts(standing: Simulation, gz: Run, topic: str) -> None:
    lines = gz("topic", "-e", topic, "-d", "1").out.splitlines()
    at = lines.index("contact {")
    assert lines[at + 1] == '  collision1: "dog-1::foot::foot_collision"'
    assert lines[at + 2].startswith('  collision2: "ground_plane::')
    assert '    body_1_name: "dog-1::foot"' in lines
    assert '  world: "default"' in lines


@pytest.mark.parametrize("name", ["/dog-1", "dog//1", "1 dog/"])
def test_a_model_of_any_name_is_placed_with_its_sensors(
    world: Simulation, gz: Run, name: str
) -> None:
    robot = LEGGED.replace('name="dog-1"', f'name="{name}"')
    world.server.commands.call(lambda: world.spawn(robot, pose=Pose((4.0, 0.0, 0.1))))
    plain = name.replace("//", "/").strip("/")
    assert f"/gazebo/default/{plain}/leg/touch" in gz("topic", "-l").out.splitlines()


def test_all_contacts_of_the_world_are_told(standing: Simulation, gz: Run) -> None:
    told = gz("topic", "-e", "~/physics/contacts", "-d", "1").out
    assert "dog-1::foot::foot_collision" in told


@pytest.mark.parametrize("name", ["~/a b/my-robot/l", "/up/there", "plain"])
def test_names_of_the_transport_come_back(name: str) -> None:
    full = "/" + name.replace("~", "/gazebo/w").strip("/")
    hidden = hidden_transport_name(name, "w")
    assert hidden.replace("/", "").replace("_", "").isalnum()
    assert shown_transport_name(hidden) == full
    assert not shown_transport_name(full)
