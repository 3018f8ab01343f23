"""Reading MuJoCo's contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.engine.compiler import Compiled
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.records import Contact

__all__ = ["read_contacts"]


def read_contacts(compiled: Compiled, data: Any) -> tuple[Contact, ...]:
    """Return all contacts of the last step, grouped by pair of collisions."""
    groups: dict[tuple[str, str], list[int]] = {}
    geoms = data.contact.geom[: data.ncon]
    for index, (first, second) in enumerate(geoms):
        names = (compiled.collision_names[first], compiled.collision_names[second])
        groups.setdefault(names, []).append(index)
    return tuple(
        _contact(compiled.model, data, names, indices) for names, indices in groups.items()
    )


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
