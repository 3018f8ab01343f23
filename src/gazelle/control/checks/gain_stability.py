"""Are gains stable with the joint's inertia and the period of control?

A joint of inertia I under ``effort = -p q - d dq/dt``, computed every n-th step of a
semi-implicit Euler integration and held in between, is a linear map of (q, v, last q). It is
stable when no eigenvalue lies outside the unit circle. For n = 1 that is Jury's criterion
``p h²/I + 2 d h/I < 4``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["joint_inertias", "largest_stable_factor", "spectral_radius"]


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


_TOLERANCE = 1e-7

_HALVINGS = 40


def spectral_radius(
    p: float,
    d: float,
    inertia: float,
    step_s: float,
    *,
    period_steps: int = 1,
    of_velocity: bool = False,
    damping: float = 0.0,
) -> float:
    """Return the largest magnitude of an eigenvalue over one period of control; > 1 diverges.

    Args:
        p: proportional gain; acts on the velocity with `of_velocity`.
        d: derivative gain; acts on the velocity's change then.
        inertia: kg·m² or kg.
        step_s: of the physics.
        period_steps: physics steps between two computations of the effort.
        of_velocity: the error is one of velocity.
        damping: of the joint, implicit, N·m·s/rad.
    """
    h, period_s = step_s, step_s * period_steps
    # State (q, v, last): last is the q, or the v, of the computation before.
    error = np.array([0.0, 1.0, 0.0]) if of_velocity else np.array([1.0, 0.0, 0.0])
    last = np.array([0.0, 0.0, 1.0])
    effort = -p * error - d * (error - last) / period_s
    fading = 1.0 / (1.0 + h * damping / inertia)
    position, velocity = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    for _ in range(period_steps):
        velocity = fading * (velocity + h / inertia * effort)
        position = position + h * velocity
    return float(np.abs(np.linalg.eigvals(np.array([position, velocity, error]))).max())


def largest_stable_factor(
    p: float,
    d: float,
    inertia: float,
    step_s: float,
    *,
    period_steps: int = 1,
    of_velocity: bool = False,
    damping: float = 0.0,
) -> float:
    """Return the largest factor, at most 1, by which both gains can be multiplied stably.

    The arguments are those of `spectral_radius`.
    """

    def is_stable(factor: float) -> bool:
        radius = spectral_radius(
            factor * p,
            factor * d,
            inertia,
            step_s,
            period_steps=period_steps,
            of_velocity=of_velocity,
            damping=damping,
        )
        return radius <= 1.0 + _TOLERANCE

    if is_stable(1.0):
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return low
