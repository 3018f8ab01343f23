"""The state of a running world: where everything is at first, moved, hashed, and as records.

It is carried over when the world is compiled anew. A model is moved by its free joint, the only
one that places it in the world.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, JointAxis, JointType, Mimic, Model, World
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import joint_part, scoped
from gazelle.geometry import Pose, cross

__all__ = [
    "Acceleration",
    "Snapshot",
    "Velocity",
    "Wrench",
    "carry_over",
    "hash_state",
    "initial_data",
    "joint_names_of",
    "move_root",
    "set_initial_positions",
    "set_root_velocity",
    "wake_tree",
]


Array = NDArray[np.float64]
_QPOS_WIDTH = {0: 7, 1: 4, 2: 1, 3: 1}
_DOF_WIDTH = {0: 6, 1: 3, 2: 1, 3: 1}


class Velocity(NamedTuple):
    """Linear velocity m/s of a point and angular velocity rad/s, shape (3,), world frame."""

    linear_m_s: Array
    angular_rad_s: Array


class Acceleration(NamedTuple):
    """Linear acceleration m/s² (gravity not subtracted) and angular rad/s², (3,), world frame."""

    linear_m_s2: Array
    angular_rad_s2: Array


class Wrench(NamedTuple):
    """Force N and torque N·m, shape (3,)."""

    force_n: Array
    torque_nm: Array


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Where every link is, for sensors and views.

    Attributes:
        time_ns: simulated time.
        revision: of the compiled world; link names change only with it.
        link_names: ``model::link``, (N).
        T: poses in the world, (N, 7): x y z in metres, then qx qy qz qw; read-only.
    """

    time_ns: int
    revision: int
    link_names: tuple[str, ...]
    T: Array


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


def move_root(model: Any, data: Any, bodies: Iterable[int], T_world_world: Pose) -> bool:
    """Move all free roots above some bodies by a transform of the world; False if there is none.

    Velocities turn with the robot.
    """
    joints = {joint for body in bodies if (joint := _root_joint(model, body)) is not None}
    for joint in sorted(joints):
        address, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        x, y, z, qw, qx, qy, qz = data.qpos[address : address + 7].tolist()
        pose = T_world_world @ Pose((x, y, z), (qx, qy, qz, qw))
        data.qpos[address : address + 7] = [*pose.position_m, *pose.quat_wxyz]
        velocity = tuple(data.qvel[dof : dof + 3].tolist())
        if any(velocity):
            data.qvel[dof : dof + 3] = T_world_world.rotate(velocity)
    return bool(joints)


def set_root_velocity(
    model: Any, data: Any, body: int, point_m: Array, change: tuple[Array, Array]
) -> bool:
    """Add a rigid velocity to a body's free root; False where it has none.

    Args:
        model: MuJoCo's model.
        data: its state, changed.
        body: of the tree.
        point_m: (3,), world frame.
        change: linear at the point, m/s, and angular, rad/s; (3,) each, world frame.
    """
    joint = _root_joint(model, body)
    if joint is None:
        return False
    linear, angular = change
    dof = int(model.jnt_dofadr[joint])
    root = int(model.jnt_bodyid[joint])
    rotation = data.xmat[root].reshape(3, 3)
    data.qvel[dof : dof + 3] += linear + cross(angular, data.xpos[root] - point_m)
    data.qvel[dof + 3 : dof + 6] += rotation.T @ angular
    return True


def wake_tree(model: Any, data: Any, body: int) -> None:
    """Wake a body's tree: MuJoCo looks for speeds whose bytes are not 0, minus zero is one."""
    tree = int(model.body_treeid[body])
    if tree >= 0:
        dof = int(model.tree_dofadr[tree])
        if data.qvel[dof] == 0:
            data.qvel[dof] = -0.0


def _root_joint(model: Any, body: int) -> int | None:
    """Return the free joint at the top of a body's tree."""
    root = int(model.body_rootid[body])
    if model.body_jntnum[root] == 0:
        return None
    joint = int(model.body_jntadr[root])
    return joint if model.jnt_type[joint] == int(mujoco.mjtJoint.mjJNT_FREE) else None


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


def _set_axis(model: Any, data: Any, name: str, axis: JointAxis | None) -> None:
    if axis is not None and axis.position != 0.0:
        index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        if index >= 0:
            data.qpos[model.jnt_qposadr[index]] = axis.position
