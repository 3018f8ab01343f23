"""``moveit_msgs/PlanningScene`` applied to planning scenes, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from enum import IntFlag
from typing import Any

from gazelle.interfaces import message_type
from gazelle.motion.scene import AllowedCollisions, PlanningScene
from gazelle.nodes.move_group.collision_object_messages import (
    FrameOf,
    apply_attached,
    apply_object,
    attached_message,
    object_message,
)
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.robot_state_messages import positions_of, robot_state_message

__all__ = ["Components", "apply_robot_state", "apply_scene", "matrix_of_message", "scene_message"]

_EVERYTHING = 1023


class Components(IntFlag):
    """``moveit_msgs/PlanningSceneComponents``: which parts of a scene are asked for."""

    SCENE_SETTINGS = 1
    ROBOT_STATE = 2
    ROBOT_STATE_ATTACHED_OBJECTS = 4
    WORLD_OBJECT_NAMES = 8
    WORLD_OBJECT_GEOMETRY = 16
    OCTOMAP = 32
    TRANSFORMS = 64
    ALLOWED_COLLISION_MATRIX = 128
    LINK_PADDING_AND_SCALING = 256
    OBJECT_COLORS = 512

    @classmethod
    def asked(cls, number: int) -> Components:
        """Return what a request asks for; nothing means everything, as in MoveIt."""
        return cls(number & _EVERYTHING or _EVERYTHING)


def apply_scene(
    scene: PlanningScene, message: Any, frame_of: FrameOf
) -> tuple[PlanningScene, tuple[str, ...]]:
    """Return the scene after a ``PlanningScene``, and what could not be done of it.

    A message that is no diff replaces all objects, attached ones too, and the allowed collisions.

    Args:
        scene: before.
        message: a diff or a whole scene.
        frame_of: resolves frames.
    """
    problems: list[str] = []
    if not message.is_diff:
        scene = replace(scene, objects={}, attached={}, padding_m={})
        scene = scene.with_allowed(AllowedCollisions.from_srdf(scene.robot.srdf))
    matrix = message.allowed_collision_matrix
    if len(matrix.entry_names) or len(matrix.default_entry_names):
        scene = scene.with_allowed(matrix_of_message(matrix))
    padding = {row.link_name: float(row.padding) for row in message.link_padding}
    scene = replace(scene, padding_m={**scene.padding_m, **padding})
    if any(row.scale != 1.0 for row in message.link_scale):
        problems.append("link_scale is not honoured; write link_padding instead")
    if len(message.world.octomap.octomap.data):
        problems.append("an octomap is not collided with; send collision objects instead")
    for item in message.world.collision_objects:
        scene = _tried(problems, scene, apply_object, item, frame_of)
    try:
        scene = apply_robot_state(scene, message.robot_state, frame_of)
    except MoveGroupError as error:
        problems.append(error.reason)
    return scene, tuple(problems)


def apply_robot_state(scene: PlanningScene, state: Any, frame_of: FrameOf) -> PlanningScene:
    """Return the scene with the robot as a ``RobotState`` has it, attached objects too.

    Raises:
        MoveGroupError: it names joints, links or objects that are not there.
    """
    scene = scene.with_positions(positions_of(state, scene.robot, scene.positions))
    if len(state.attached_collision_objects) and not state.is_diff:
        scene = replace(scene, attached={})
    for item in state.attached_collision_objects:
        scene = apply_attached(scene, item, frame_of)
    return scene


def matrix_of_message(message: Any) -> AllowedCollisions:
    """Return the allowed collisions of a matrix.

    A pair that a whole matrix does not allow is kept only where a default would allow it.
    """
    defaults = {
        name: bool(value)
        for name, value in zip(
            message.default_entry_names, message.default_entry_values, strict=False
        )
    }
    pairs: dict[frozenset[str], bool] = {}
    names = list(message.entry_names)
    for name, row in zip(names, message.entry_values, strict=False):
        for other, value in zip(names, row.enabled, strict=False):
            allowed = bool(value)
            if other != name and (allowed or defaults.get(name) or defaults.get(other)):
                pairs[frozenset((name, other))] = allowed
    return AllowedCollisions(pairs, defaults)


def scene_message(
    scene: PlanningScene,
    parts: Components,
    *,
    name: str,
    stamp_ns: int,
    colors: Mapping[str, Any] | None = None,
) -> Any:
    """Return the message of a scene, as ``/get_planning_scene`` answers.

    Args:
        scene: what is told.
        parts: which parts of it.
        name: of the scene.
        stamp_ns: when the robot was there.
        colors: ``ColorRGBA`` by object.
    """
    robot = scene.robot
    made: Any = message_type("moveit_msgs/msg/PlanningScene")()
    if Components.SCENE_SETTINGS in parts:
        made.name, made.robot_model_name = name, robot.name
    if Components.ROBOT_STATE in parts:
        made.robot_state = robot_state_message(
            robot, scene.positions, frame=robot.frame, stamp_ns=stamp_ns
        )
    if parts & (Components.ROBOT_STATE_ATTACHED_OBJECTS | Components.ROBOT_STATE):
        attached = [attached_message(body) for body in scene.attached.values()]
        made.robot_state.attached_collision_objects = attached
    if parts & (Components.WORLD_OBJECT_NAMES | Components.WORLD_OBJECT_GEOMETRY):
        geometry = Components.WORLD_OBJECT_GEOMETRY in parts
        made.world.collision_objects = [
            object_message(item, robot.frame, geometry=geometry) for item in scene.objects.values()
        ]
    if Components.ALLOWED_COLLISION_MATRIX in parts:
        made.allowed_collision_matrix = _matrix_message(scene.allowed)
    if Components.LINK_PADDING_AND_SCALING in parts:
        _add_padding(made, scene)
    if Components.OBJECT_COLORS in parts and colors:
        kind = message_type("moveit_msgs/msg/ObjectColor")
        made.object_colors = [kind(id=key, color=value) for key, value in colors.items()]
    return made


def _tried(
    problems: list[str], scene: PlanningScene, change: Any, item: Any, frame_of: FrameOf
) -> PlanningScene:
    try:
        return change(scene, item, frame_of)  # type: ignore[no-any-return]
    except MoveGroupError as error:
        problems.append(error.reason)
        return scene


def _matrix_message(allowed: AllowedCollisions) -> Any:
    made: Any = message_type("moveit_msgs/msg/AllowedCollisionMatrix")()
    entry = message_type("moveit_msgs/msg/AllowedCollisionEntry")
    names = sorted({name for pair in allowed.pairs for name in pair})
    made.entry_names = names
    made.entry_values = [
        entry(enabled=[allowed.pairs.get(frozenset((name, other)), False) for other in names])
        for name in names
    ]
    made.default_entry_names = list(allowed.defaults)
    made.default_entry_values = list(allowed.defaults.values())
    return made


def _add_padding(made: Any, scene: PlanningScene) -> None:
    padding, scale = (message_type(f"moveit_msgs/msg/Link{one}") for one in ("Padding", "Scale"))
    for link in scene.robot.links:
        made.link_padding.append(padding(link_name=link, padding=scene.padding_m.get(link, 0.0)))
        made.link_scale.append(scale(link_name=link, scale=1.0))
