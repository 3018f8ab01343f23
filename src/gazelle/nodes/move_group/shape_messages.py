"""``shape_msgs`` and shapes of planning scenes."""

from __future__ import annotations

from typing import Any, assert_never

import numpy as np

from gazelle.description.model import (
    Box,
    Cone,
    Cylinder,
    MeshShape,
    Plane,
    Solid,
    Sphere,
)
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import PlacedShape, SceneMesh, SceneShape
from gazelle.nodes.move_group.error_codes import MoveGroupError

__all__ = ["add_shapes", "mesh_shape", "plane_shape", "pose_message", "primitive_shape"]

_COUNTS = {1: ("box", 3), 2: ("sphere", 1), 3: ("cylinder", 2), 4: ("cone", 2)}


def primitive_shape(message: Any, owner: str) -> SceneShape:
    """Return the shape of a ``SolidPrimitive``.

    Args:
        message: the primitive.
        owner: the object it belongs to, for the error.

    Raises:
        MoveGroupError: its type or its dimensions make no shape.
    """
    known = _COUNTS.get(int(message.type))
    if known is None:
        text = f"object '{owner}' has a primitive of type {message.type}; there are boxes (1), "
        raise _bad(text + "spheres (2), cylinders (3) and cones (4)")
    name, count = known
    sizes = [float(size) for size in message.dimensions[:count]]
    if len(sizes) < count or not all(size > 0 and np.isfinite(size) for size in sizes):
        raise _bad(f"object '{owner}' has a {name} with dimensions {sizes}, {count} above 0 needed")
    if name == "box":
        return Box((sizes[0], sizes[1], sizes[2]))
    if name == "sphere":
        return Sphere(sizes[0])
    made = Cylinder if name == "cylinder" else Cone
    return made(radius_m=sizes[1], length_m=sizes[0])


def mesh_shape(message: Any, owner: str) -> SceneMesh:
    """Return the shape of a ``Mesh``.

    Raises:
        MoveGroupError: it has no vertices, or triangles without them.
    """
    vertices = np.array([(p.x, p.y, p.z) for p in message.vertices], dtype=np.float64)
    faces = np.array([list(one.vertex_indices) for one in message.triangles], dtype=np.int32)
    try:
        return SceneMesh(vertices.reshape(-1, 3), faces.reshape(-1, 3))
    except ValueError as error:
        raise _bad(f"object '{owner}': {error}") from error


def plane_shape(message: Any, owner: str) -> PlacedShape:
    """Return the shape of a ``Plane`` ``ax + by + cz + d = 0`` in its pose.

    Raises:
        MoveGroupError: it has no normal.
    """
    a, b, c, d = (float(value) for value in message.coef)
    normal = np.array([a, b, c])
    length = float(np.linalg.norm(normal))
    if not length > 0 or not np.isfinite(length):
        raise _bad(f"object '{owner}' has a plane with the normal ({a:g}, {b:g}, {c:g})")
    x, y, z = (normal / length).tolist()
    shift = (-d / length) * (normal / length)
    return PlacedShape(Plane((x, y, z)), Pose((float(shift[0]), float(shift[1]), float(shift[2]))))


def add_shapes(message: Any, shapes: tuple[PlacedShape, ...]) -> None:
    """Put shapes into a ``CollisionObject``.

    Raises:
        ValueError: a message has no room for a shape; none that came by a message is such.
    """
    for placed in shapes:
        shape, pose = placed.shape, pose_message(placed.T_object_shape)
        if isinstance(shape, Plane):
            message.planes.append(message_type("shape_msgs/msg/Plane")(coef=[*shape.normal, 0.0]))
            message.plane_poses.append(pose)
            continue
        primitive = _primitive(shape)
        if primitive is None:
            message.meshes.append(_mesh(shape))
            message.mesh_poses.append(pose)
        else:
            message.primitives.append(primitive)
            message.primitive_poses.append(pose)


def pose_message(pose: Pose) -> Any:
    """Return a ``geometry_msgs/Pose``."""
    made: Any = message_type("geometry_msgs/msg/Pose")()
    set_pose(made, pose)
    return made


def _primitive(shape: SceneShape) -> Any | None:
    match shape:
        case Box(size_m=size):
            kind, sizes = 1, list(size)
        case Sphere(radius_m=radius):
            kind, sizes = 2, [radius]
        case Cylinder(radius_m=radius, length_m=length):
            kind, sizes = 3, [length, radius]
        case Cone(radius_m=radius, length_m=length):
            kind, sizes = 4, [length, radius]
        case Solid() | Plane() | MeshShape() | SceneMesh():
            return None
        case _:
            assert_never(shape)
    return message_type("shape_msgs/msg/SolidPrimitive")(type=kind, dimensions=sizes)


def _mesh(shape: SceneShape) -> Any:
    if isinstance(shape, Solid):
        part = shape.mesh()
        shape = SceneMesh(part.vertices_m, part.faces)
    if not isinstance(shape, SceneMesh):
        raise ValueError(f"shape_msgs has no {type(shape).__name__}")
    point = message_type("geometry_msgs/msg/Point")
    triangle = message_type("shape_msgs/msg/MeshTriangle")
    made: Any = message_type("shape_msgs/msg/Mesh")()
    made.vertices = [point(x=x, y=y, z=z) for x, y, z in shape.vertices_m.tolist()]
    made.triangles = [triangle(vertex_indices=row) for row in shape.faces.tolist()]
    return made


def _bad(text: str) -> MoveGroupError:
    return MoveGroupError(ErrorCode.INVALID_OBJECT_NAME, text)
