"""Two surfaces that touch, combined by the rules of Gazebo with ODE (docs/contact.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.description.model import Surface
from gazelle.engine.friction import MIN_MU, friction_coefficients, torsional_length_m

__all__ = [
    "DEFAULT_KD",
    "DEFAULT_KP",
    "DEFAULT_MAX_VEL_M_S",
    "PairSurface",
    "combine",
    "is_plain",
    "surface_key",
]

DEFAULT_KP = 1e12
"""SDF's contact stiffness, N/m."""

DEFAULT_KD = 1.0
"""SDF's contact damping, N·s/m."""

DEFAULT_MAX_VEL_M_S = 0.01
"""SDF's limit, which acts where a stiffness is given without one."""

_NEVER_BOUNCES_M_S = 1000.0


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


def combine(first: Surface, second: Surface) -> PairSurface:
    """Combine two surfaces as Gazebo Classic does with ODE.

    Friction, torsional friction and bounce are the smaller of the two, the springs act in
    series, the dampers add (``ODEPhysics::Collide``); the contact patch is the larger one.
    """
    kp = 1.0 / (1.0 / _stiffness(first) + 1.0 / _stiffness(second))
    mu1, mu2 = friction_coefficients(first), friction_coefficients(second)
    return PairSurface(
        min(mu1[0], mu2[0]),
        min(mu1[1], mu2[1]),
        torsional_length_m(first, second),
        min(first.rolling_mu or 0.0, second.rolling_mu or 0.0),
        kp,
        _damping(first) + _damping(second),
        min(_restitution(first), _restitution(second)),
        min(_max_vel(first), _max_vel(second)),
    )


def is_plain(pair: PairSurface) -> bool:
    """Whether isotropic sliding friction and a hard contact describe the pair in full."""
    extras = pair.torsional_m > 0 or pair.rolling_m > 0 or pair.restitution > 0
    extras = extras or math.isfinite(pair.max_vel_m_s)
    return not extras and pair.mu1 == pair.mu2


def _restitution(surface: Surface) -> float:
    """Return the bounce of one surface; a threshold no speed reaches switches it off (SDF)."""
    threshold = surface.bounce_threshold_m_s
    if threshold is None or threshold >= _NEVER_BOUNCES_M_S:
        return 0.0
    return min(max(surface.restitution or 0.0, 0.0), 1.0)


def _stiffness(surface: Surface) -> float:
    """Return a surface's stiffness in N/m, SDF's default where it has no positive one."""
    return surface.kp if surface.kp is not None and surface.kp > 0 else DEFAULT_KP


def surface_key(surface: Surface) -> tuple[object, ...]:
    """Return what decides a contact; collisions with equal keys behave the same."""
    return (
        *friction_coefficients(surface),
        surface.torsional_mu,
        surface.torsional_patch_radius_m,
        surface.rolling_mu,
        _stiffness(surface),
        _damping(surface),
        _restitution(surface),
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
