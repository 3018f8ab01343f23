"""Finding which link made a simulation diverge.

Places must be within bounds besides: a state whose squares are beyond all numbers is none that a
world could go on from, or go back to.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import SourceSpan
from gazelle.engine.mujoco_library import mujoco
from gazelle.errors import EngineError, SimulationDivergedError
from gazelle.geometry import Pose

__all__ = [
    "Culprit",
    "divergence_error",
    "find_culprit",
    "finite",
    "require_finite",
    "require_finite_pose",
    "within_bounds",
]


_MAX_DISTANCE = 1e12


def finite(value: float, what: str) -> float:
    """Return a number as it is.

    Raises:
        EngineError: it is infinite or none.
    """
    if not math.isfinite(value):
        raise EngineError(f"{what} was given {value}: a finite number is needed")
    return float(value)


def within_bounds(value: float, what: str) -> float:
    """Return a coordinate, or the position of a joint, as it is.

    Raises:
        EngineError: it is infinite, none, or beyond all bounds.
    """
    if abs(finite(value, what)) > _MAX_DISTANCE:
        raise EngineError(
            f"{what} was given {value:g}: nothing is farther away than {_MAX_DISTANCE:g}"
        )
    return float(value)


def require_finite(values: Iterable[float], what: str) -> None:
    """See that numbers are finite.

    Raises:
        EngineError: one is not.
    """
    for value in values:
        finite(value, what)


def require_finite_pose(pose: Pose, what: str) -> None:
    """See that position and orientation are finite, and the position within bounds.

    Raises:
        EngineError: a number is not.
    """
    for value in pose.position_m:
        within_bounds(value, f"the pose of {what}")
    require_finite(pose.quat_xyzw, f"the pose of {what}")


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


def divergence_error(
    culprit: Culprit, first_step: int, span: SourceSpan | None
) -> SimulationDivergedError:
    """Return the error that names the link that went wrong first.

    Args:
        culprit: its step counts from `first_step`.
        first_step: the steps made before.
        span: where the link is described.
    """
    where = f" ({span})" if span else ""
    return SimulationDivergedError(
        f"the simulation diverged in step {first_step + culprit.step}: link '{culprit.link}'{where}"
        f" {culprit.what}. Usual reasons: an inertia far too small for the forces on it,"
        " effort or gains far too large, collisions that start inside each other",
        link=culprit.link,
    )


def _name(model: Any, speeds: Array, last: Array, step: int) -> Culprit:
    finite = np.isfinite(speeds)
    worst = np.abs(speeds) if finite.all() else np.where(finite, 0.0, 1.0 + np.abs(last))
    is_rotor = [_MARK in model.body(int(body)).name for body in model.dof_bodyid]
    dof = int(np.argmax(np.where(is_rotor, -1.0, worst)))
    body = model.body(int(model.dof_bodyid[dof]))
    joint = model.joint(int(model.dof_jntid[dof])).name.partition(_MARK)[0]
    speed = "no finite number" if not finite[dof] else f"{abs(float(speeds[dof])):.3g}"
    return Culprit(body.name, f"moves beyond all bounds at '{joint}' (speed {speed})", step)
