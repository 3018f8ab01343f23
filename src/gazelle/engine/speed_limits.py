"""Where efforts end: at a joint's velocity limit, as ``Joint::CheckAndTruncateForce`` has it.

Gazebo lets an effort do nothing in a step at whose start the joint is faster than its limit in the
effort's own direction; it never brakes, and what moves a joint otherwise is not held. Motors and
locks know no such limit, neither here nor there.

Efforts turn a joint at most a quarter turn in a step, whatever its limit: steps do not resolve how
faster turning acts on the other links, and it would throw its robot about.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, World
from gazelle.diagnostics import Diagnostics
from gazelle.engine.library import mujoco
from gazelle.engine.names import joint_part, scoped

__all__ = ["SpeedLimits"]

Array = NDArray[np.float64]
_CODE = "engine.quarter-turn"
_HINGE = int(mujoco.mjtJoint.mjJNT_HINGE)
_SLIDE = int(mujoco.mjtJoint.mjJNT_SLIDE)


class SpeedLimits:
    """The speeds at which efforts end, by MuJoCo's degrees of freedom."""

    def __init__(self) -> None:
        self._dofs: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._limits: Array = np.zeros(0)
        self._unlimited: dict[int, tuple[str, Joint]] = {}
        self._told: set[str] = set()

    def bind(self, model: Any, world: World, step_s: float) -> None:
        """Find the joints in a newly compiled model."""
        dofs, limits = [], []
        self._unlimited = {}
        joints = dict(_axes(world))
        for index in range(model.njnt):
            name, kind = model.joint(index).name, int(model.jnt_type[index])
            if name not in joints or kind not in (_HINGE, _SLIDE):
                continue
            dof, (joint, limit) = int(model.jnt_dofadr[index]), joints[name]
            quarter_turn = math.pi / 2 / step_s if kind == _HINGE else math.inf
            if quarter_turn < limit:
                self._unlimited[dof] = (name, joint)
            if math.isfinite(end := min(limit, quarter_turn)):
                dofs.append(dof)
                limits.append(end)
        self._dofs, self._limits = np.array(dofs, dtype=np.intp), np.array(limits, dtype=float)

    def concern(self, applied: Array) -> bool:
        """Whether an effort acts on a joint with a limit, so that each step is to be looked at.

        Args:
            applied: efforts on the joints (nv,).
        """
        # In most steps none acts at all, and a product tells so the fastest.
        return applied.dot(applied) != 0.0 and bool(applied[self._dofs].any())

    def overrun(self, speeds: Array, applied: Array, diagnostics: Diagnostics) -> NDArray[np.intp]:
        """Return the degrees of freedom whose effort does nothing in the next step.

        Args:
            speeds: MuJoCo's (nv,), rad/s or m/s.
            applied: efforts on the joints (nv,).
            diagnostics: told once of each joint that turns by a quarter turn in a step.
        """
        speed = speeds[self._dofs]
        is_over = np.abs(speed) > self._limits
        if not is_over.any():
            return self._dofs[:0]
        chosen: NDArray[np.intp] = self._dofs[is_over & (speed * applied[self._dofs] > 0)]
        for dof in chosen.tolist():
            if dof in self._unlimited:
                self._tell(*self._unlimited.pop(dof), float(np.abs(speeds[dof])), diagnostics)
        return chosen

    def _tell(self, name: str, joint: Joint, speed: float, diagnostics: Diagnostics) -> None:
        if name in self._told:
            return
        self._told.add(name)
        model, _, _ = name.partition("::")
        text = (
            f"joint '{joint.name}' of model '{model}' turns by more than a quarter turn in a step"
            f" ({speed:.0f} rad/s); its effort does nothing while it is that fast"
        )
        diagnostics.report(_CODE, text, joint.span)


def _axes(world: World) -> Iterator[tuple[str, tuple[Joint, float]]]:
    for model in world.models:
        for joint in model.joints:
            name = scoped(model.name, joint.name)
            if joint.axis is not None:
                yield name, (joint, joint.axis.velocity)
            if joint.axis2 is not None:
                yield joint_part(name, "axis2"), (joint, joint.axis2.velocity)
