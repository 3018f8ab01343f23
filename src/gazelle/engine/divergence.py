"""Finding which link made a simulation diverge."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.library import mujoco

__all__ = ["Culprit", "find_culprit"]

Array = NDArray[np.float64]
_ABSURD_SPEED = 1e6


class Culprit(NamedTuple):
    """The link that went wrong first and what it did."""

    link: str
    what: str


def find_culprit(model: Any, data: Any, before: tuple[Array, Array, Array], steps: int) -> Culprit:
    """Repeat the steps one by one from the state before them and see who is absurd first.

    Args:
        model: MuJoCo's model.
        data: its state, already non-finite; left as it is.
        before: positions, velocities and warm start before the steps.
        steps: how many were made.
    """
    probe = mujoco.MjData(model)
    probe.qpos[:], probe.qvel[:], probe.qacc_warmstart[:] = before
    probe.qfrc_applied[:] = data.qfrc_applied
    probe.xfrc_applied[:] = data.xfrc_applied
    last = probe.qvel.copy()
    for _ in range(steps):
        mujoco.mj_step(model, probe)
        speeds = probe.qvel
        if not np.isfinite(speeds).all() or np.abs(speeds).max(initial=0.0) > _ABSURD_SPEED:
            return _name(model, np.where(np.isfinite(speeds), speeds, np.inf), last)
        last = speeds.copy()
    return _name(model, np.where(np.isfinite(data.qvel), data.qvel, np.inf), last)


def _name(model: Any, speeds: Array, last: Array) -> Culprit:
    worst = np.abs(speeds)
    if not np.isfinite(worst).all():
        worst = np.where(np.isfinite(worst), 0.0, 1.0 + np.abs(last))
    dof = int(np.argmax(worst))
    body = model.body(int(model.dof_bodyid[dof]))
    joint = model.joint(int(model.dof_jntid[dof])).name
    speed = abs(float(last[dof]))
    return Culprit(body.name, f"moves beyond all bounds at '{joint}' (last speed {speed:.3g})")
