"""MJCF to `World`: every body that hangs on the world is a model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from gazelle.description.model import Joint, Link, Model, Physics, World
from gazelle.description.writers.output_files import Beside
from gazelle.description.writers.unscoped_names import free_name
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.body_reader import BodyReader
from gazelle.engine.mjcf.constraints import add_constraints
from gazelle.engine.mjcf.geom_reader import GeomReader
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf, compiled_mjcf
from gazelle.engine.mjcf.sources import is_mjcf
from gazelle.engine.mjcf.unsupported_elements import report_unsaid
from gazelle.geometry import IDENTITY_POSE

__all__ = ["is_mjcf", "read_mjcf"]

_SCENERY = "scenery"
_UNNAMED = "MuJoCo Model"


def read_mjcf(
    path: Path, *, diagnostics: Diagnostics, beside: Beside | None = None
) -> World | None:
    """Read an MJCF file as MuJoCo compiles it.

    Positions of joints mean what they mean in MuJoCo: links stand where joint positions of 0 put
    them, and a joint's ``ref`` is its initial position. What lies in the world body itself is the
    static model ``scenery``. A model whose first body cannot move is fixed to the world.

    Args:
        path: the file.
        diagnostics: receives ``convert.mjcf`` for files that MuJoCo refuses and
            ``convert.left-out`` for what is not a matter of bodies, joints and shapes.
        beside: takes meshes that only MuJoCo can read.

    Returns:
        The world; None when the file cannot be used.
    """
    mjcf = compiled_mjcf(path, diagnostics)
    if mjcf is None:
        return None
    geoms = GeomReader(mjcf, beside or Beside(relative=True), diagnostics)
    models = [
        _model_of(body, mjcf, geoms, diagnostics)
        for body in range(1, mjcf.model.nbody)
        if int(mjcf.model.body_parentid[body]) == 0
    ]
    models = add_constraints(_with_robot_named(models, mjcf), mjcf, diagnostics)
    report_unsaid(mjcf, diagnostics)
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
