"""Measures of wheels: parameters first, the robot's description (URDF) second."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.description.model import Cylinder, Joint, Model, Sphere
from gazelle.diagnostics import did_you_mean

__all__ = [
    "joint_distance_m",
    "joint_offset_m",
    "measure",
    "positive",
    "report_exchanged",
    "report_misfits",
    "wheel_radius_m",
]


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


# Joint frames stand anywhere along the axle; a tyre gives way.
_TOLERATED = {"wheel_separation": 0.1, "wheel_radius": 0.05}


def positive(context: ControllerContext, key: str) -> float:
    """Return a length that must be given and be above 0.

    Raises:
        ControllerError: it is missing or not above 0.
    """
    parameters = context.parameters
    parameters.require(key)
    return _checked(context, key, parameters.number(key))


def measure(context: ControllerContext, key: str, described: Callable[[], float]) -> float:
    """Return a length from the parameters, or from the robot's description.

    Raises:
        ControllerError: neither has it, or it is not above 0.
    """
    parameters = context.parameters
    if parameters.has(key):
        return _checked(context, key, parameters.number(key))
    try:
        value = described()
    except ControllerError as error:
        raise ControllerError(f"controller '{context.name}': {error}") from None
    if context.ros_version == 1:
        context.ports.log("info", f"{key} {value:g} m is taken from the robot's description")
    else:
        text = f"{key} is not given; {value:g} m of the robot's description is used. Real ROS 2 "
        text += f"would refuse: Invalid value set during initialization for parameter '{key}'"
        parameters.report("control.wheel-measure", text, fix=f"give {key}: {value:g}")
    return _checked(context, key, value)


def report_exchanged(context: ControllerContext, left: str, right: str) -> None:
    """Report a left wheel that stands to the right of the right one: turns go the wrong way."""
    model = context.robot.model
    if model.joint(left) is None or model.joint(right) is None:
        return
    gap = joint_offset_m(model, right, left, 1)
    if gap < 0:
        text = f"'{left}' is named as a left wheel and stands {-gap:g} m to the right of '{right}'"
        text += ": the base turns right when it is told to turn left"
        context.parameters.report("control.wheels-exchanged", text, fix="exchange the names")


def report_misfits(context: ControllerContext, left: str, right: str) -> None:
    """Report a separation or radius that the robot's geometry contradicts; multipliers aside."""
    model = context.robot.model
    if model.joint(left) is None or model.joint(right) is None:
        return
    measured = {"wheel_separation": joint_distance_m(model, left, right)}
    with suppress(ControllerError):  # of a mesh no radius is known
        measured["wheel_radius"] = wheel_radius_m(model, left)
    for key, truth in measured.items():
        if not context.parameters.has(key) or truth <= 0.0:
            continue
        value = context.parameters.number(key)
        if abs(value - truth) <= _TOLERATED[key] * truth:
            continue
        what = (
            f"'{left}' and '{right}' stand {truth:.4g} m apart"
            if key == "wheel_separation"
            else f"the wheel of '{left}' has a radius of {truth:.4g} m"
        )
        does = "yaw rates" if key == "wheel_separation" else "speeds"
        text = f"{key} is {value:g} m, but {what}: {does} and odometry are off by a factor of "
        text += f"{truth / value:.3g}" if key == "wheel_radius" else f"{value / truth:.3g}"
        context.parameters.report("control.wheel-geometry", text, fix=f"write {key}: {truth:.4g}")


def _checked(context: ControllerContext, key: str, value: float) -> float:
    if value > 0:
        return value
    raise ControllerError(f"controller '{context.name}': {key} is {value:g}, it must be above 0")
