"""A robot in its surroundings at one moment: what is around it, what it carries, what may touch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from gazelle.description.model import MeshShape, Plane, Solid
from gazelle.description.srdf import Srdf
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import RobotModel

__all__ = [
    "AllowedCollisions",
    "AttachedBody",
    "PlacedShape",
    "PlanningScene",
    "SceneMesh",
    "SceneShape",
    "WorldObject",
]


Pair = frozenset[str]


@dataclass(frozen=True)
class AllowedCollisions:
    """MoveIt's allowed collision matrix.

    A pair's own entry counts before the defaults of its members. Of two defaults both have to
    allow; a member without a default has no say.

    Attributes:
        pairs: True for pairs that may touch, False for pairs that may not.
        defaults: the same for one member with everything else.
    """

    pairs: Mapping[Pair, bool] = field(default_factory=dict)
    defaults: Mapping[str, bool] = field(default_factory=dict)

    @classmethod
    def from_srdf(cls, srdf: Srdf) -> AllowedCollisions:
        """Return what an SRDF disables and enables; disabled pairs have the last word."""
        pairs = {frozenset((item.link1, item.link2)): False for item in srdf.enabled_pairs}
        pairs |= {frozenset((item.link1, item.link2)): True for item in srdf.disabled_pairs}
        return cls(pairs, dict.fromkeys(srdf.no_default_collisions, True))

    def allows(self, first: str, second: str) -> bool:
        """Return whether two may touch."""
        own = self.pairs.get(frozenset((first, second)))
        if own is not None:
            return own
        said = [self.defaults[name] for name in (first, second) if name in self.defaults]
        return bool(said) and all(said)

    def with_pair(self, first: str, second: str, allowed: bool) -> AllowedCollisions:
        """Return the matrix with an entry for one pair."""
        return replace(self, pairs={**self.pairs, frozenset((first, second)): allowed})

    def with_pairs(self, name: str, others: Iterable[str], allowed: bool) -> AllowedCollisions:
        """Return the matrix with entries for one member and several others."""
        new = {frozenset((name, other)): allowed for other in others if other != name}
        return replace(self, pairs={**self.pairs, **new})

    def with_default(self, name: str, allowed: bool | None) -> AllowedCollisions:
        """Return the matrix with a member's default; None takes it away."""
        defaults = {key: value for key, value in self.defaults.items() if key != name}
        if allowed is not None:
            defaults[name] = allowed
        return replace(self, defaults=defaults)

    def without(self, name: str) -> AllowedCollisions:
        """Return the matrix without any entry of a member."""
        pairs = {pair: value for pair, value in self.pairs.items() if name not in pair}
        return replace(self.with_default(name, None), pairs=pairs)


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


@dataclass(frozen=True, eq=False)
class PlanningScene:
    """What there is to collide with.

    A scene never changes; every change gives another one, which shares what is equal.

    Attributes:
        robot: the robot.
        positions: (v,), of all its variables, rad or m.
        objects: things around it by name.
        attached: things it carries by name.
        allowed: pairs that may touch.
        padding_m: how much larger links are taken than they are, by link.
    """

    robot: RobotModel
    positions: FloatArray
    objects: Mapping[str, WorldObject] = field(default_factory=dict)
    attached: Mapping[str, AttachedBody] = field(default_factory=dict)
    allowed: AllowedCollisions = field(default_factory=AllowedCollisions)
    padding_m: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, robot: RobotModel) -> PlanningScene:
        """Return an empty scene with the robot at its default positions."""
        allowed = AllowedCollisions.from_srdf(robot.srdf)
        return cls(robot, robot.default_positions(), allowed=allowed)

    def with_positions(self, positions: FloatArray | Mapping[str, float]) -> PlanningScene:
        """Return the scene with the robot at positions (v,); names change only those named.

        Raises:
            NotFoundError: the robot has no such joint.
        """
        if isinstance(positions, Mapping):
            positions = self.robot.positions(positions, self.positions)
        return replace(self, positions=positions)

    def with_object(self, item: WorldObject) -> PlanningScene:
        """Return the scene with a thing put into it, in place of one of the same name.

        Raises:
            ValueError: a link has that name.
        """
        if item.name in self.robot.joint_above:
            raise ValueError(
                f"'{item.name}' is a link of the robot, an object cannot have its name"
            )
        attached = {name: one for name, one in self.attached.items() if name != item.name}
        return replace(self, objects={**self.objects, item.name: item}, attached=attached)

    def without_object(self, name: str) -> PlanningScene:
        """Return the scene without a thing.

        Raises:
            NotFoundError: it is not there.
        """
        self.object(name)
        left = {key: item for key, item in self.objects.items() if key != name}
        return replace(self, objects=left)

    def object(self, name: str) -> WorldObject:
        """Return a thing that is not attached.

        Raises:
            NotFoundError: it is not there.
        """
        found = self.objects.get(name)
        if found is None:
            raise self._missing("object", name, self.objects)
        return found

    def with_attached(self, body: AttachedBody) -> PlanningScene:
        """Return the scene with a thing on a link; a thing of that name in the world goes away.

        Raises:
            NotFoundError: there is no such link.
        """
        self._check_link(body.link)
        left = {key: item for key, item in self.objects.items() if key != body.name}
        return replace(self, objects=left, attached={**self.attached, body.name: body})

    def attach(self, name: str, link: str, touch_links: Iterable[str] = ()) -> PlanningScene:
        """Return the scene with a thing of the world attached to a link where it is now.

        Raises:
            NotFoundError: there is no such thing or link.
        """
        item = self.object(name)
        self._check_link(link)
        T_link_object = self.pose_of(link).inverse() @ item.T_frame_object
        body = AttachedBody(item.at(T_link_object), link, frozenset(touch_links))
        return self.with_attached(body)

    def detach(self, name: str) -> PlanningScene:
        """Return the scene with an attached thing left in the world where it is now.

        Raises:
            NotFoundError: nothing of that name is attached.
        """
        body = self.attached.get(name)
        if body is None:
            raise self._missing("attached object", name, self.attached)
        left = {key: item for key, item in self.attached.items() if key != name}
        item = body.body.at(self.pose_of(body.link) @ body.body.T_frame_object)
        return replace(self, attached=left, objects={**self.objects, name: item})

    def without_attached(self, name: str) -> PlanningScene:
        """Return the scene without an attached thing, wherever it is.

        Raises:
            NotFoundError: nothing of that name is attached.
        """
        scene = self.detach(name)
        return scene.without_object(name)

    def with_allowed(self, allowed: AllowedCollisions) -> PlanningScene:
        """Return the scene with other pairs that may touch."""
        return replace(self, allowed=allowed)

    def pose_of(self, frame: str) -> Pose:
        """Return the pose of a frame in the robot's frame.

        Frames are those of links, things, attached things, and ``thing/subframe``.

        Raises:
            NotFoundError: there is no such frame.
        """
        from gazelle.motion.kinematics import link_poses

        if frame == self.robot.frame:
            return Pose()
        if frame in self.robot.joint_above:
            return Pose.from_matrix(link_poses(self.robot, self.positions, [frame])[frame])
        name, _, inner = frame.partition("/")
        if name in self.objects:
            item, pose = self.objects[name], self.objects[name].T_frame_object
        elif name in self.attached:
            item = self.attached[name].body
            pose = self.pose_of(self.attached[name].link) @ item.T_frame_object
        else:
            known = [*self.robot.links, *self.objects, *self.attached]
            raise self._missing("frame", frame, known)
        if not inner:
            return pose
        if inner not in item.subframes:
            raise self._missing("subframe", inner, item.subframes)
        return pose @ item.subframes[inner]

    def _check_link(self, name: str) -> None:
        if name not in self.robot.joint_above:
            raise self._missing("link", name, self.robot.links)

    def _missing(self, kind: str, name: str, known: Iterable[str]) -> NotFoundError:
        there = tuple(known)
        hint = f"there are: {', '.join(there) or 'none'}"
        return NotFoundError(kind, name, nearest=nearest_names(name, there), hint=hint)
