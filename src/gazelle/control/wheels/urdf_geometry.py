"""Measures of wheels from the robot's description, where parameters leave them out."""

from __future__ import annotations

import math

from gazelle.control.errors import ControllerError
from gazelle.description.model import Cylinder, Joint, Model, Sphere
from gazelle.diagnostics import did_you_mean

__all__ = ["joint_distance_m", "joint_offset_m", "wheel_radius_m"]


def joint_distance_m(model: Model, first: str, second: str) -> float:
    """Return the distance of two joints' frames with all joints at zero.

    Raises:
        ControllerError: the description has no such joint.
    """
    return math.dist(_joint(model, first).T_model_joint.position_m, _place(model, second))


def joint_offset_m(model: Model, first: str, second: str, axis: int) -> float:
    """Return how far the second joint's frame is ahead of the first one's, along x (0) or y (1).

    Raises:
        ControllerError: the description has no such joint.
    """
    return float(_place(model, second)[axis] - _place(model, first)[axis])


def wheel_radius_m(model: Model, joint_name: str) -> float:
    """Return the radius of a wheel's first collision, a cylinder or a sphere.

    Raises:
        ControllerError: there is no such joint or shape.
    """
    joint = _joint(model, joint_name)
    link = model.link(joint.child)
    shape = link.collisions[0].shape if link is not None and link.collisions else None
    if isinstance(shape, Cylinder | Sphere):
        return shape.radius_m
    what = "no collision" if shape is None else f"a {type(shape).__name__} for its first collision"
    text = f"wheel_radius is not given, and wheel link '{joint.child}' has {what} "
    text += f"(Wheel link {joint.child} is NOT modeled as a cylinder or sphere!); "
    raise ControllerError(text + "give wheel_radius")


def _place(model: Model, joint_name: str) -> tuple[float, float, float]:
    x, y, z = _joint(model, joint_name).T_model_joint.position_m
    return x, y, z


def _joint(model: Model, name: str) -> Joint:
    found = model.joint(name)
    if found is None:
        hint = did_you_mean(name, [joint.name for joint in model.joints])
        text = f"the robot's description has no joint '{name}'"
        text += f" ({name} couldn't be retrieved from model description)"
        raise ControllerError(f"{text}; {hint}" if hint else text)
    return found
