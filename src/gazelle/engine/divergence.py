"""Finding which link made a simulation diverge."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco

__all__ = ["Culprit", "find_culprit"]

Array = NDArray[np.float64]
_ABSURD_SPEED = 1e6
_MARK = "//"


class Culprit(NamedTuple):
    """The link that went wrong first and what it did."""

    link: str
    what: str
    step: int


def find_culprit(model: Any, data: Any, before: tuple[Array, Array, Array], steps: int) -> Culprit:
    """Repeat the steps one by one from the state before them and see who is absurd first.

    Args:
        model: MuJoCo's model.
        data: its state, already non-finite; left as it is.
        before: ``qpos`` (nq,), ``qvel`` (nv,) and ``qacc_warmstart`` (nv,) before the steps.
        steps: how many were made.
    """
    probe = mujoco.MjData(model)
    probe.qpos[:], probe.qvel[:], probe.qacc_warmstart[:] = before
    probe.qfrc_applied[:] = data.qfrc_applied
    probe.xfrc_applied[:] = data.xfrc_applied
    last = probe.qvel.copy()
    for step in range(1, steps + 1):
        mujoco.mj_step(model, probe)
        speeds = probe.qvel
        if not np.isfinite(speeds).all() or np.abs(speeds).max(initial=0.0) > _ABSURD_SPEED:
            return _name(model, speeds, last, step)
        last = speeds.copy()
    return _name(model, data.qvel, last, steps)


def _name(model: Any, speeds: Array, last: Array, step: int) -> Culprit:
    finite = np.isfinite(speeds)
    worst = np.abs(speeds) if finite.all() else np.where(finite, 0.0, 1.0 + np.abs(last))
    is_rotor = [_MARK in model.body(int(body)).name for body in model.dof_bodyid]
    dof = int(np.argmax(np.where(is_rotor, -1.0, worst)))
    body = model.body(int(model.dof_bodyid[dof]))
    joint = model.joint(int(model.dof_jntid[dof])).name.partition(_MARK)[0]
    speed = "no finite number" if not finite[dof] else f"{abs(float(speeds[dof])):.3g}"
    return Culprit(body.name, f"moves beyond all bounds at '{joint}' (speed {speed})", step)
