"""Quantities that need more than the state: contacts of sleepers, joint reactions."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.records import Wrench
from gazelle.geometry import cross

__all__ = ["constraint_forces", "joint_reaction", "waking_copy"]


def waking_copy(model: Any, data: Any) -> Any:
    """Return data in which sleeping bodies have contacts: the data itself when nobody sleeps.

    MuJoCo does not collide sleeping bodies with each other or the ground.
    """
    if (data.tree_asleep < 0).all():
        return data
    awake = copy.copy(data)
    flags = model.opt.enableflags
    model.opt.enableflags = flags & ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    try:
        mujoco.mj_forward(model, awake)
    finally:
        model.opt.enableflags = flags
    return awake


def joint_reaction(model: Any, data: Any, body: int, point_m: NDArray[np.float64]) -> Wrench:
    """Return force and torque about a point (3,) that a body's parent exerts on it, world frame.

    ``cfrc_int`` holds them about the centre of mass of the body's whole tree.
    """
    torque, force = data.cfrc_int[body, :3], data.cfrc_int[body, 3:]
    origin = data.subtree_com[model.body_rootid[body]]
    return Wrench(force.copy(), torque + cross(origin - point_m, force))


def constraint_forces(data: Any, kind: int, count: int) -> NDArray[np.float64]:
    """Return the force of the last step, (count,), N or N·m, of each equality or tendon.

    Args:
        data: MuJoCo's data.
        kind: ``mjtConstraint``; elements of one row each.
        count: how many elements there are.
    """
    forces = np.zeros(count)
    rows = data.efc_type == kind
    forces[data.efc_id[rows]] = data.efc_force[rows]
    return forces
