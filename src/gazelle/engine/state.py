"""The state of a compiled world: initial, carried over a recompile, hashed, saved."""

from __future__ import annotations

import hashlib
import struct
from typing import Any

import numpy as np

from gazelle.description.model import Joint, JointAxis, JointType, Mimic, Model, World
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import joint_part, scoped

__all__ = [
    "carry_over",
    "hash_state",
    "initial_data",
    "joint_names_of",
    "set_initial_positions",
]

_QPOS_WIDTH = {0: 7, 1: 4, 2: 1, 3: 1}
_DOF_WIDTH = {0: 6, 1: 3, 2: 1, 3: 1}


def initial_data(model: Any, world: World) -> Any:
    """Return fresh data with every joint at its initial position."""
    data = mujoco.MjData(model)
    set_initial_positions(model, world, data)
    return data


def set_initial_positions(model: Any, world: World, data: Any) -> None:
    """Put joints with an initial position there, and mimics where they follow."""
    for item in world.models:
        joints = () if item.static else item.joints
        for joint in joints:
            _set_initial(model, data, scoped(item.name, joint.name), joint)
        for joint in joints:
            if joint.mimic is not None:
                _set_mimic(model, data, item.name, joint.name, joint.mimic)


def _set_initial(model: Any, data: Any, name: str, joint: Joint) -> None:
    _set_axis(model, data, name, joint.axis)
    if joint.type in (JointType.UNIVERSAL, JointType.REVOLUTE2):
        _set_axis(model, data, joint_part(name, "axis2"), joint.axis2)
    if joint.type is JointType.SCREW and joint.axis is not None:
        slide = joint.axis.position / (joint.thread_pitch_rad_m or 1.0)
        _set_axis(model, data, joint_part(name, "slide"), JointAxis(position=slide))


def _set_mimic(model: Any, data: Any, model_name: str, joint: str, mimic: Mimic) -> None:
    kind = mujoco.mjtObj.mjOBJ_JOINT
    follower = mujoco.mj_name2id(model, kind, scoped(model_name, joint))
    leader = mujoco.mj_name2id(model, kind, scoped(model_name, mimic.joint))
    if follower >= 0 and leader >= 0:
        position = data.qpos[model.jnt_qposadr[leader]]
        data.qpos[model.jnt_qposadr[follower]] = mimic.offset + mimic.multiplier * position


def carry_over(old: Any, old_data: Any, new: Any, new_data: Any) -> None:
    """Copy position, velocity, effort and solver memory of every joint both models have."""
    old_ids = {old.joint(i).name: i for i in range(old.njnt)}
    for i in range(new.njnt):
        j = old_ids.get(new.joint(i).name)
        if j is None or old.jnt_type[j] != new.jnt_type[i]:
            continue
        kind = int(new.jnt_type[i])
        width = _QPOS_WIDTH[kind]
        to, source = int(new.jnt_qposadr[i]), int(old.jnt_qposadr[j])
        new_data.qpos[to : to + width] = old_data.qpos[source : source + width]
        width = _DOF_WIDTH[kind]
        to, source = int(new.jnt_dofadr[i]), int(old.jnt_dofadr[j])
        for name in ("qvel", "qacc_warmstart", "qacc", "qfrc_applied"):
            getattr(new_data, name)[to : to + width] = getattr(old_data, name)[
                source : source + width
            ]


def hash_state(model: Any, data: Any, iteration: int) -> str:
    """Return a SHA-256 over time, positions, velocities and everything that acts."""
    digest = hashlib.sha256(struct.pack("<q", iteration))
    arrays = (
        data.qpos,
        data.qvel,
        data.act,
        data.ctrl,
        data.qfrc_applied,
        data.xfrc_applied,
        data.qacc_warmstart,
        model.tendon_frictionloss,
        model.eq_data,
        model.dof_damping,
        data.eq_active,
    )
    for array in arrays:
        digest.update((np.ascontiguousarray(array) + 0.0).tobytes())
    return digest.hexdigest()


def joint_names_of(model: Model) -> tuple[str, ...]:
    """Return the full names of a model's joints."""
    return tuple(scoped(model.name, joint.name) for joint in model.joints)


def _set_axis(model: Any, data: Any, name: str, axis: JointAxis | None) -> None:
    if axis is not None and axis.position != 0.0:
        index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        if index >= 0:
            data.qpos[model.jnt_qposadr[index]] = axis.position
