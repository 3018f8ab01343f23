"""``CollisionObject`` and ``AttachedCollisionObject`` applied to planning scenes, and back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from enum import IntEnum
from typing import Any

from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import AttachedBody, PlacedShape, PlanningScene, WorldObject
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.shape_messages import (
    add_shapes,
    mesh_shape,
    plane_shape,
    pose_message,
    primitive_shape,
)

__all__ = ["FrameOf", "apply_attached", "apply_object", "attached_message", "object_message"]

FrameOf = Callable[[PlanningScene, str], Pose]
"""Pose of a frame in the robot's frame; raises `MoveGroupError` for one nobody knows."""


class _Operation(IntEnum):
    """``moveit_msgs/CollisionObject.operation``."""

    ADD = 0
    REMOVE = 1
    APPEND = 2
    MOVE = 3


def apply_object(scene: PlanningScene, message: Any, frame_of: FrameOf) -> PlanningScene:
    """Return the scene with a ``CollisionObject`` added, removed, extended or moved.

    Raises:
        MoveGroupError: it is not there, has no shape, or a frame is not known.
    """
    operation = _operation(message)
    if operation is _Operation.REMOVE:
        return _removed(scene, message.id)
    if not message.id:
        raise _bad("a collision object has no id")
    if operation is _Operation.MOVE:
        item = _of_world(scene, message.id)
        return scene.with_object(item.at(_placed(scene, message, frame_of)[0]))
    made = _world_object(scene, message, frame_of)
    known = scene.objects.get(message.id)
    if operation is _Operation.APPEND and known is not None:
        to_known = known.T_frame_object.inverse() @ made.T_frame_object
        more = tuple(PlacedShape(s.shape, to_known @ s.T_object_shape) for s in made.shapes)
        made = replace(known, shapes=(*known.shapes, *more))
    try:
        return scene.with_object(made)
    except ValueError as error:
        raise _bad(str(error)) from error


def apply_attached(scene: PlanningScene, message: Any, frame_of: FrameOf) -> PlanningScene:
    """Return the scene with an ``AttachedCollisionObject`` attached or let go.

    Raises:
        MoveGroupError: there is no such object or link, or a frame is not known.
    """
    item, link = message.object, message.link_name
    if _operation(item) is _Operation.REMOVE:
        return _let_go(scene, item.id, link)
    if link not in scene.robot.joint_above:
        raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, _no_link(scene, link, item.id))
    touch = frozenset(message.touch_links)
    has_shapes = any(len(getattr(item, name)) for name in ("primitives", "meshes", "planes"))
    if not has_shapes:
        known = scene.attached.get(item.id)
        if known is not None:
            scene = scene.detach(item.id)
        _of_world(scene, item.id)
        return scene.attach(item.id, link, touch or (known.touch_links if known else ()))
    body = _world_object(scene, item, frame_of)
    if _operation(item) is _Operation.APPEND and item.id in scene.attached:
        known_body = scene.attached[item.id]
        scene = apply_object(scene.detach(item.id), item, frame_of)
        return scene.attach(item.id, link, touch | known_body.touch_links)
    T_link_object = scene.pose_of(link).inverse() @ body.T_frame_object
    return scene.with_attached(AttachedBody(body.at(T_link_object), link, touch))


def object_message(item: WorldObject, frame: str, *, geometry: bool = True) -> Any:
    """Return the ``CollisionObject`` of a thing, its pose in a frame."""
    made: Any = message_type("moveit_msgs/msg/CollisionObject")(id=item.name)
    made.header.frame_id = frame
    made.pose = pose_message(item.T_frame_object)
    made.type.key = item.type_name
    made.operation = int(_Operation.ADD)
    if geometry:
        add_shapes(made, item.shapes)
    for name, pose in item.subframes.items():
        made.subframe_names.append(name)
        made.subframe_poses.append(pose_message(pose))
    return made


def attached_message(body: AttachedBody) -> Any:
    """Return the ``AttachedCollisionObject`` of an attached thing, its pose in the link."""
    made: Any = message_type("moveit_msgs/msg/AttachedCollisionObject")(link_name=body.link)
    made.object = object_message(body.body, body.link)
    made.touch_links = sorted(body.touch_links)
    return made


def _world_object(scene: PlanningScene, message: Any, frame_of: FrameOf) -> WorldObject:
    pose, shapes = _placed(scene, message, frame_of)
    if not shapes:
        raise _bad(f"object '{message.id}' has no shape")
    subframes = {
        name: pose_of(item)
        for name, item in zip(message.subframe_names, message.subframe_poses, strict=False)
    }
    return WorldObject(message.id, shapes, pose, message.type.key, subframes)


def _placed(
    scene: PlanningScene, message: Any, frame_of: FrameOf
) -> tuple[Pose, tuple[PlacedShape, ...]]:
    """Return the object's pose in the robot's frame and its shapes in the object's.

    As in MoveIt an object of one shape and without a pose of its own has the shape's pose.
    """
    T_robot_frame = frame_of(scene, message.header.frame_id)
    own = pose_of(message.pose)
    shapes = _shapes(message)
    poses = [*message.primitive_poses, *message.mesh_poses, *message.plane_poses]
    if _is_empty(message.pose) and len(poses) == 1:
        own = pose_of(poses[0])
        shapes = tuple(PlacedShape(s.shape, own.inverse() @ s.T_object_shape) for s in shapes)
    return T_robot_frame @ own, shapes


def _shapes(message: Any) -> tuple[PlacedShape, ...]:
    found: list[PlacedShape] = []
    for shape, pose in _pairs(message.primitives, message.primitive_poses, message.id):
        found.append(PlacedShape(primitive_shape(shape, message.id), pose))
    for shape, pose in _pairs(message.meshes, message.mesh_poses, message.id):
        found.append(PlacedShape(mesh_shape(shape, message.id), pose))
    for shape, pose in _pairs(message.planes, message.plane_poses, message.id):
        plane = plane_shape(shape, message.id)
        found.append(PlacedShape(plane.shape, pose @ plane.T_object_shape))
    return tuple(found)


def _pairs(shapes: Sequence[Any], poses: Sequence[Any], owner: str) -> list[tuple[Any, Pose]]:
    """Shapes with their poses; MoveIt takes missing poses for none when all are missing."""
    if not len(poses):
        return [(shape, Pose()) for shape in shapes]
    if len(poses) != len(shapes) and len(shapes):
        raise _bad(f"object '{owner}' has {len(shapes)} shapes of a kind and {len(poses)} poses")
    return [(shape, pose_of(pose)) for shape, pose in zip(shapes, poses, strict=False)]


def _removed(scene: PlanningScene, name: str) -> PlanningScene:
    if not name:
        return replace(scene, objects={})
    _of_world(scene, name)
    return scene.without_object(name)


def _let_go(scene: PlanningScene, name: str, link: str) -> PlanningScene:
    """Attached things go back into the world; without a name all of the link, or of all links."""
    chosen = [
        body.name
        for body in scene.attached.values()
        if name in ("", body.name) and link in ("", body.link)
    ]
    if name and not chosen:
        there = ", ".join(scene.attached) or "none"
        raise _bad(
            f"nothing named '{name}' is attached to '{link or 'the robot'}' (attached: {there})"
        )
    for one in chosen:
        scene = scene.detach(one)
    return scene


def _of_world(scene: PlanningScene, name: str) -> WorldObject:
    try:
        return scene.object(name)
    except NotFoundError as error:
        raise _bad(str(error)) from error


def _operation(message: Any) -> _Operation:
    value = message.operation
    number = value[0] if isinstance(value, bytes) else int(value)
    try:
        return _Operation(number)
    except ValueError as error:
        raise _bad(f"object '{message.id}' has unknown operation {number}") from error


def _is_empty(pose: Any) -> bool:
    place, turn = pose.position, pose.orientation
    return not any((place.x, place.y, place.z, turn.x, turn.y, turn.z)) and turn.w in (0.0, 1.0)


def _no_link(scene: PlanningScene, link: str, name: str) -> str:
    links = ", ".join(scene.robot.links)
    return f"object '{name}' cannot be attached to '{link}': the robot has the links {links}"


def _bad(text: str) -> MoveGroupError:
    return MoveGroupError(ErrorCode.INVALID_OBJECT_NAME, text)
