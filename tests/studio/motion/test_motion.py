"""``motion.*``: what the panel MotionPlanning asks of the server."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from typing import Any

import pytest
from tests.patience import eventually
from tests.studio.conftest import Talk
from tests.studio.page import Page, RefusedError

from gazelle.graph import Graph, Node
from gazelle.interfaces import fill, service_type

_URDF = """
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="tip"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="3" velocity="4"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="upper"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit effort="3" velocity="4"/>
  </joint>
</robot>
"""
_SRDF = """
<robot name="arm">
  <group name="all"><chain base_link="base" tip_link="tip"/></group>
  <group_state name="up" group="all">
    <joint name="shoulder" value="0.5"/><joint name="wrist" value="0"/>
  </group_state>
  <virtual_joint name="fixed" type="fixed" parent_frame="world" child_link="base"/>
</robot>
"""
_BOX = {
    "id": "lamp", "header": {"frame_id": "world"}, "primitive_poses": [{"orientation": {"w": 1}}],
    "primitives": [{"type": 1, "dimensions": [1, 2, 3]}],
}  # fmt: skip
_TRIANGLES = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n"


@pytest.fixture
def move_group(graph: Graph, node: Node) -> Iterator[Node]:
    """A node that answers for a move_group's scene."""

    def scene(_request: Any) -> Any:
        response: Any = service_type("moveit_msgs/srv/GetPlanningScene").Response()
        state = {"joint_state": {"name": ["shoulder", "wrist"], "position": [0.25, 0.0]}}
        fill(response.scene, {"robot_state": state, "world": {"collision_objects": [_BOX]}})
        return response

    made = graph.create_node("move_group", rosout=False)
    plan = service_type("moveit_msgs/srv/GetMotionPlan")
    made.create_service("plan_kinematic_path", plan, lambda _request: plan.Response())
    made.create_service(
        "get_planning_scene", service_type("moveit_msgs/srv/GetPlanningScene"), scene
    )
    yield made
    made.shutdown()


def test_robot_without_a_move_group_is_told(page: Page) -> None:
    with pytest.raises(RefusedError, match="no move_group is running on this graph"):
        page.call("motion.robot")


def test_robot_has_groups_states_and_limits(page: Page, graph: Graph, move_group: Node) -> None:
    del move_group
    graph.parameters.set("/move_group/robot_description", _URDF)
    graph.parameters.set("/move_group/robot_description_semantic", _SRDF)
    eventually(lambda: "/plan_kinematic_path" in {one.name for one in graph.services()})
    value = page.call("motion.robot")
    assert (value["node"], value["prefix"], value["frame"]) == ("/move_group", "/", "world")
    (group,) = value["groups"]
    assert (group["name"], group["tips"], group["links"]) == ("all", ["tip"], ["upper", "tip"])
    assert group["states"] == {"up": {"shoulder": 0.5, "wrist": 0.0}}
    limits = {one["name"]: one for joint in value["joints"] for one in joint["variables"]}
    assert limits["shoulder"] == {"name": "shoulder", "lower": -1.0, "upper": 2.0}
    assert limits["wrist"] == {"name": "wrist", "lower": None, "upper": None}
    assert [body["link"] for body in value["scene"]["bodies"]] == ["base", "upper", "tip"]
    with pytest.raises(RefusedError, match="no move_group in namespace 'left'") as caught:
        page.call("motion.robot", namespace="left")
    assert caught.value.error["known"] == ["/"]


def test_scene_is_whole_at_first_and_changes_follow(
    page: Page, move_group: Node, talk: Talk
) -> None:
    del move_group
    stream = page.open("motion.scene", topic="/scene_a", service="/get_planning_scene")
    first = stream.next()
    assert first["positions"] == {"shoulder": 0.25, "wrist": 0.0}
    assert [item["id"] for item in first["objects"]] == ["lamp"]
    assert first["objects"][0]["primitives"][0]["dimensions"] == [1.0, 2.0, 3.0]
    kind = "moveit_msgs/msg/PlanningScene"
    moved = {"joint_state": {"name": ["wrist"], "position": [1.5]}, "is_diff": True}
    talk("/scene_a", kind, latch=True, is_diff=True, robot_state=moved)
    second = stream.until(lambda value: value["positions"]["wrist"] == 1.5)
    # Objects that did not change are not sent again.
    assert second["positions"]["shoulder"] == 0.25 and "objects" not in second
    held = {"link_name": "tip", "object": _BOX}
    state = {"is_diff": True, "attached_collision_objects": [held]}
    talk("/scene_a", kind, is_diff=True, robot_state=state)
    third = stream.until(lambda value: "attached" in value)
    assert third["objects"] == [] and third["attached"][0]["link_name"] == "tip"
    gone = {
        "is_diff": True,
        "attached_collision_objects": [{"object": {"id": "lamp", "operation": 1}}],
    }
    talk("/scene_a", kind, is_diff=True, robot_state=gone)
    assert stream.until(lambda value: "attached" in value)["attached"] == []


def test_path_comes_whole(page: Page, talk: Talk) -> None:
    rows = [{"positions": [float(at)]} for at in range(300)]
    joints = {"joint_names": ["wrist"], "points": rows}
    made = {"trajectory": [{"joint_trajectory": joints}], "model_id": "arm"}
    talk("/path_a", "moveit_msgs/msg/DisplayTrajectory", latch=True, **made)
    value = page.open("motion.path", topic="/path_a").next()
    points = value["trajectory"][0]["joint_trajectory"]["points"]
    assert [one["positions"] for one in points] == [[float(at)] for at in range(300)]


def test_mesh_file_becomes_vertices_and_triangles(page: Page) -> None:
    text = base64.b64encode(_TRIANGLES.encode()).decode()
    mesh = page.call("motion.mesh", name="plate.obj", base64=text)
    assert sorted(mesh["vertices"]) == [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]]
    corners = [{tuple(mesh["vertices"][at]) for at in row} for row in mesh["triangles"]]
    assert {(0, 0, 0), (1, 0, 0), (0, 1, 0)} in corners and len(corners) == 2


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("plate.step", _TRIANGLES, "plate.step is no mesh file"),
        ("plate.obj", "v 0 0", "plate.obj"),
    ],
)
def test_file_that_is_no_mesh_is_told(page: Page, name: str, content: str, message: str) -> None:
    text = base64.b64encode(content.encode()).decode()
    with pytest.raises(RefusedError, match=message) as caught:
        page.call("motion.mesh", name=name, base64=text)
    assert "/tmp" not in str(caught.value)
