"""The largest effort that a joint's actuators give."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.engine.mujoco_library import mujoco

__all__ = ["effort_limits"]


def effort_limits(model: Any) -> dict[int, float]:
    """Return N·m or N by joint: ``actuatorfrcrange``, else what its actuators are limited to.

    An actuator counts that acts on the joint itself and whose force is limited, by ``forcerange``
    or, for plain motors, by ``ctrlrange``.
    """
    limits: dict[int, float] = {}
    on_joint = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    for index in range(model.nu):
        if int(model.actuator_trntype[index]) in on_joint:
            force = _force(model, index)
            if force is not None:
                joint = int(model.actuator_trnid[index][0])
                gear = abs(float(model.actuator_gear[index][0]))
                limits[joint] = limits.get(joint, 0.0) + gear * force
    for joint in range(model.njnt):
        if model.jnt_actfrclimited[joint]:
            limits[joint] = float(np.abs(model.jnt_actfrcrange[joint]).max())
    return limits


def _force(model: Any, index: int) -> float | None:
    if model.actuator_forcelimited[index]:
        return float(np.abs(model.actuator_forcerange[index]).max())
    plain = int(model.actuator_gaintype[index]) == int(mujoco.mjtGain.mjGAIN_FIXED)
    plain = plain and int(model.actuator_biastype[index]) == int(mujoco.mjtBias.mjBIAS_NONE)
    if plain and model.actuator_ctrllimited[index]:
        gain = abs(float(model.actuator_gainprm[index][0]))
        return gain * float(np.abs(model.actuator_ctrlrange[index]).max())
    return None
