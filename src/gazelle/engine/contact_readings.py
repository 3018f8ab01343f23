"""What acts between bodies in the last step: contacts, joint reactions, constraint forces."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.state import Wrench
from gazelle.geometry import cross

__all__ = ["Contact", "constraint_forces", "joint_reaction", "read_contacts", "waking_copy"]


Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """Two collisions that touch.

    Attributes:
        collision1, collision2: ``model::link::collision``.
        points_m: contact points, (N, 3), world frame.
        normals: unit vectors from `collision2` towards `collision1`, (N, 3), world frame.
        depths_m: penetration, (N,).
        forces_n: force on `collision1` at each point, (N, 3), world frame; `collision2` feels
            the opposite.
        torques_nm: torque on `collision1` about each point, (N, 3), world frame.
    """

    collision1: str
    collision2: str
    points_m: Array
    normals: Array
    depths_m: Array
    forces_n: Array
    torques_nm: Array


def read_contacts(model: Any, data: Any, collisions: Sequence[str]) -> tuple[Contact, ...]:
    """Return all contacts of the last step, grouped by pair of collisions.

    Args:
        model: MuJoCo's model.
        data: MuJoCo's data.
        collisions: ``model::link::collision`` by geom.
    """
    groups: dict[tuple[str, str], list[int]] = {}
    geoms = data.contact.geom[: data.ncon]
    for index, (first, second) in enumerate(geoms):
        names = (collisions[first], collisions[second])
        groups.setdefault(names, []).append(index)
    return tuple(_contact(model, data, names, indices) for names, indices in groups.items())


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


def _contact(model: Any, data: Any, names: tuple[str, str], indices: list[int]) -> Contact:
    frames = data.contact.frame[indices].reshape(-1, 3, 3)
    wrenches = np.zeros((len(indices), 6))
    for row, index in enumerate(indices):
        mujoco.mj_contactForce(model, data, index, wrenches[row])
    forces = -np.einsum("nij,ni->nj", frames, wrenches[:, :3])
    torques = -np.einsum("nij,ni->nj", frames, wrenches[:, 3:])
    return Contact(
        names[0],
        names[1],
        data.contact.pos[indices].copy(),
        -frames[:, 0],
        -data.contact.dist[indices],
        forces,
        torques,
    )
