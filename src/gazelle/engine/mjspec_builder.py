"""Models of the description as bodies, joints and geoms of a MuJoCo spec."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from gazelle.description.model import Collision, JointType, Link, MeshShape, Model, World
from gazelle.diagnostics import Diagnostics
from gazelle.engine.collision_geoms import GeomAssets, add_geom, geom_shapes
from gazelle.engine.friction import with_wheel_friction
from gazelle.engine.inertia import (
    MASSLESS_LEAF_INERTIA_KG_M2,
    MASSLESS_LEAF_KG,
    BodyInertia,
    body_inertia,
)
from gazelle.engine.kinematic_tree import KinematicTree, TreeLink, kinematic_tree
from gazelle.engine.mjspec_joints import add_joint, add_mimic, add_root_joint, has_parallel_axes
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import part_of, scoped
from gazelle.engine.wheel_slip import add_slip_body
from gazelle.geometry import IDENTITY_POSE

__all__ = ["BuiltGeom", "SpecBuilder", "VelocityDecay", "mesh_collisions"]

_KINEMATIC_FACTOR = 1e6


@dataclass(frozen=True, slots=True, eq=False)
class BuiltGeom:
    """A geom of the spec with what decides its contacts.

    Attributes:
        element: MuJoCo's spec element.
        name: its name.
        collision_name: ``model::link::collision``.
        link_name: ``model::link``.
        collision: the description.
        model: the model it belongs to.
        link: the link it belongs to.
        static: it never moves.
        heaviest_kg: mass of the whole model, the most that can rest on it; infinite if static.
    """

    element: Any
    name: str
    collision_name: str
    link_name: str
    collision: Collision
    model: Model
    link: Link
    static: bool
    heaviest_kg: float


@dataclass(frozen=True, slots=True)
class VelocityDecay:
    """SDF ``<velocity_decay>`` of a free link: the share of its speed it loses each step."""

    link_name: str
    linear: float
    angular: float


@dataclass(slots=True)
class SpecBuilder:
    """Collects what is built; one per compile.

    Attributes:
        world: what to build.
        spec: MuJoCo's spec.
        diagnostics: takes what is mapped, clipped or ignored.
        step_s: length of a step.
        slipping: wheel joints whose links get a slip body.
        slip_bodies: name of a wheel's slip body by link.
        assets: of the geoms.
    """

    world: World
    spec: Any
    diagnostics: Diagnostics
    step_s: float
    slipping: frozenset[str] = frozenset()
    slip_bodies: dict[str, str] = field(default_factory=dict)
    geoms: list[BuiltGeom] = field(default_factory=list)
    decays: list[VelocityDecay] = field(default_factory=list)
    trees: dict[str, KinematicTree] = field(default_factory=dict)
    used_names: set[str] = field(default_factory=set)
    assets: GeomAssets = field(init=False)

    def __post_init__(self) -> None:
        """Start with an empty spec."""
        self.assets = GeomAssets(self.spec)

    def add_model(self, model: Model) -> None:
        """Add a model's links, joints, mimics and collisions."""
        tree = kinematic_tree(model)
        self.trees[model.name] = tree
        bodies: dict[str, Any] = {}
        fixed = _fixed_links(model, tree)
        inertias = {
            entry.link.name: body_inertia(
                entry.link, scoped(model.name, entry.link.name), self.diagnostics
            )
            for entry in tree.links
        }
        moved = _moved_masses(tree, inertias)
        mass = sum(item.mass_kg for item in inertias.values() if item is not None)
        scenery = _is_scenery(tree, fixed)
        for entry in tree.links:
            body = self._add_body(model, entry, bodies)
            bodies[entry.link.name] = body
            static = entry.link.name in fixed
            if not static:
                is_root = entry.parent is None or entry.parent in fixed
                self._add_motion(model, entry, body, is_root=is_root)
                self._add_mass(model, entry, body, inertias[entry.link.name], moved)
            carrier = body if static else self._collision_body(model, entry, body)
            for collision in entry.link.collisions:
                kind = (static, scenery)
                self._add_collision(model, entry.link, collision, carrier, kind, mass)
        for joint in model.joints:
            if joint.mimic is not None and not model.static:
                add_mimic(self.spec, joint, model.name, self.step_s)

    def _add_body(self, model: Model, entry: TreeLink, bodies: dict[str, Any]) -> Any:
        link = entry.link
        parent = bodies[entry.parent] if entry.parent is not None else self.spec.worldbody
        if entry.parent is None:
            pose = model.T_world_model @ link.T_model_link
        else:
            parent_link = model.link(entry.parent)
            base = parent_link.T_model_link if parent_link else IDENTITY_POSE
            pose = base.inverse() @ link.T_model_link
        body = parent.add_body(name=scoped(model.name, link.name))
        body.pos = list(pose.position_m)
        body.quat = list(pose.quat_wxyz)
        body.gravcomp = 0.0 if link.gravity else 1.0
        return body

    def _add_motion(self, model: Model, entry: TreeLink, body: Any, *, is_root: bool) -> None:
        joint = entry.joint
        name = scoped(model.name, entry.link.name)
        if joint is None or (joint.type is JointType.FLOATING and entry.parent is None):
            add_root_joint(body, name)
        else:
            T_link_joint = entry.link.T_model_link.inverse() @ joint.T_model_joint
            add_joint(self.spec, body, joint, model.name, T_link_joint, self.step_s)
            if has_parallel_axes(joint):
                message = f"both axes of {joint.type.value} joint '{joint.name}' have the same"
                message += " direction; it turns about one"
                self.diagnostics.report("engine.parallel-axes", message, joint.span)
        if is_root:
            policy = mujoco.mjtSleepPolicy
            allowed = model.allow_auto_disable
            body.sleep = policy.mjSLEEP_ALLOWED if allowed else policy.mjSLEEP_NEVER
        self._add_decay(entry.link, name, is_free=joint is None)

    def _collision_body(self, model: Model, entry: TreeLink, body: Any) -> Any:
        """Return the body that carries a link's collisions."""
        joint = "" if entry.joint is None else scoped(model.name, entry.joint.name)
        if joint not in self.slipping:
            return body
        name = scoped(model.name, entry.link.name)
        carrier = add_slip_body(body, name, joint, entry)
        self.slip_bodies[name] = carrier.name
        return carrier

    def _add_decay(self, link: Link, name: str, *, is_free: bool) -> None:
        if link.linear_damping <= 0 and link.angular_damping <= 0:
            return
        if is_free:
            self.decays.append(VelocityDecay(name, link.linear_damping, link.angular_damping))
            return
        self.diagnostics.report(
            "engine.velocity-decay",
            f"link '{name}' has a velocity_decay, which acts only on links without a parent joint;"
            " it has no effect here",
            link.span,
        )

    def _add_mass(
        self,
        model: Model,
        entry: TreeLink,
        body: Any,
        inertia: BodyInertia | None,
        moved: dict[str, float],
    ) -> None:
        body.explicitinertial = True
        if inertia is not None:
            if entry.link.kinematic:
                inertia = _unmovable(inertia)
                body.gravcomp = 1.0
            body.mass = inertia.mass_kg
            body.ipos = list(inertia.center_m)
            i = inertia.inertia_kg_m2
            body.fullinertia = [i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]]
            return
        body.mass, body.inertia = 0.0, [0.0, 0.0, 0.0]
        moves = entry.joint is None or entry.joint.type is not JointType.FIXED
        if moves and moved[entry.link.name] <= 0:
            self._report_massless(model, entry)
            body.mass = MASSLESS_LEAF_KG
            body.inertia = [MASSLESS_LEAF_INERTIA_KG_M2] * 3

    def _report_massless(self, model: Model, entry: TreeLink) -> None:
        self.diagnostics.report(
            "engine.massless-link",
            f"link '{scoped(model.name, entry.link.name)}' moves and has no mass; the engine"
            f" gives it {MASSLESS_LEAF_KG * 1000:g} g and {MASSLESS_LEAF_INERTIA_KG_M2:g} kg·m²"
            " (Gazebo drops such a link and its joint)",
            entry.link.span,
        )

    def _add_collision(
        self,
        model: Model,
        link: Link,
        collision: Collision,
        body: Any,
        kind: tuple[bool, bool],
        mass_kg: float,
    ) -> None:
        static, scenery = kind
        collision = with_wheel_friction(model, link, collision, self.diagnostics)
        link_name = scoped(model.name, link.name)
        collision_name = self._unique(scoped(link_name, collision.name))
        shapes = geom_shapes(
            collision, collision_name, static=static, scenery=scenery, diagnostics=self.diagnostics
        )
        for index, shape in enumerate(shapes):
            name = part_of(collision_name, index)
            pose = collision.T_link_collision @ shape.T_collision_geom
            element = add_geom(body, name, shape, pose, self.assets)
            heaviest = float("inf") if static else max(mass_kg, MASSLESS_LEAF_KG)
            self.geoms.append(
                BuiltGeom(
                    element,
                    name,
                    collision_name,
                    link_name,
                    collision,
                    model,
                    link,
                    static,
                    heaviest,
                )
            )

    def _unique(self, name: str) -> str:
        """Return the name, numbered when a file uses it twice."""
        chosen, number = name, 2
        while chosen in self.used_names:
            chosen, number = f"{name}#{number}", number + 1
        self.used_names.add(chosen)
        return chosen


def mesh_collisions(world: World) -> Iterator[tuple[MeshShape, bool]]:
    """Yield the meshes that collide, and whether they are scenery.

    Raises:
        NotFoundError: a joint names a link that its model does not have.
        LimitError: more joints move one after the other than anything real has.
    """
    for model in world.models:
        shapes = [one.shape for link in model.links for one in link.collisions]
        meshes = [shape for shape in shapes if isinstance(shape, MeshShape)]
        if meshes:
            tree = kinematic_tree(model)
            scenery = _is_scenery(tree, _fixed_links(model, tree))
            yield from ((shape, scenery) for shape in meshes)


def _is_scenery(tree: KinematicTree, fixed: frozenset[str]) -> bool:
    """Tell whether nothing of a model moves.

    A machine's base is a machine's part: finely made and only touched from outside.
    """
    return len(fixed) == len(tree.links)


def _unmovable(inertia: BodyInertia) -> BodyInertia:
    """A kinematic link keeps the velocity it is given: so heavy that no force matters."""
    return BodyInertia(
        inertia.mass_kg * _KINEMATIC_FACTOR,
        inertia.center_m,
        inertia.inertia_kg_m2 * _KINEMATIC_FACTOR,
    )


def _fixed_links(model: Model, tree: KinematicTree) -> frozenset[str]:
    """Names of links that never move: of static models, or fixed to the world."""
    if model.static:
        return frozenset(link.name for link in model.links)
    fixed: set[str] = set()
    for entry in tree.links:
        welded = entry.joint is not None and entry.joint.type is JointType.FIXED
        if welded and (entry.parent is None or entry.parent in fixed):
            fixed.add(entry.link.name)
    return frozenset(fixed)


def _moved_masses(tree: KinematicTree, inertias: dict[str, BodyInertia | None]) -> dict[str, float]:
    """Mass of each link and all links fixed to it below: what its joint moves rigidly."""
    masses: dict[str, float] = {}
    for entry in reversed(tree.links):
        name = entry.link.name
        own = inertias[name]
        masses[name] = masses.get(name, 0.0) + (own.mass_kg if own is not None else 0.0)
        fixed = entry.joint is not None and entry.joint.type is JointType.FIXED
        if fixed and entry.parent is not None:
            masses[entry.parent] = masses.get(entry.parent, 0.0) + masses[name]
    return masses
