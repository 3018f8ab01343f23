"""Collision objects as messages: what they make of a scene, and what is told of bad ones."""

from __future__ import annotations

from typing import Any

import pytest
from tests.nodes.move_group.conftest import box_object, parameters, pose

from gazelle.description.moveit import config_from_parameters
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.interfaces import fill, message_type
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.collision_object_messages import apply_attached, apply_object
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.planning_scene_messages import (
    Components,
    apply_scene,
    matrix_of_message,
    scene_message,
)


@pytest.fixture(scope="module")
def scene() -> PlanningScene:
    diagnostics = Diagnostics()
    config = config_from_parameters(parameters(), workspace=None, diagnostics=diagnostics)
    assert config is not None
    return PlanningScene.of(RobotModel.from_config(config, diagnostics=diagnostics))


def _frame_of(scene: PlanningScene, name: str) -> Pose:
    return scene.pose_of(name) if name else Pose()


def _object(**fields: Any) -> Any:
    made: Any = message_type("moveit_msgs/msg/CollisionObject")()
    fill(made, fields)
    return made


def _shapes() -> dict[str, Any]:
    corners = [{"x": 0.0}, {"x": 0.1}, {"y": 0.1}, {"z": 0.1}]
    faces = [{"vertex_indices": row} for row in ([0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3])]
    return {
        "id": "things",
        "pose": pose(0.0, 0.0, 1.0),
        "primitives": [{"type": 3, "dimensions": [0.2, 0.05]}],
        "primitive_poses": [pose(0.1, 0.0, 0.0)],
        "meshes": [{"vertices": corners, "triangles": faces}],
        "mesh_poses": [pose(0.0, 0.2, 0.0)],
        "planes": [{"coef": [0.0, 0.0, 2.0, 1.0]}],
        "plane_poses": [pose(0.0, 0.0, 0.0)],
    }


def test_objects_come_back_as_they_went(scene: PlanningScene) -> None:
    after = apply_object(scene, _object(**_shapes()), _frame_of)
    told = scene_message(after, Components.asked(0), name="s", stamp_ns=0)
    again, problems = apply_scene(scene, told, _frame_of)
    assert not problems
    one, other = after.object("things"), again.object("things")
    assert one.T_frame_object == other.T_frame_object
    assert len(one.shapes) == 3
    for a, b in zip(one.shapes, other.shapes, strict=True):
        assert a.T_object_shape.position_m == pytest.approx(b.T_object_shape.position_m)
    # The plane 2 z + 1 = 0 lies half a metre below its pose.
    assert one.shapes[2].T_object_shape.position_m[2] == pytest.approx(-0.5)
    assert again.allowed.pairs == scene.allowed.pairs


def test_objects_are_moved_extended_and_removed(scene: PlanningScene) -> None:
    after = apply_object(scene, _object(**box_object("box", [0.1] * 3, [1.0, 0.0, 0.0])), _frame_of)
    assert after.object("box").T_frame_object.position_m == (1.0, 0.0, 0.0)
    moved = _object(id="box", operation=3, pose=pose(2.0, 0.0, 0.0))
    after = apply_object(after, moved, _frame_of)
    assert after.object("box").T_frame_object.position_m == (2.0, 0.0, 0.0)
    more = _object(**box_object("box", [0.2] * 3, [2.0, 0.0, 1.0]), operation=2)
    after = apply_object(after, more, _frame_of)
    assert after.object("box").shapes[1].T_object_shape.position_m == (0.0, 0.0, 1.0)
    assert not apply_object(after, _object(operation=1), _frame_of).objects


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"primitives": [{"type": 1, "dimensions": [0.1, 0.0, 0.1]}]}, "a box with dimensions"),
        ({"primitives": [{"type": 9, "dimensions": [0.1]}]}, "a primitive of type 9; there are"),
        ({"primitives": [], "primitive_poses": []}, "object 'box' has no shape"),
        ({"id": ""}, "a collision object has no id"),
        ({"id": "base_link"}, "'base_link' is a link of the robot"),
        ({"operation": 1, "id": "bax"}, "object 'bax' not found"),
        ({"operation": 7}, "object 'box' has unknown operation 7"),
    ],
)
def test_bad_objects_are_told(scene: PlanningScene, change: dict[str, Any], text: str) -> None:
    item = _object(**{**box_object("box", [0.1] * 3, [1.0, 0.0, 0.0]), **change})
    with pytest.raises(MoveGroupError) as caught:
        apply_object(scene, item, _frame_of)
    assert text in caught.value.reason


def test_attaching_what_is_not_there_is_told(scene: PlanningScene) -> None:
    item: Any = message_type("moveit_msgs/msg/AttachedCollisionObject")(link_name="tool_link")
    item.object.id = "cube"
    with pytest.raises(MoveGroupError, match="object 'cube' not found"):
        apply_attached(scene, item, _frame_of)
    item.link_name = "tool"
    with pytest.raises(MoveGroupError, match="cannot be attached to 'tool': the robot has the"):
        apply_attached(scene, item, _frame_of)
    item.object.operation = 1
    with pytest.raises(MoveGroupError, match=r"nothing named 'cube' is attached to 'tool'"):
        apply_attached(scene, item, _frame_of)


def test_octomaps_and_scaled_links_are_told_not_to_count(scene: PlanningScene) -> None:
    message: Any = message_type("moveit_msgs/msg/PlanningScene")()
    world = {"octomap": {"octomap": {"data": [1, 2]}}}
    fill(message, {"is_diff": True, "world": world, "link_scale": [{"scale": 1.1}]})
    _, problems = apply_scene(scene, message, _frame_of)
    assert problems == (
        "link_scale is not honoured; write link_padding instead",
        "an octomap is not collided with; send collision objects instead",
    )


def test_a_matrix_keeps_what_a_default_would_change() -> None:
    message: Any = message_type("moveit_msgs/msg/AllowedCollisionMatrix")()
    rows = [{"enabled": [False, True, False]}, {"enabled": [True, False, False]},
            {"enabled": [False, False, False]}]  # fmt: skip
    fill(message, {"entry_names": ["a", "b", "c"], "entry_values": rows,
                   "default_entry_names": ["c"], "default_entry_values": [True]})  # fmt: skip
    allowed = matrix_of_message(message)
    assert allowed.allows("a", "b") and not allowed.allows("a", "c")
    assert allowed.allows("c", "elsewhere")
