"""Moving whole robots: their free joint is the only one that places them in the world."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import Pose

__all__ = ["move_root", "set_root_velocity", "wake_tree"]

Array = NDArray[np.float64]


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
    data.qvel[dof : dof + 3] += linear + _cross(angular, data.xpos[root] - point_m)
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


def _cross(a: Array, b: Array) -> Array:
    """Return the cross product of two vectors (3,); a tenth of the time of numpy's."""
    ax, ay, az = a.tolist()
    bx, by, bz = b.tolist()
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))
