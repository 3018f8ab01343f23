"""Equality constraints as mimicking joints and joints that close loops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from gazelle.description.model import Joint, JointType, Mimic, Model
from gazelle.description.writers.unscoped_names import free_name, part_names
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import Pose

__all__ = ["add_constraints"]


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
