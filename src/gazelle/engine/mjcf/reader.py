"""MJCF to `World`: every body that hangs on the world is a model.

Equality constraints become mimicking joints and joints that close loops; what else a file
holds is reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.description.model import Joint, JointType, Link, Mimic, Model, Physics, World
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.unscoped_names import free_name, part_names
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.body_reader import BodyReader
from gazelle.engine.mjcf.geom_reader import GeomReader
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf, compiled_mjcf, is_mjcf
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["add_constraints", "is_mjcf", "read_mjcf", "report_left_out"]


_ELEMENTS = {
    "actuator": ("nu", "an effort limit is kept where they have one"),
    "sensor": ("nsensor", ""),
    "site": ("nsite", ""),
    "camera": ("ncam", ""),
    "light": ("nlight", ""),
    "tendon": ("ntendon", ""),
    "keyframe": ("nkey", ""),
    "contact pair": ("npair", "the geoms' own friction counts"),
    "contact exclusion": ("nexclude", "URDF and SDF only know it for whole models"),
    "mocap body": ("nmocap", "it stands still"),
    "flexible body": ("nflex", ""),
    "skin": ("nskin", ""),
}


_SCENERY = "scenery"
_UNNAMED = "MuJoCo Model"


def read_mjcf(
    path: Path, *, diagnostics: Diagnostics, output_files: OutputFiles | None = None
) -> World | None:
    """Read an MJCF file as MuJoCo compiles it.

    Positions of joints mean what they mean in MuJoCo: links stand where joint positions of 0 put
    them, and a joint's ``ref`` is its initial position. What lies in the world body itself is the
    static model ``scenery``. A model whose first body cannot move is fixed to the world.

    Args:
        path: the file.
        diagnostics: receives ``convert.mjcf`` for files that MuJoCo refuses and
            ``convert.left-out`` for what is not a matter of bodies, joints and shapes.
        output_files: takes meshes that only MuJoCo can read.

    Returns:
        The world; None when the file cannot be used.
    """
    mjcf = compiled_mjcf(path, diagnostics)
    if mjcf is None:
        return None
    geoms = GeomReader(mjcf, output_files or OutputFiles(relative=True), diagnostics)
    models = [
        _model_of(body, mjcf, geoms, diagnostics)
        for body in range(1, mjcf.model.nbody)
        if int(mjcf.model.body_parentid[body]) == 0
    ]
    models = add_constraints(_with_robot_named(models, mjcf), mjcf, diagnostics)
    report_left_out(mjcf, diagnostics)
    scenery = _scenery(mjcf, geoms, {model.name for model in models})
    everything = tuple(models) if scenery is None else (scenery, *models)
    x, y, z = (float(value) for value in mjcf.model.opt.gravity)
    return World(
        name=mjcf.spec.modelname,
        models=tuple(replace(model, file=path) for model in everything),
        gravity_m_s2=(x, y, z),
        physics=Physics(max_step_size_s=float(mjcf.model.opt.timestep)),
        file=path,
        span=mjcf.source.root.span,
    )


def add_constraints(
    models: Sequence[Model], mjcf: CompiledMjcf, diagnostics: Diagnostics
) -> list[Model]:
    """Return the models with what ``<equality>`` says about joints and bodies of one model.

    ``joint`` becomes a mimic, ``connect`` a ball joint and ``weld`` a fixed joint that closes a
    loop; everything else is reported.
    """
    result = list(models)
    for index in range(mjcf.model.neq):
        span = mjcf.source.root.span
        done = _mimicked(result, index, mjcf) or _closed(result, index, mjcf)
        if done is None:
            name = mjcf.model.eq(index).name or f"number {index + 1}"
            kind = mujoco.mjtEq(int(mjcf.model.eq_type[index])).name.removeprefix("mjEQ_").lower()
            message = f"the equality constraint {name} ({kind}) has no word in URDF and SDF"
            diagnostics.report("convert.left-out", message, span)
        else:
            result = done
    return result


def report_left_out(mjcf: CompiledMjcf, diagnostics: Diagnostics) -> None:
    """Report what has no place in a `World`, each kind once, with the place of the first."""
    model: Any = mjcf.model
    for word, (counter, note) in _ELEMENTS.items():
        count = int(getattr(model, counter))
        if count:
            plural = word if count == 1 else _plural(word)
            message = f"{count} {plural} of the file {'is' if count == 1 else 'are'} left out"
            message += f"; {note}" if note else ""
            diagnostics.report("convert.left-out", message, mjcf.source.root.span)
    _report_dynamics(mjcf, diagnostics)
    for old, new in mjcf.renamed:
        message = f"joint '{old}' is called '{new}', for a body has its name"
        diagnostics.report("convert.renamed", message, mjcf.source.span("joint", old))


def _mimicked(models: list[Model], index: int, mjcf: CompiledMjcf) -> list[Model] | None:
    """``y − y₀ = a₀ + a₁ (x − x₀)`` as ``y = a₁ x + (y₀ + a₀ − a₁ x₀)``."""
    model: Any = mjcf.model
    if int(model.eq_type[index]) != int(mujoco.mjtEq.mjEQ_JOINT) or not model.eq_active0[index]:
        return None
    follower, leader = int(model.eq_obj1id[index]), int(model.eq_obj2id[index])
    constant, factor, *higher = (float(value) for value in model.eq_data[index][:5])
    if leader < 0 or any(higher):
        return None
    start = [float(model.qpos0[model.jnt_qposadr[joint]]) for joint in (follower, leader)]
    mimic = Mimic(mjcf.joints[leader], factor, start[0] + constant - factor * start[1])
    name = mjcf.joints[follower]
    for place, item in enumerate(models):
        joint = item.joint(name)
        if joint is not None and joint.mimic is None and item.joint(mimic.joint) is not None:
            joints = (replace(j, mimic=mimic) if j is joint else j for j in item.joints)
            return [*models[:place], replace(item, joints=tuple(joints)), *models[place + 1 :]]
    return None


def _closed(models: list[Model], index: int, mjcf: CompiledMjcf) -> list[Model] | None:
    model: Any = mjcf.model
    kinds = {
        int(mujoco.mjtEq.mjEQ_CONNECT): JointType.BALL,
        int(mujoco.mjtEq.mjEQ_WELD): JointType.FIXED,
    }
    kind = kinds.get(int(model.eq_type[index]))
    of_bodies = int(model.eq_objtype[index]) == int(mujoco.mjtObj.mjOBJ_BODY)
    if kind is None or not of_bodies or not model.eq_active0[index]:
        return None
    first, second = (mjcf.bodies[int(ids[index])] for ids in (model.eq_obj1id, model.eq_obj2id))
    for place, item in enumerate(models):
        links = [item.link(name) for name in (first, second)]
        parent, child = links
        if parent is None or child is None:
            continue
        frame = child.T_model_link
        if kind is JointType.BALL:
            anchor = parent.T_model_link.transform(np.asarray(model.eq_data[index][:3]))
            x, y, z = (float(value) for value in anchor)
            frame = Pose((x, y, z))
        wanted = model.eq(index).name or f"{first}_{second}_{kind.value}"
        name = free_name(wanted, part_names(item))
        joint = Joint(name, kind, first, second, frame, span=item.span)
        joined = replace(item, joints=(*item.joints, joint))
        return [*models[:place], joined, *models[place + 1 :]]
    return None


def _report_dynamics(mjcf: CompiledMjcf, diagnostics: Diagnostics) -> None:
    model: Any = mjcf.model
    armatures = [
        mjcf.joints[index]
        for index in range(model.njnt)
        if model.dof_armature[int(model.jnt_dofadr[index])] > 0
    ]
    if armatures:
        shown = ", ".join(f"'{name}'" for name in armatures[:5])
        more = f" and {len(armatures) - 5} more" if len(armatures) > 5 else ""
        message = f"armature of joints {shown}{more} has no word in URDF and SDF"
        span = mjcf.source.span("joint", armatures[0])
        diagnostics.report("convert.left-out", message, span)
    partly = np.flatnonzero((model.body_gravcomp > 0) & (model.body_gravcomp < 1))
    for body in partly:
        name = mjcf.bodies[int(body)]
        message = f"body '{name}' feels a part of gravity only; in URDF and SDF it feels all of it"
        diagnostics.report("convert.left-out", message, mjcf.source.span("body", name))


def _plural(word: str) -> str:
    return f"{word[:-1]}ies" if word.endswith("y") else f"{word}s"


def _model_of(root: int, mjcf: CompiledMjcf, geoms: GeomReader, diagnostics: Diagnostics) -> Model:
    reader = BodyReader(mjcf, geoms, diagnostics, root)
    links: list[Link] = []
    joints: list[Joint] = []
    for body in mjcf.tree(root):
        more_links, more_joints = reader.read(int(body))
        links += more_links
        joints += more_joints
    static = reader.is_static
    span = mjcf.source.span("body", mjcf.model.body(root).name)
    return Model(
        mjcf.bodies[root],
        T_world_model=reader.T_world_model,
        static=static,
        self_collide=not static and _touches_itself(root, mjcf),
        links=tuple(links),
        joints=() if static else tuple(joints),
        canonical_link=links[-1].name if len(links) == 1 else mjcf.bodies[root],
        file=mjcf.source.path,
        span=span,
    )


def _touches_itself(root: int, mjcf: CompiledMjcf) -> bool:
    """Tell whether MuJoCo lets two bodies of a tree touch that are not parent and child."""
    model = mjcf.model
    geoms = [
        (int(model.geom_bodyid[i]), int(model.geom_contype[i]), int(model.geom_conaffinity[i]))
        for i in np.flatnonzero(model.body_rootid[model.geom_bodyid] == root)
    ]
    kinds = {(contype, conaffinity) for _, contype, conaffinity in geoms}
    pairs = ((a, b) for a in kinds for b in kinds)
    bodies = {body for body, contype, conaffinity in geoms if contype or conaffinity}
    return len(bodies) > 2 and any(a[0] & b[1] or a[1] & b[0] for a, b in pairs)


def _with_robot_named(models: list[Model], mjcf: CompiledMjcf) -> list[Model]:
    """Return the models; the only one that moves is called as the file is."""
    moving = [model for model in models if not model.static]
    name = mjcf.spec.modelname
    if len(moving) != 1 or not name or name == _UNNAMED:
        return models
    others = {model.name for model in models if model is not moving[0]}
    named = replace(moving[0], name=free_name(name, others))
    return [named if model is moving[0] else model for model in models]


def _scenery(mjcf: CompiledMjcf, geoms: GeomReader, taken: set[str]) -> Model | None:
    collisions, visuals = geoms.read(0)
    if not collisions and not visuals:
        return None
    link = Link("link", IDENTITY_POSE, collisions=collisions, visuals=visuals)
    return Model(
        free_name(_SCENERY, taken),
        static=True,
        links=(link,),
        canonical_link="link",
        file=mjcf.source.path,
        span=mjcf.source.root.span,
    )
