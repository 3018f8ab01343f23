"""`World` to MuJoCo model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics
from gazelle.engine.contact_pairs import ExplicitPair, apply_pair_springs, set_up_contacts
from gazelle.engine.decomposition_workers import split_ahead
from gazelle.engine.kinematic_loops import add_loop, add_world_joint
from gazelle.engine.mjspec_builder import SpecBuilder, VelocityDecay, mesh_collisions
from gazelle.engine.mjspec_joints import implicit_damping, keeps_turning
from gazelle.engine.motors import add_motor, flywheel_inertia
from gazelle.engine.mujoco_library import compiled as compiled_spec
from gazelle.engine.mujoco_library import mujoco, report_library_warnings
from gazelle.engine.position_locks import add_lock
from gazelle.engine.scoped_names import root_joint, rotor_joint, scoped
from gazelle.engine.unsupported_elements import report_ignored_parameters
from gazelle.engine.welds import add_weld
from gazelle.engine.wheel_slip import copy_contact_weights
from gazelle.errors import EngineError

__all__ = [
    "SLEEP_TOLERANCE_M_S",
    "Assembly",
    "Compiled",
    "Extras",
    "assemble_world",
    "compile_assembly",
    "compile_world",
]

SLEEP_TOLERANCE_M_S = 2e-5
"""Below this speed for 10 steps a body rests (1 mm in 50 s)."""

FRICTION_RATIO = 1000.0
"""Friction is so many times stiffer than the normal direction: bodies do not creep on slopes."""

# MuJoCo's own estimate of its memory does not count the pairs of bodies that may touch: with some
# thousand bodies the process would end at the first step.
_MANY_BODIES = 1000
_ARENA_BYTES = 64_000_000
_BYTES_PER_PAIR = 16
_STOPPED_AT_ONCE = 1000.0
"""Speed that friction at least takes from a joint in a step, rad/s or m/s."""


@dataclass(frozen=True, slots=True)
class Extras:
    """What commands have asked for on top of the world.

    Attributes:
        motors: full names of the joints that get a motor.
        locks: full names of the joints that get a lock.
        welds: pairs of full names of links that can be held together.
        slipping: full names of the joints of wheels that slip.
    """

    motors: tuple[str, ...] = ()
    locks: tuple[str, ...] = ()
    welds: tuple[tuple[str, str], ...] = ()
    slipping: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, eq=False)
class Compiled:
    """A compiled world.

    Attributes:
        model: MuJoCo's model.
        link_names: ``model::link`` in the order of the world.
        body_ids: (links,), MuJoCo's body of each link, same order.
        collision_names: ``model::link::collision`` by geom.
        pairs: explicit contact pairs.
        motors: joints that have a motor.
    """

    model: Any
    link_names: tuple[str, ...]
    body_ids: NDArray[np.intp]
    collision_names: tuple[str, ...]
    pairs: tuple[ExplicitPair, ...]
    motors: tuple[str, ...]

    def retime(self, step_s: float) -> None:
        """Write what depends on the effective masses for a step length."""
        ids = [self.model.pair(pair.name).id for pair in self.pairs]
        apply_pair_springs(self.model, self.pairs, ids, step_s)


class Assembly(NamedTuple):
    """A world as a spec that is complete and not compiled yet."""

    builder: SpecBuilder
    pairs: tuple[ExplicitPair, ...]
    motors: tuple[str, ...]


def compile_world(
    world: World, extras: Extras = Extras(), *, step_s: float, diagnostics: Diagnostics
) -> Compiled:
    """Compile a world; see `assemble_world`.

    Raises:
        EngineError: MuJoCo refuses the model; its words are part of the message.
        NotFoundError: a joint names a link that is not there.
    """
    assembly = assemble_world(world, extras, step_s=step_s, diagnostics=diagnostics)
    return compile_assembly(assembly)


def assemble_world(
    world: World, extras: Extras = Extras(), *, step_s: float, diagnostics: Diagnostics
) -> Assembly:
    """Build the spec of a world.

    Args:
        world: everything there is.
        extras: motors, locks and welds.
        step_s: length of a step.
        diagnostics: takes what is mapped, clipped or ignored.

    Raises:
        EngineError: two models have the same name.
        NotFoundError: a joint names a link that is not there.
    """
    _check_names(world)
    split_ahead(mesh_collisions(world))
    spec = _new_spec(world, step_s)
    builder = SpecBuilder(world, spec, diagnostics, step_s, extras.slipping)
    for model in world.models:
        builder.add_model(model)
    count = sum(len(model.links) for model in world.models)
    if count > _MANY_BODIES:
        spec.memory = _ARENA_BYTES + _BYTES_PER_PAIR * count**2 // 2
    for model in world.models:
        tree = builder.trees[model.name]
        for joint in () if model.static else tree.loops:
            add_loop(spec, joint, model, tree, step_s, diagnostics)
    _add_world_joints(builder)
    pairs = set_up_contacts(builder)
    report_ignored_parameters(world, diagnostics)
    for motor in extras.motors:
        add_motor(spec, motor, step_s)
    for name in extras.locks:
        add_lock(spec, name, step_s)
    for pair in extras.welds:
        add_weld(spec, pair, step_s)
    return Assembly(builder, pairs, extras.motors)


def compile_assembly(assembly: Assembly) -> Compiled:
    """Compile a spec, and write what depends on the compiled masses.

    Raises:
        EngineError: MuJoCo refuses the model; its words are part of the message.
    """
    builder = assembly.builder
    model = _compile(builder.spec)
    report_library_warnings(builder.world, builder.diagnostics)
    compiled = _finish(builder, model, assembly.pairs, assembly.motors)
    compiled.retime(builder.step_s)
    return compiled


def _check_names(world: World) -> None:
    names = [model.name for model in world.models]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise EngineError(
            f"two models are named '{twice[0]}'; names in a world are unique: rename one or leave"
            " it out"
        )


def _new_spec(world: World, step_s: float) -> Any:
    spec = mujoco.MjSpec()
    spec.modelname = world.name
    spec.compiler.autolimits = False
    spec.compiler.degree = False
    spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE
    spec.compiler.usethread = False
    option = spec.option
    option.timestep = step_s
    option.gravity = list(world.gravity_m_s2)
    option.integrator = _integrator(world)
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = FRICTION_RATIO
    option.tolerance = 1e-12
    option.sleep_tolerance = SLEEP_TOLERANCE_M_S
    option.magnetic = list(world.magnetic_field_t)
    option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    # Damping is made implicit by armatures, see joints.implicit_damping.
    option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)
    return spec


def _integrator(world: World) -> Any:
    """Return Euler's, or for joints that turn about several axes the implicit one.

    Euler's step takes gyroscopic torques from the speeds at its start, and a link that swings on
    a ball joint gains energy for ever. The implicit step loses a little.
    """
    moving = [joint for model in world.models if not model.static for joint in model.joints]
    if any(keeps_turning(joint) for joint in moving):
        return mujoco.mjtIntegrator.mjINT_IMPLICIT
    return mujoco.mjtIntegrator.mjINT_EULER


def _add_world_joints(builder: SpecBuilder) -> None:
    poses = {
        scoped(model.name, link.name): model.T_world_model @ link.T_model_link
        for model in builder.world.models
        for link in model.links
    }
    for joint in builder.world.joints:
        add_world_joint(builder.spec, joint, poses, builder.step_s)


def _compile(spec: Any) -> Any:
    try:
        return compiled_spec(spec)
    except ValueError as error:
        raise EngineError(f"MuJoCo cannot build the world: {error}") from error


def _finish(
    builder: SpecBuilder, model: Any, pairs: tuple[ExplicitPair, ...], motors: tuple[str, ...]
) -> Compiled:
    names = tuple(
        scoped(item.name, link.name) for item in builder.world.models for link in item.links
    )
    ids = np.array([model.body(name).id for name in names], dtype=np.intp)
    collisions = [""] * model.ngeom
    for geom in builder.geoms:
        collisions[model.geom(geom.name).id] = geom.collision_name
    for decay in builder.decays:
        _apply_decay(model, decay, builder.step_s)
    for motor in motors:
        inertia = 1.0 / max(float(model.dof_invweight0[model.joint(motor).dofadr[0]]), 1e-12)
        model.dof_armature[model.joint(rotor_joint(motor)).dofadr[0]] = flywheel_inertia(inertia)
    if _steady_friction(model, builder.step_s) or motors or builder.decays:
        mujoco.mj_setConst(model, mujoco.MjData(model))
    copy_contact_weights(model, [(name, link) for link, name in builder.slip_bodies.items()])
    # MuJoCo weighs turning speeds with the size of the geometry that turns; a joint that carries
    # none would count as resting at any speed.
    np.maximum(model.dof_length, 1.0, out=model.dof_length)
    return Compiled(model, names, ids, tuple(collisions), pairs, motors)


def _steady_friction(model: Any, step_s: float) -> bool:
    """Give light joints the inertia with which their friction holds them; whether one got some.

    MuJoCo's dry friction creeps at 10⁻⁴ of the speed that its limit would give the joint in a
    step; here that is below 0.1 rad/s. Friction stops such a joint from 1000 rad/s in a step.
    """
    least = model.dof_frictionloss * step_s / _STOPPED_AT_ONCE
    missing = least - 1.0 / np.maximum(model.dof_invweight0, 1e-12)
    light = (model.dof_frictionloss > 0) & (missing > 0)
    model.dof_armature[light] += missing[light]
    return bool(light.any())


def _apply_decay(model: Any, decay: VelocityDecay, step_s: float) -> None:
    """Turn a share of speed lost per step into damping.

    The implicit step divides the speed by 1 + h D / m, which shall be 1 / (1 − share).
    """
    body = model.body(decay.link_name).id
    dof = int(model.joint(root_joint(decay.link_name)).dofadr[0])
    model.dof_damping[dof : dof + 3] = _damping_ratio(decay.linear) / step_s * model.body_mass[body]
    inertia = float(model.body_inertia[body].mean())
    model.dof_damping[dof + 3 : dof + 6] = _damping_ratio(decay.angular) / step_s * inertia
    six = slice(dof, dof + 6)
    model.dof_armature[six] = implicit_damping(model.dof_damping[six], step_s)


def _damping_ratio(share: float) -> float:
    share = min(share, 0.999)
    return share / (1.0 - share)
