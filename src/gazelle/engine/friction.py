"""Friction: ``mu``, ``mu2`` and ``fdir1`` of collisions, torsional friction, friction of wheels.

Gazebo takes the smaller coefficients of two surfaces (`gazelle.engine.contact_solref_solimp`),
MuJoCo the larger, which priorities make up for (`gazelle.engine.contact_pairs`). The formulas are
derived in docs/contact.md.
"""

from __future__ import annotations

import math
from dataclasses import replace

from gazelle.description.model import (
    Collision,
    Cylinder,
    Joint,
    JointType,
    Link,
    MeshShape,
    Model,
    Surface,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjspec_joints import INFINITE_LIMIT
from gazelle.engine.scoped_names import scoped

__all__ = [
    "MAX_WHEEL_MU",
    "MIN_MU",
    "friction_coefficients",
    "friction_rate",
    "least_friction",
    "report_friction_direction",
    "torsional_length_m",
    "with_wheel_friction",
]

MAX_MU = 1000.0
"""Larger friction coefficients mean 'never slides' and only spoil the solver's conditioning."""

MIN_MU = 1e-5
"""Below this a contact is frictionless (MuJoCo's own smallest coefficient)."""

FRICTION_RATE = 0.05
"""Sliding speed decays at this rate in units of 1/h: over 20 steps. A higher one lifts sliding
bodies off the ground, for the solver's friction cone couples sliding and normal speed."""

# Between rubber and dry concrete there is 1; some cars' tyres reach 2.
MAX_WHEEL_MU = 2.0
# Coefficients further apart mean a wheel that glides one way, as an omni wheel does.
_ONE_SIZE = 0.25


def friction_coefficients(surface: Surface) -> tuple[float, float]:
    """Return a surface's ``mu`` and ``mu2``, 1 where it names none, within bounds."""
    mu1 = 1.0 if surface.mu1 is None else surface.mu1
    mu2 = 1.0 if surface.mu2 is None else surface.mu2
    return (min(max(mu1, 0.0), MAX_MU), min(max(mu2, 0.0), MAX_MU))


def least_friction(surface: Surface) -> float:
    """Return the smaller of a surface's two friction coefficients, 1 where it names none."""
    return min(friction_coefficients(surface))


def torsional_length_m(first: Surface, second: Surface) -> float:
    """Torque per normal force of a flat round patch, 3π/16 · a · μ (SDF ``patch_radius``)."""
    radius = max(first.torsional_patch_radius_m or 0.0, second.torsional_patch_radius_m or 0.0)
    mu = min(
        1.0 if surface.torsional_mu is None else surface.torsional_mu for surface in (first, second)
    )
    return 3.0 * math.pi / 16.0 * radius * max(mu, 0.0)


def friction_rate(impedance: float, step_s: float) -> tuple[float, float]:
    """Return ``solreffriction`` for the sliding rate; MuJoCo divides by the impedance."""
    rate = -FRICTION_RATE * impedance / step_s
    return (rate, rate)


def report_friction_direction(collision: Collision, name: str, diagnostics: Diagnostics) -> None:
    """Report an ``fdir1`` that would have to turn with the body."""
    surface = collision.surface
    if surface.fdir1 is not None and surface.mu1 != surface.mu2:
        diagnostics.report(
            "engine.friction-direction",
            f"collision '{name}' sets fdir1; the engine cannot turn the friction"
            " directions with the body and applies mu and mu2 along its own tangents (for level"
            " ground: mu along the world's y, mu2 along x)",
            surface.span or collision.span,
        )


def with_wheel_friction(
    model: Model, link: Link, collision: Collision, diagnostics: Diagnostics
) -> Collision:
    """Return a collision whose friction lets a wheel turn on the spot that it stands on.

    A wheel of width b touches the ground at both ends. A robot that turns about its vertical axis
    twists it against μ N b / 2, which for the μ = 200 of many robot files is more than its motors
    have. In Gazebo Classic 11 (ODE) such a robot turns all the same, for every μ from 0.7 to 200 as
    if its wheels rolled on their outer ends (measured: 0.757 rad/s with 60 kg on wheels of 5 cm,
    0.445 m apart, at 0.1875 m/s). Here a wheel's coefficients count up to `MAX_WHEEL_MU`, and it
    turns as if they rolled on their middles. A wheel is a cylinder or mesh on a joint that turns
    without limits and carries no other joint.

    Different coefficients along and across cannot follow the wheel (see docs/contact.md): of two
    that are of one size the smaller one counts in all directions, and that is reported.
    """
    surface = collision.surface
    if not _is_wheel(model, link, collision):
        return collision
    mu1 = surface.mu1 and min(surface.mu1, MAX_WHEEL_MU)
    mu2 = surface.mu2 and min(surface.mu2, MAX_WHEEL_MU)
    if mu1 and mu2 and mu1 != mu2 and min(mu1, mu2) >= _ONE_SIZE * max(mu1, mu2):
        mu1 = mu2 = min(mu1, mu2)
        diagnostics.report(
            "engine.friction-direction",
            f"collision '{scoped(model.name, link.name)}::{collision.name}' of a wheel has"
            f" mu {surface.mu1:g} and mu2 {surface.mu2:g}; the engine cannot turn the friction"
            f" directions with the wheel and applies {mu1:g} in all of them",
            surface.span or collision.span,
        )
    if (mu1, mu2) == (surface.mu1, surface.mu2):
        return collision
    return replace(collision, surface=replace(surface, mu1=mu1, mu2=mu2))


def _is_wheel(model: Model, link: Link, collision: Collision) -> bool:
    if not isinstance(collision.shape, Cylinder | MeshShape):
        return False
    turns = any(joint.child == link.name and _is_endless(joint) for joint in model.joints)
    return turns and not any(
        joint.parent == link.name and joint.type is not JointType.FIXED for joint in model.joints
    )


def _is_endless(joint: Joint) -> bool:
    """Tell whether a joint turns without limits: SDF's wheels are revolute joints with none."""
    if joint.type is not JointType.REVOLUTE or joint.axis is None:
        return joint.type is JointType.CONTINUOUS
    return min(-joint.axis.lower, joint.axis.upper) >= INFINITE_LIMIT
