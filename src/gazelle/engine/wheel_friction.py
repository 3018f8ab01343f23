"""The friction of wide wheels, which touch the ground in two points at least."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import (
    Collision,
    Cylinder,
    Joint,
    JointType,
    Link,
    MeshShape,
    Model,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine.joints import INFINITE_LIMIT
from gazelle.engine.scoped_names import scoped

__all__ = ["MOST_WHEEL_MU", "with_wheel_grip"]

# Between rubber and dry concrete there is 1; some cars' tyres reach 2.
MOST_WHEEL_MU = 2.0
# Coefficients further apart mean a wheel that glides one way, as an omni wheel does.
_ONE_SIZE = 0.25


def with_wheel_grip(
    model: Model, link: Link, collision: Collision, diagnostics: Diagnostics
) -> Collision:
    """Return a collision whose friction lets a wheel turn on the spot that it stands on.

    A wheel of width b touches the ground at both ends. A robot that turns about its vertical axis
    twists it against μ N b / 2, which for the μ = 200 of many robot files is more than its motors
    have. In Gazebo Classic 11 (ODE) such a robot turns all the same, for every μ from 0.7 to 200 as
    if its wheels rolled on their outer ends (measured: 0.757 rad/s with 60 kg on wheels of 5 cm,
    0.445 m apart, at 0.1875 m/s). Here a wheel's coefficients count up to `MOST_WHEEL_MU`, and it
    turns as if they rolled on their middles. A wheel is a cylinder or mesh on a joint that turns
    without limits and carries no other joint.

    Different coefficients along and across cannot follow the wheel (see docs/contact.md): of two
    that are of one size the smaller one counts in all directions, and that is reported.
    """
    surface = collision.surface
    if not _is_wheel(model, link, collision):
        return collision
    mu1 = surface.mu1 and min(surface.mu1, MOST_WHEEL_MU)
    mu2 = surface.mu2 and min(surface.mu2, MOST_WHEEL_MU)
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
