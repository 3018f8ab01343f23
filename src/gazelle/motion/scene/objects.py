"""Things around a robot, and things it carries."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from gazelle.description.model import MeshShape, Plane, Solid
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.motion.joint_space import FloatArray

__all__ = ["AttachedBody", "PlacedShape", "SceneMesh", "SceneShape", "WorldObject"]


@dataclass(frozen=True, eq=False)
class SceneMesh:
    """Triangles that came as numbers, such as a message's.

    Attributes:
        vertices_m: (n, 3).
        faces: (m, 3) places of vertices; the hull of the vertices is meant when there are none.
    """

    vertices_m: FloatArray
    faces: np.ndarray[tuple[int, int], np.dtype[np.int32]]

    def __post_init__(self) -> None:
        if self.vertices_m.ndim != 2 or self.vertices_m.shape[1] != 3 or not len(self.vertices_m):
            raise ValueError(f"vertices have shape {self.vertices_m.shape}, (n, 3) is needed")
        if not np.isfinite(self.vertices_m).all():
            raise ValueError("a mesh has vertices that are not finite")
        if self.faces.size and not 0 <= self.faces.min() <= self.faces.max() < len(self.vertices_m):
            raise ValueError("a mesh has triangles with vertices that are not there")


SceneShape = Solid | Plane | MeshShape | SceneMesh


@dataclass(frozen=True)
class PlacedShape:
    """A shape in an object's frame."""

    shape: SceneShape
    T_object_shape: Pose = IDENTITY_POSE


@dataclass(frozen=True)
class WorldObject:
    """A thing made of shapes.

    Attributes:
        name: unique in the scene, and no link's name.
        shapes: what collides; a plane lies through its frame's origin, see `Plane`.
        T_frame_object: pose in the robot's frame; in the link's frame once it is attached.
        type_name: key of an object data base, kept for messages.
        subframes: poses in the object's frame by name.
    """

    name: str
    shapes: tuple[PlacedShape, ...]
    T_frame_object: Pose = IDENTITY_POSE
    type_name: str = ""
    subframes: Mapping[str, Pose] = field(default_factory=dict)

    @classmethod
    def single(cls, name: str, shape: SceneShape, T_frame_object: Pose) -> WorldObject:
        """Return a thing of one shape."""
        return cls(name, (PlacedShape(shape),), T_frame_object)

    def at(self, T_frame_object: Pose) -> WorldObject:
        """Return the thing elsewhere."""
        return replace(self, T_frame_object=T_frame_object)


@dataclass(frozen=True)
class AttachedBody:
    """A thing that a link carries.

    Attributes:
        body: the thing; its pose is in the link's frame.
        link: what carries it.
        touch_links: links that it may touch; the carrying link always may.
    """

    body: WorldObject
    link: str
    touch_links: frozenset[str] = frozenset()

    @property
    def name(self) -> str:
        """The thing's name."""
        return self.body.name
