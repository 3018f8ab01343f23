"""The friction of wide wheels, which touch the ground in two points at least."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Collision, Cylinder, JointType, Link, MeshShape, Model

__all__ = ["MOST_WHEEL_MU", "with_wheel_grip"]

# Between rubber and dry concrete there is 1; some cars' tyres reach 2.
MOST_WHEEL_MU = 2.0


def with_wheel_grip(model: Model, link: Link, collision: Collision) -> Collision:
    """Return a collision whose friction lets a wheel turn on the spot that it stands on.

    A wheel of width b touches the ground at both ends. A robot that turns about its vertical axis
    twists it against μ N b / 2, which for the μ = 200 of many robot files is more than its motors
    have. ODE's iterations end long before they find such forces, so that these robots turn in
    Gazebo; here a wheel's coefficients count up to `MOST_WHEEL_MU`. A wheel is a cylinder or mesh
    on a continuous joint that carries no other joint.
    """
    surface = collision.surface
    mu1, mu2 = surface.mu1, surface.mu2
    if max(mu1 or 0.0, mu2 or 0.0) <= MOST_WHEEL_MU or not _is_wheel(model, link, collision):
        return collision
    capped = replace(
        surface,
        mu1=mu1 and min(mu1, MOST_WHEEL_MU),
        mu2=mu2 and min(mu2, MOST_WHEEL_MU),
    )
    return replace(collision, surface=capped)


def _is_wheel(model: Model, link: Link, collision: Collision) -> bool:
    if not isinstance(collision.shape, Cylinder | MeshShape):
        return False
    turns = any(
        joint.child == link.name and joint.type is JointType.CONTINUOUS for joint in model.joints
    )
    return turns and not any(
        joint.parent == link.name and joint.type is not JointType.FIXED for joint in model.joints
    )
