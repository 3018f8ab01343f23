"""A planning scene as a MuJoCo model that is only ever asked what touches.

Links are bodies below each other, things around the robot are mocap bodies, so moving them
rebuilds nothing; attached things are bodies on their links. MuJoCo's own rule that neighbours do
not collide is off: as in MoveIt, only the SRDF says which pairs are left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.engine.collision_geoms import GeomAssets, add_geom
from gazelle.engine.mujoco_library import compiled, drained_warnings, mujoco
from gazelle.errors import EngineError
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.motion.collision.convex_solids import Solid, link_solids, object_solids
from gazelle.motion.model import JointKind, RobotJoint
from gazelle.motion.scene import PlanningScene

__all__ = [
    "CollisionBody",
    "CollisionModel",
    "Owner",
    "build_collision_model",
    "collision_bodies",
    "may_touch",
]

IntArray = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Owner:
    """What a solid belongs to.

    Attributes:
        name: of the link or thing.
        kind: ``link``, ``object`` or ``attached object``.
        link: the link itself, or the one that carries an attached thing; empty for others.
    """

    name: str
    kind: str
    link: str = ""

    def __str__(self) -> str:
        return f"{self.kind} '{self.name}'"


@dataclass(frozen=True, slots=True)
class CollisionBody:
    """A link, thing or attached thing with something that collides.

    Attributes:
        owner: who it is.
        link: whose frame it is in; empty for the robot's own.
        T_frame_body: pose of its own frame in that one.
        solids: in its own frame.
        margin_m: how near something has to come to count as touching.
    """

    owner: Owner
    link: str
    T_frame_body: Pose
    solids: tuple[Solid, ...]
    margin_m: float = 0.0

    @property
    def is_object(self) -> bool:
        """Whether it stands in the world and the robot does not carry it."""
        return not self.link


@dataclass(frozen=True, eq=False)
class CollisionModel:
    """A compiled scene.

    Attributes:
        model: MuJoCo's.
        owners: by geom.
        addresses: (n,), place in ``qpos`` of every variable of the robot.
        mocaps: number of the mocap body of every thing.
    """

    model: Any
    owners: tuple[Owner, ...]
    addresses: IntArray
    mocaps: Mapping[str, int]


def collision_bodies(scene: PlanningScene, diagnostics: Diagnostics) -> tuple[CollisionBody, ...]:
    """Return all of a scene that collides: links, attached things, things.

    Args:
        scene: what there is.
        diagnostics: receives shapes that cannot be collided.
    """
    found = []
    own = link_solids(scene.robot, diagnostics)
    for joint in scene.robot.joints:
        name = joint.child
        margin_m = scene.padding_m.get(name, 0.0)
        owner = Owner(name, "link", name)
        found.append(CollisionBody(owner, name, IDENTITY_POSE, own.get(name, ()), margin_m))
    for carried in scene.attached.values():
        solids = object_solids(carried.body, diagnostics)
        owner = Owner(carried.name, "attached object", carried.link)
        found.append(CollisionBody(owner, carried.link, carried.body.T_frame_object, solids))
    for item in scene.objects.values():
        owner = Owner(item.name, "object")
        solids = object_solids(item, diagnostics)
        found.append(CollisionBody(owner, "", item.T_frame_object, solids))
    return tuple(body for body in found if body.solids)


def build_collision_model(
    scene: PlanningScene, bodies: Sequence[CollisionBody], diagnostics: Diagnostics
) -> CollisionModel:
    """Compile a scene.

    Args:
        scene: what there is.
        bodies: its `collision_bodies`.
        diagnostics: receives MuJoCo's warnings.

    Raises:
        EngineError: MuJoCo refuses the model; its words are part of the message.
    """
    builder = _Builder(scene, bodies, diagnostics)
    builder.add_links()
    builder.add_attached()
    builder.add_objects()
    builder.add_exclusions()
    return builder.compiled()


class _Builder:
    def __init__(
        self, scene: PlanningScene, bodies: Sequence[CollisionBody], diagnostics: Diagnostics
    ) -> None:
        self._scene = scene
        self._colliding = {str(body.owner): body for body in bodies}
        self._diagnostics = diagnostics
        self._spec = _new_spec()
        self._assets = GeomAssets(self._spec)
        self._bodies: dict[str, Any] = {}
        self._owners: dict[str, Owner] = {}
        self._geom_owners: list[Owner] = []

    def add_links(self) -> None:
        for joint in self._scene.robot.joints:
            above = self._bodies.get(f"link {joint.parent}", self._spec.worldbody)
            pose = joint.T_parent_joint @ joint.T_joint_child
            body = self._body(above, f"link {joint.child}", pose)
            _add_motion(body, joint)
            self._add(body, Owner(joint.child, "link", joint.child))

    def add_attached(self) -> None:
        for attached in self._scene.attached.values():
            pose = attached.body.T_frame_object
            above = self._bodies[f"link {attached.link}"]
            body = self._body(above, f"attached {attached.name}", pose)
            self._add(body, Owner(attached.name, "attached object", attached.link))

    def add_objects(self) -> None:
        for item in self._scene.objects.values():
            body = self._body(self._spec.worldbody, f"object {item.name}", item.T_frame_object)
            body.mocap = True
            self._add(body, Owner(item.name, "object"))

    def add_exclusions(self) -> None:
        for first, second in combinations(self._owners, 2):
            if may_touch(self._scene, self._owners[first], self._owners[second]):
                exclude = self._spec.add_exclude()
                exclude.bodyname1, exclude.bodyname2 = first, second

    def compiled(self) -> CollisionModel:
        try:
            model = compiled(self._spec)
        except ValueError as error:
            raise EngineError(f"MuJoCo cannot build the planning scene: {error}") from error
        for warning in drained_warnings():
            text = f"MuJoCo warns of the planning scene: {' '.join(warning.split())}"
            self._diagnostics.report("engine.mujoco-warning", text)
        objects = self._scene.objects
        mocaps = {name: int(model.body(f"object {name}").mocapid[0]) for name in objects}
        addresses = _addresses(model, self._scene.robot.joints)
        return CollisionModel(model, tuple(self._geom_owners), addresses, mocaps)

    def _body(self, parent: Any, name: str, pose: Pose) -> Any:
        body = parent.add_body(name=name)
        body.pos, body.quat = list(pose.position_m), list(pose.quat_wxyz)
        body.explicitinertial, body.mass, body.inertia = True, 1.0, [1.0, 1.0, 1.0]
        self._bodies[name] = body
        return body

    def _add(self, body: Any, owner: Owner) -> None:
        colliding = self._colliding.get(str(owner))
        if colliding is None:
            return
        self._owners[body.name] = owner
        for solid in colliding.solids:
            name = f"geom {len(self._geom_owners)}"
            geom = add_geom(body, name, solid.shape, solid.T_owner_shape, self._assets)
            geom.margin = colliding.margin_m
            self._geom_owners.append(owner)


def may_touch(scene: PlanningScene, first: Owner, second: Owner) -> bool:
    """Return whether a pair is not looked at."""
    if scene.allowed.allows(first.name, second.name):
        return True
    if "link" not in (first.kind, second.kind):
        # Things never collide with things, unless the robot carries one of them.
        if first.kind == second.kind == "object":
            return True
        return bool(first.link) and first.link == second.link
    carried = [item for item in (first, second) if item.kind == "attached object"]
    if not carried:
        return False
    link = second.name if first is carried[0] else first.name
    return link == carried[0].link or link in scene.attached[carried[0].name].touch_links


def _new_spec() -> Any:
    spec = mujoco.MjSpec()
    spec.compiler.autolimits = False
    spec.compiler.degree = False
    spec.compiler.usethread = False
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
    spec.memory = 1 << 24
    return spec


def _add_motion(body: Any, joint: RobotJoint) -> None:
    T_child_joint = joint.T_joint_child.inverse()
    types = mujoco.mjtJoint

    def add(kind: Any, name: str, axis: tuple[float, float, float]) -> None:
        made = body.add_joint(name=name, type=kind)
        made.pos = list(T_child_joint.position_m)
        made.axis = list(T_child_joint.rotate(axis))

    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    names = joint.variables
    if joint.kind is JointKind.REVOLUTE:
        add(types.mjJNT_HINGE, names[0], joint.axis)
    elif joint.kind is JointKind.PRISMATIC:
        add(types.mjJNT_SLIDE, names[0], joint.axis)
    elif joint.kind is JointKind.PLANAR:
        add(types.mjJNT_SLIDE, names[0], x)
        add(types.mjJNT_SLIDE, names[1], y)
        add(types.mjJNT_HINGE, names[2], z)
    elif joint.kind is JointKind.FLOATING:
        for name, axis in zip(names, (x, y, z), strict=False):
            add(types.mjJNT_SLIDE, name, axis)
        add(types.mjJNT_BALL, names[3], z)


def _addresses(model: Any, joints: tuple[RobotJoint, ...]) -> IntArray:
    found: list[int] = []
    for joint in joints:
        if joint.kind is JointKind.FLOATING:
            found += [int(model.joint(name).qposadr[0]) for name in joint.variables[:3]]
            ball = int(model.joint(joint.variables[3]).qposadr[0])
            # MuJoCo has the scalar of a quaternion first.
            found += [ball + 1, ball + 2, ball + 3, ball]
        else:
            found += [int(model.joint(name).qposadr[0]) for name in joint.variables]
    return np.array(found, dtype=np.intp)
