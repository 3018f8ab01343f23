"""Where efforts end: at a joint's velocity limit, as ``Joint::CheckAndTruncateForce`` has it.

Gazebo lets an effort do nothing in a step at whose start the joint is faster than its limit in the
effort's own direction; it never brakes, and what moves a joint otherwise is not held. Motors and
locks know no such limit, neither here nor there.

Efforts turn a joint at most a quarter turn in a step, whatever its limit: steps do not resolve how
faster turning acts on the other links, and it would throw its robot about.

Of an effort on a joint so light that within one step it would pass its stop, go by more than 0.1
rad or m though it has stops, or turn by a quarter turn, only so much counts as brings it there: ODE
would throw it through. Velocity limits do not count here: Gazebo lets a step pass them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, World
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import joint_part, scoped

__all__ = ["VelocityLimits"]

Array = NDArray[np.float64]
_INTO_STOP, _WITH_STOPS = 0.005, 0.1
"""So far, rad or m, an effort may carry a joint into its stop within a step, and at all if it has
stops."""
_CODE = "engine.quarter-turn"
_MIN_WEIGHT, _ROUNDING = 1e-12, 1e-9
_HINGE = int(mujoco.mjtJoint.mjJNT_HINGE)
_SLIDE = int(mujoco.mjtJoint.mjJNT_SLIDE)


class VelocityLimits:
    """The speeds at which efforts end, by MuJoCo's degrees of freedom."""

    def __init__(self) -> None:
        self._step_s = 0.0
        self._dofs: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._qpos: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._limits: Array = np.zeros(0)
        self._fastest: Array = np.zeros(0)
        self._range: Array = np.zeros((0, 2))
        self._weights: Array = np.zeros(0)
        self._throwing: Array = np.zeros(0)
        self._least_squared = math.inf
        self._unlimited: dict[int, tuple[str, Joint]] = {}
        self._told: set[str] = set()

    def bind(self, model: Any, world: World, step_s: float) -> None:
        """Find the joints in a newly compiled model."""
        chosen, limits, fastest = [], [], []
        self._unlimited, self._step_s = {}, step_s
        joints = dict(_axes(world))
        for index in range(model.njnt):
            name, kind = model.joint(index).name, int(model.jnt_type[index])
            if name not in joints or kind not in (_HINGE, _SLIDE):
                continue
            joint, limit = joints[name]
            quarter_turn = math.pi / 2 / step_s if kind == _HINGE else math.inf
            if quarter_turn < limit:
                self._unlimited[int(model.jnt_dofadr[index])] = (name, joint)
            end = min(limit, quarter_turn)
            if math.isfinite(end) or model.jnt_limited[index]:
                chosen.append(index)
                limits.append(end)
                fastest.append(quarter_turn)
        places = np.array(chosen, dtype=np.intp)
        self._dofs = model.jnt_dofadr[places].astype(np.intp)
        self._qpos = model.jnt_qposadr[places].astype(np.intp)
        self._limits = np.array(limits, dtype=float)
        stops = model.jnt_limited[places].astype(bool)
        self._range = np.where(stops[:, None], model.jnt_range[places], [-math.inf, math.inf])
        self._weights = np.maximum(model.dof_invweight0[self._dofs], _MIN_WEIGHT)
        # Stops are felt once they are passed.
        within = np.where(stops, _WITH_STOPS / step_s, math.inf)
        self._fastest = np.minimum(np.array(fastest, dtype=float), within)
        much = np.minimum(self._fastest, np.where(stops, _INTO_STOP / step_s, math.inf))
        self._throwing = much / (step_s * self._weights)
        least = float(self._throwing.min(initial=math.inf))
        self._least_squared = least * least

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
        self._tell_of(chosen, speeds[chosen], diagnostics)
        return chosen

    def throws(self, applied: Array) -> bool:
        """Whether an effort could carry a joint past its stops within a step, were it free.

        Args:
            applied: efforts on the joints (nv,).
        """
        # As in `concern`: most efforts are far too small, and a product tells so the fastest.
        if applied.dot(applied) <= self._least_squared:
            return False
        return bool((np.abs(applied[self._dofs]) > self._throwing).any())

    def held_back(
        self,
        positions: Array,
        speeds: Array,
        accelerations: Array,
        applied: Array,
        diagnostics: Diagnostics,
    ) -> tuple[NDArray[np.intp], Array]:
        """Return the joints whose effort carries them past their stops, and how much counts.

        Args:
            positions: MuJoCo's (nq,), rad or m, at the start of the step.
            speeds: MuJoCo's (nv,), rad/s or m/s, at its start.
            accelerations: MuJoCo's (nv,), in the step.
            applied: efforts on the joints (nv,).
            diagnostics: told once of each joint that would turn by a quarter turn in the step.
        """
        effort, at = applied[self._dofs], positions[self._qpos]
        then = speeds[self._dofs] + self._step_s * accelerations[self._dofs]
        ahead = np.sign(effort)
        stop = np.where(effort > 0, self._range[:, 1], -self._range[:, 0]) + _INTO_STOP
        fastest = np.minimum(self._fastest, (stop - ahead * at) / self._step_s)
        excess = ahead * then - np.maximum(fastest, 0.0)
        passes = (np.abs(effort) > self._throwing) & (excess > _ROUNDING * np.abs(then))
        if not passes.any():
            return self._dofs[:0], effort[:0]
        effort, excess = np.abs(effort[passes]), excess[passes]
        less = np.maximum(effort - excess / (self._step_s * self._weights[passes]), 0.0)
        dofs = self._dofs[passes]
        turns = np.abs(then[passes]) > self._limits[passes]
        self._tell_of(dofs[turns], then[passes][turns], diagnostics)
        return dofs, less * ahead[passes]

    def _tell_of(self, dofs: NDArray[np.intp], speeds: Array, diagnostics: Diagnostics) -> None:
        for dof, speed in zip(dofs.tolist(), speeds.tolist(), strict=True):
            if dof in self._unlimited:
                self._tell(*self._unlimited.pop(dof), abs(speed), diagnostics)

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
