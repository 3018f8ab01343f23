"""Gazebo's contact parameters as MuJoCo's: the formulas, derived in docs/contact.md."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.description.model import Surface
from gazelle.engine.friction import MIN_MU, friction_coefficients, friction_rate, torsional_length_m

__all__ = [
    "DEFAULT_KD",
    "DEFAULT_KP",
    "HARD_SOLIMP",
    "ContactSpring",
    "PairSurface",
    "combine",
    "contact_spring",
    "hard_spring",
    "is_plain",
    "restitution_of",
    "surface_key",
]

DEFAULT_KP = 1e12
"""SDF's contact stiffness, N/m."""

DEFAULT_KD = 1.0
"""SDF's contact damping, N·s/m."""

RESOLVED = 0.25
"""Largest h² kp / m that one step of length h resolves as a spring; harder ones saturate."""

HARD_IMPEDANCE = 0.97
"""Impedance of a saturated contact; the rest of the load is carried by the penetration."""

BOUNCE_STEPS = 24.0

OVERLAP_M = 0.001
"""The overlap that is parted with ``max_vel``; others are parted in proportion."""

MAX_PARTING_M_S = 10.0
"""From this limit on it is none: the spring and damper act alone."""

DEFAULT_MAX_VEL_M_S = 0.01
"""SDF's limit, which acts where a stiffness is given without one."""

MAX_IMPEDANCE = 0.9999
"""Impedance of a slowly parting contact at most (MuJoCo's own bound)."""

HARD_SOLIMP = (HARD_IMPEDANCE, HARD_IMPEDANCE, 0.001, 0.5, 2.0)
_NEVER_BOUNCES_M_S = 1000.0
SolRef = tuple[float, float]
SolImp = tuple[float, float, float, float, float]


@dataclass(frozen=True, slots=True)
class PairSurface:
    """What two surfaces make together, by the rules of Gazebo with ODE.

    Attributes:
        mu1, mu2: Coulomb friction along the two tangents.
        torsional_m: torsional friction torque per newton of normal force, metres.
        rolling_m: rolling friction torque per newton of normal force, metres.
        kp: stiffness of one contact point, N/m.
        kd: damping of one contact point, N·s/m.
        restitution: bounce coefficient 0…1.
        max_vel_m_s: speed at which bodies that overlap are pushed apart at most.
    """

    mu1: float
    mu2: float
    torsional_m: float
    rolling_m: float
    kp: float
    kd: float
    restitution: float
    max_vel_m_s: float = math.inf

    @property
    def condim(self) -> int:
        """Dimensions of MuJoCo's contact: 1 normal, 3 with sliding, 4 spin, 6 rolling friction."""
        if self.rolling_m > 0:
            return 6
        if self.torsional_m > 0:
            return 4
        return 3 if max(self.mu1, self.mu2) > MIN_MU else 1


@dataclass(frozen=True, slots=True)
class ContactSpring:
    """MuJoCo's ``solref`` (direct form: −stiffness, −damping), ``solreffriction``, ``solimp``."""

    solref: SolRef
    solreffriction: SolRef
    solimp: SolImp


def combine(first: Surface, second: Surface) -> PairSurface:
    """Combine two surfaces as Gazebo Classic does with ODE.

    Friction, torsional friction and bounce are the smaller of the two, the springs act in
    series, the dampers add (``ODEPhysics::Collide``); the contact patch is the larger one.
    """
    kp = 1.0 / (1.0 / stiffness_of(first) + 1.0 / stiffness_of(second))
    mu1, mu2 = friction_coefficients(first), friction_coefficients(second)
    return PairSurface(
        min(mu1[0], mu2[0]),
        min(mu1[1], mu2[1]),
        torsional_length_m(first, second),
        min(first.rolling_mu or 0.0, second.rolling_mu or 0.0),
        kp,
        _damping(first) + _damping(second),
        min(restitution_of(first), restitution_of(second)),
        min(_max_vel(first), _max_vel(second)),
    )


def is_plain(pair: PairSurface) -> bool:
    """Whether isotropic sliding friction and a hard contact describe the pair in full."""
    extras = pair.torsional_m > 0 or pair.rolling_m > 0 or pair.restitution > 0
    extras = extras or math.isfinite(pair.max_vel_m_s)
    return not extras and pair.mu1 == pair.mu2


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


def restitution_of(surface: Surface) -> float:
    """Return the bounce of one surface; a threshold no speed reaches switches it off (SDF)."""
    threshold = surface.bounce_threshold_m_s
    if threshold is None or threshold >= _NEVER_BOUNCES_M_S:
        return 0.0
    return min(max(surface.restitution or 0.0, 0.0), 1.0)


def stiffness_of(surface: Surface) -> float:
    """Return a surface's stiffness in N/m, SDF's default where it has no positive one."""
    return surface.kp if surface.kp is not None and surface.kp > 0 else DEFAULT_KP


def surface_key(surface: Surface) -> tuple[object, ...]:
    """Return what decides a contact; collisions with equal keys behave the same."""
    return (
        *friction_coefficients(surface),
        surface.torsional_mu,
        surface.torsional_patch_radius_m,
        surface.rolling_mu,
        stiffness_of(surface),
        _damping(surface),
        restitution_of(surface),
        _max_vel(surface),
    )


def _max_vel(surface: Surface) -> float:
    """Return the speed limit of pushing apart; a limit of 0 or less is none (ODE)."""
    limit = surface.max_vel_m_s
    if limit is None:
        return math.inf if surface.kp is None else DEFAULT_MAX_VEL_M_S
    return limit if limit > 0 else math.inf


def _damping(surface: Surface) -> float:
    return DEFAULT_KD if surface.kd is None else max(surface.kd, 0.0)
