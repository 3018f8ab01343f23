"""Gazebo's contact springs as MuJoCo's solref and solimp; derived in docs/contact.md."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.engine.friction import friction_rate
from gazelle.engine.surface_combination import DEFAULT_MAX_VEL_M_S, PairSurface

__all__ = [
    "HARD_SOLIMP",
    "ContactSpring",
    "contact_spring",
    "hard_spring",
]


RESOLVED = 0.25
"""Largest h² kp / m that one step of length h resolves as a spring; harder ones saturate."""

HARD_IMPEDANCE = 0.97
"""Impedance of a saturated contact; the rest of the load is carried by the penetration."""

BOUNCE_STEPS = 24.0

OVERLAP_M = 0.001
"""The overlap that is parted with ``max_vel``; others are parted in proportion."""

MAX_PARTING_M_S = 10.0
"""From this limit on it is none: the spring and damper act alone."""

MAX_IMPEDANCE = 0.9999
"""Impedance of a slowly parting contact at most (MuJoCo's own bound)."""

HARD_SOLIMP = (HARD_IMPEDANCE, HARD_IMPEDANCE, 0.001, 0.5, 2.0)
SolRef = tuple[float, float]
SolImp = tuple[float, float, float, float, float]


@dataclass(frozen=True, slots=True)
class ContactSpring:
    """MuJoCo's ``solref`` (direct form: −stiffness, −damping), ``solreffriction``, ``solimp``."""

    solref: SolRef
    solreffriction: SolRef
    solimp: SolImp


def contact_spring(pair: PairSurface, inverse_mass: float, step_s: float) -> ContactSpring:
    """Return the MuJoCo parameters of one contact point.

    With c = 1 + h (kd + h kp) / m the implicit step of ODE is reproduced exactly by impedance
    d = 1 − 1/c, stiffness kp/(m c) and damping (kd + h kp)/(m c); see docs/contact.md.

    Args:
        pair: the combined surface.
        inverse_mass: MuJoCo's inverse weight of both bodies together, 1/kg.
        step_s: length h of a step.
    """
    if pair.restitution > 0:
        return _bouncing(pair.restitution, step_s)
    if pair.max_vel_m_s < MAX_PARTING_M_S:
        gentle = pair.max_vel_m_s / (step_s * OVERLAP_M)
        return _pushed_apart(gentle, pair.kp * inverse_mass, step_s)
    if step_s * step_s * pair.kp * inverse_mass > RESOLVED:
        return hard_spring(step_s)
    drag = (pair.kd + step_s * pair.kp) * inverse_mass
    c = 1.0 + step_s * drag
    impedance = min(max(1.0 - 1.0 / c, 1e-4), 0.9999)
    return ContactSpring(
        (-pair.kp * inverse_mass / c, -drag / c),
        friction_rate(impedance, step_s),
        (impedance, impedance, 0.001, 0.5, 2.0),
    )


def hard_spring(step_s: float) -> ContactSpring:
    """Return the saturated contact: takes all speed within a step, parts overlaps slowly.

    At rest it sinks (1 − d) g h · 1 mm / (d · 0.01 m/s), 30 µm at a step of 1 ms.
    """
    gentle = DEFAULT_MAX_VEL_M_S / (step_s * OVERLAP_M)
    return ContactSpring(
        (-gentle * HARD_IMPEDANCE, -HARD_IMPEDANCE / step_s),
        friction_rate(HARD_IMPEDANCE, step_s),
        HARD_SOLIMP,
    )


def _pushed_apart(gentle: float, stiffness: float, step_s: float) -> ContactSpring:
    """Return a contact that parts bodies slowly and sinks as deep as its spring says.

    The damper takes all speed within one step, so an overlap r is left with speed h·gentle·r,
    which is ``max_vel`` for one of `OVERLAP_M`. The impedance d makes the depth at rest that of
    the spring, g (1 − d) / (d gentle) = g / stiffness.

    Args:
        gentle: the slow spring's stiffness over mass, 1/s².
        stiffness: kp over mass, 1/s².
        step_s: length of a step.
    """
    gentle = min(gentle, stiffness)
    impedance = min(1.0 / (1.0 + gentle / stiffness), MAX_IMPEDANCE)
    return ContactSpring(
        (-gentle * impedance, -impedance / step_s),
        friction_rate(impedance, step_s),
        (impedance, impedance, 0.001, 0.5, 2.0),
    )


def _bouncing(restitution: float, step_s: float) -> ContactSpring:
    """Return a spring whose half period spans many steps and that returns e of the speed."""
    ratio = _damping_ratio_of(restitution)
    omega = math.pi / (BOUNCE_STEPS * step_s)
    solref = (-omega * omega, -2.0 * ratio * omega)
    return ContactSpring(solref, friction_rate(HARD_IMPEDANCE, step_s), HARD_SOLIMP)


def _damping_ratio_of(restitution: float) -> float:
    """Return the damping ratio that returns e of the speed, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = (low + high) / 2
        if _returned_speed(middle) > restitution:
            low = middle
        else:
            high = middle
    return high


def _returned_speed(ratio: float) -> float:
    """Return e of a spring and damper that only push (Schwager and Pöschel 2007).

    They let go when the damper pulls as hard as the spring pushes, which is before the half
    period is over.
    """
    root = math.sqrt(max(1.0 - ratio * ratio, 1e-12))
    phase = math.pi - math.atan2(2.0 * ratio * root, 1.0 - 2.0 * ratio * ratio)
    return math.exp(-ratio / root * phase)
