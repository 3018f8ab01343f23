"""The world plug-ins of ROS 2 that ask for, set and publish states and properties."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.interfaces import service_type
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]

WORLD = """<sdf version="1.6"><world name="default">
  <plugin name="states" filename="libgazebo_ros_state.so">
    <ros><namespace>/demo</namespace>
      <remapping>model_states:=model_states_demo</remapping>
      <remapping>set_entity_state:=place</remapping></ros>
    <update_rate>20.0</update_rate>
  </plugin>
  <plugin name="properties" filename="libgazebo_ros_properties.so">
    <ros><namespace>/demo</namespace></ros>
  </plugin>
  <light name="lamp" type="point"><pose>1 2 3 0 0 0</pose><diffuse>0.5 0.25 1 1</diffuse></light>
  <model name="door"><pose>0 0 1 0 0 0</pose>
    <link name="frame"><inertial><mass>5</mass></inertial></link>
    <link name="leaf"><inertial><mass>2</mass></inertial>
      <collision name="board"><geometry><box><size>1 0.1 1</size></box></geometry></collision>
    </link>
    <joint name="fix" type="fixed"><parent>world</parent><child>frame</child></joint>
    <joint name="hinge" type="revolute"><parent>frame</parent><child>leaf</child>
      <axis><xyz>0 0 1</xyz></axis></joint>
  </model>
  <model name="ball"><pose>4 0 1 0 0 0</pose><link name="link"/></model>
</world></sdf>"""


@pytest.fixture
def sim(load: Load, tmp_path: Path) -> Simulation:
    path = tmp_path / "demo.world"
    path.write_text(WORLD)
    return load(world=path)


def call(sim: Simulation, name: str, kind: str, /, **fields: Any) -> Any:
    request = service_type(f"gazebo_msgs/{kind}").Request(**fields)
    return sim.server.node.call(name, request)  # type: ignore[attr-defined]


def entity_state(sim: Simulation, name: str, frame: str = "") -> Any:
    kind = "GetEntityState"
    return call(sim, "/demo/get_entity_state", kind, name=name, reference_frame=frame)


def position(state: Any) -> tuple[float, float, float]:
    point = state.pose.position
    return (point.x, point.y, point.z)


def test_states_are_told_below_the_namespace(sim: Simulation) -> None:
    answer = entity_state(sim, "ball", "door::frame")
    assert answer.success
    assert position(answer.state) == pytest.approx((4.0, 0.0, 0.0))
    lamp = entity_state(sim, "lamp")
    assert position(lamp.state) == pytest.approx((1.0, 2.0, 3.0))


def test_an_unknown_entity_is_named_in_the_log(
    sim: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    assert not entity_state(sim, "bal").success
    assert not entity_state(sim, "ball", "leaf").success
    assert [one.getMessage() for one in caplog.records if one.levelname == "ERROR"] == [
        "GetEntityState: entity [bal] does not exist; did you mean 'ball'?",
        "GetEntityState: reference entity [leaf] not found, did you forget to scope the entity"
        " name?; did you mean 'door::leaf'?",
    ]


@pytest.mark.parametrize("name", ["ball", "lamp"])
def test_a_state_is_set_under_the_remapped_name(sim: Simulation, name: str) -> None:
    wanted = entity_state(sim, name).state
    wanted.name, wanted.pose.position.x, wanted.reference_frame = name, 7.0, "world"
    assert call(sim, "/demo/place", "SetEntityState", state=wanted).success
    assert entity_state(sim, name).state.pose.position.x == pytest.approx(7.0)


def test_states_are_published_at_the_rate(
    sim: Simulation, listen: Callable[[Simulation, str], list[Any]]
) -> None:
    models = listen(sim, "/demo/model_states_demo")
    links = listen(sim, "/demo/link_states")
    sim.run(seconds=1.0)
    assert (len(models), len(links)) == (20, 20)
    assert models[-1].name == ["door", "ball"]
    assert links[-1].name == ["door::frame", "door::leaf", "ball::link"]


def test_properties_are_told_with_scoped_links(sim: Simulation) -> None:
    found = call(sim, "/demo/get_model_properties", "GetModelProperties", model_name="door")
    assert found.success
    assert found.body_names == ["door::frame", "door::leaf"]
    assert found.canonical_body_name == "door::frame"
    assert found.joint_names == ["fix", "hinge"]
    light = call(sim, "/demo/get_light_properties", "GetLightProperties", light_name="lamp")
    assert (light.diffuse.r, light.diffuse.g) == (0.5, 0.25)
    assert call(sim, "/demo/get_joint_properties", "GetJointProperties", joint_name="hinge").success


def test_properties_are_set(sim: Simulation) -> None:
    name = "door::leaf"
    link = call(sim, "/demo/get_link_properties", "GetLinkProperties", link_name=name)
    assert link.mass == 2.0
    changed = {field: getattr(link, field) for field in ("com", "ixx", "iyy", "izz")}
    kind = "SetLinkProperties"
    assert call(sim, "/demo/set_link_properties", kind, link_name=name, mass=3.0, **changed).success
    link = call(sim, "/demo/get_link_properties", "GetLinkProperties", link_name=name)
    assert link.mass == 3.0
