"""Reading MuJoCo's contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco

__all__ = ["Contact", "read_contacts"]

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
