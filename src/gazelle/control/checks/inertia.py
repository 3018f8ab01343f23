"""The inertia a joint's motor feels."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["joint_inertias"]


def joint_inertias(engine: Engine, names: Iterable[str]) -> dict[str, float]:
    """Return the inertia that an effort on each joint accelerates, with all others free.

    It is ``1 / (M⁻¹)ᵢᵢ`` of the joint-space inertia matrix in the present pose: the smallest
    value that the joint can show, and so the one that decides about stability.

    Args:
        engine: the world.
        names: ``model::joint``; those without a coordinate are left out.

    Returns:
        kg·m² for turning joints, kg for sliding ones, by name.
    """
    from gazelle.engine.mujoco_library import mujoco

    # Asking for the data builds what was asked for since the last step.
    data = engine.data_with_velocities()
    model = engine.model
    mujoco.mj_makeM(model, data)
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    inverse = np.linalg.inv(M) if model.nv else M
    found = {}
    for name in names:
        dof = engine.joint_address(name, 0)[2]
        if dof >= 0 and inverse[dof, dof] > 0:
            found[name] = float(1.0 / inverse[dof, dof])
    return found
