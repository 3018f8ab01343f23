"""Judges wheels by geometry: do their axles fit their shapes and each other?"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.forward_kinematics import fixed_groups
from gazelle.description.model import Box, Cylinder, Joint, JointType, Link, Model, PluginTag
from gazelle.diagnostics import Diagnostics, Severity

__all__ = ["Wheel", "axis_in_model", "check_wheel_shapes", "check_wheels", "wheels_of"]

_NAME = re.compile(r"wheel|tire|tyre", re.IGNORECASE)
_CASTER = re.compile(r"cast[eo]r|swivel|support", re.IGNORECASE)
_DRIVE = re.compile(r"drive|steer|skid|tricycle", re.IGNORECASE)
_HORIZONTAL = 0.5
_MAX_TILT_DEG = 10.0
_LEFT = re.compile(r"left|(?<![a-z])l(?![a-z])", re.IGNORECASE)
_OFF_AXLE_M = 0.002


class Wheel(NamedTuple):
    """A wheel.

    Attributes:
        joint: its axle.
        link: what turns.
        is_caster: it swivels freely, nothing drives it.
        axis: (3,), unit vector of the axle in the model's frame.
    """

    joint: Joint
    link: Link
    is_caster: bool
    axis: NDArray[np.float64]


def wheels_of(model: Model) -> tuple[Wheel, ...]:
    """Return the joints with a level axis and no limits that are called or driven as wheels."""
    driven = frozenset(_driven(model.plugins))
    above = {joint.child: joint for joint in model.joints}
    links = {link.name: link for link in model.links}
    found = []
    for joint in model.joints:
        link = links.get(joint.child)
        if link is None or not _turns_freely(joint):
            continue
        axis = axis_in_model(joint)
        named = _NAME.search(joint.name) or _NAME.search(joint.child)
        if abs(axis[2]) < _HORIZONTAL and (named or joint.name in driven):
            caster = joint.name not in driven and _swivels(joint, above)
            found.append(Wheel(joint, link, caster, axis))
    return tuple(found)


def axis_in_model(joint: Joint) -> NDArray[np.float64]:
    """Return the unit vector, (3,), of a joint's axis in the model's frame; zeros without one."""
    if joint.axis is None:
        return np.zeros(3)
    axis = np.asarray(joint.T_model_joint.rotate(joint.axis.xyz), dtype=np.float64)
    return axis / max(float(np.linalg.norm(axis)), 1e-12)


def check_wheel_shapes(model: Model, diagnostics: Diagnostics) -> None:
    """Report wheels whose collisions are boxes."""
    for wheel in wheels_of(model):
        shapes = [item.shape for item in wheel.link.collisions]
        boxes = [shape for shape in shapes if isinstance(shape, Box)]
        if not boxes or len(boxes) < len(shapes):
            continue
        across = sorted(boxes[0].size_m)[1:]
        text = (
            f"the collision of wheel '{wheel.link.name}' is a box: the robot stands on its sides "
            "and bumps over its edges instead of rolling"
        )
        sizes = f'radius="{max(across) / 2:.4g}" length="{min(boxes[0].size_m):.4g}"'
        span = wheel.link.collisions[0].span or wheel.link.span
        diagnostics.report("robot.wheel-box", text, span, fix=f"use <cylinder {sizes}/>")


def check_wheels(model: Model, diagnostics: Diagnostics) -> None:
    """Report wheels that cannot roll, and pairs that turn against each other."""
    wheels, groups = wheels_of(model), fixed_groups(model)
    links = {link.name: link for link in model.links}
    _check_upright_axes(model, links, diagnostics)
    for wheel in wheels:
        carried = [links[name] for name in groups[wheel.link.name]]
        _check_touching(wheel, carried, diagnostics)
        _check_shape(wheel.joint, wheel.link, diagnostics)
    for left, right in _pairs(wheels):
        _check_pair(left, right, model, diagnostics)


def _turns_freely(joint: Joint) -> bool:
    if joint.type is JointType.CONTINUOUS:
        return True
    axis = joint.axis
    # SDF's revolute joints without limits, or with ±1e16.
    return joint.type is JointType.REVOLUTE and axis is not None and axis.upper - axis.lower > 1e3


def _swivels(joint: Joint, above: Mapping[str, Joint]) -> bool:
    if _CASTER.search(joint.name) or _CASTER.search(joint.child):
        return True
    upper = above.get(joint.parent)
    return upper is not None and _turns_freely(upper) and abs(axis_in_model(upper)[2]) > _HORIZONTAL


def _driven(plugins: tuple[PluginTag, ...]) -> Iterator[str]:
    for plugin in plugins:
        if _DRIVE.search(plugin.filename):
            for tag in plugin.parameters.walk():
                if "joint" in tag.name.lower():
                    yield tag.text.strip()


def _check_touching(wheel: Wheel, carried: Sequence[Link], diagnostics: Diagnostics) -> None:
    if any(link.collisions for link in carried) or not any(link.visuals for link in carried):
        return
    text = (
        f"wheel '{wheel.link.name}' has a <visual> and no <collision>: it touches nothing, the "
        "robot sinks in until another part of it lies on the ground"
    )
    fix = "copy <origin> and <geometry> of the <visual> into a <collision>"
    diagnostics.report("robot.wheel-without-collision", text, wheel.link.span, fix=fix)


def _check_upright_axes(model: Model, links: Mapping[str, Link], diagnostics: Diagnostics) -> None:
    """Report wheels whose axis is not level, which are no wheels to `wheels_of`."""
    for joint in model.joints:
        link = links.get(joint.child)
        named = re.search("wheel|tire|tyre", f"{joint.name} {joint.child}", re.IGNORECASE)
        if link is None or not named or joint.type is not JointType.CONTINUOUS:
            continue
        if abs(axis_in_model(joint)[2]) >= math.sqrt(0.5):
            _check_shape(joint, link, diagnostics)


def _check_shape(joint: Joint, link: Link, diagnostics: Diagnostics) -> None:
    for shape_axis, centre, what in _cylinders(link):
        axis = axis_in_model(joint)
        cosine = min(1.0, abs(float(axis @ shape_axis)))
        tilt = math.degrees(math.acos(cosine))
        if tilt > _MAX_TILT_DEG:
            if abs(shape_axis[2]) > math.sqrt(0.5) and abs(axis[2]) > math.sqrt(0.5):
                continue
            text = (
                f"joint '{joint.name}' turns about {_shown(axis)} of the model, but the {what} of "
                f"wheel '{link.name}' is a cylinder about {_shown(shape_axis)}, {tilt:.0f}° off: "
                "it wobbles like a coin instead of rolling"
            )
            place = joint.axis.span if joint.axis is not None else None
            diagnostics.report(
                "robot.wheel-axis", text, place or joint.span, fix=_axis_fix(joint, shape_axis)
            )
            return
        arm = centre - np.asarray(joint.T_model_joint.position_m)
        off = float(np.linalg.norm(arm - (arm @ axis) * axis))
        if off > _OFF_AXLE_M:
            text = (
                f"the {what} of wheel '{link.name}' is centred {off * 1e3:.3g} mm beside the axis "
                f"of joint '{joint.name}': it turns like a cam, the robot hops"
            )
            fix = f"set <origin> of joint '{joint.name}' to the wheel's centre"
            diagnostics.report("robot.wheel-off-centre", text, joint.span, fix=fix)
            return


def _axis_fix(joint: Joint, shape_axis: NDArray[np.float64]) -> str:
    own = np.asarray(joint.T_model_joint.inverse().rotate(tuple(shape_axis)))
    own = own * (1.0 if own[np.argmax(np.abs(own))] > 0 else -1.0)
    axis_text = " ".join(f"{value:.4g}" for value in np.round(own, 4) + 0.0)
    return f'write <axis xyz="{axis_text}"/>, or turn the cylinder by its <origin rpy="…"/>'


def _cylinders(link: Link) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64], str]]:
    """Yield axis and centre in the model's frame; the collision counts, without one the visual."""
    posed = [(item.shape, item.T_link_collision, "collision") for item in link.collisions]
    posed = posed or [(item.shape, item.T_link_visual, "visual") for item in link.visuals]
    if len(posed) != 1:
        return
    shape, T_link_shape, what = posed[0]
    if isinstance(shape, Cylinder) and shape.length_m < 2.0 * shape.radius_m:
        pose = link.T_model_link @ T_link_shape
        yield np.asarray(pose.rotate((0.0, 0.0, 1.0))), np.asarray(pose.position_m), what


def _pairs(wheels: Sequence[Wheel]) -> Iterator[tuple[Wheel, Wheel]]:
    """Yield wheels that have the same name but for left and right."""
    by_name = {wheel.joint.name: wheel for wheel in wheels if not wheel.is_caster}
    for name, wheel in by_name.items():
        for match in _LEFT.finditer(name):
            other = _other_side(name, match)
            if other in by_name:
                yield wheel, by_name[other]
                break


def _other_side(name: str, match: re.Match[str]) -> str:
    opposites = {"left": "right", "Left": "Right", "LEFT": "RIGHT", "l": "r", "L": "R"}
    return name[: match.start()] + opposites.get(match[0], "") + name[match.end() :]


def _check_pair(left: Wheel, right: Wheel, model: Model, diagnostics: Diagnostics) -> None:
    if float(left.axis @ right.axis) > -0.5:
        return
    text = (
        f"the axes of '{left.joint.name}' {_shown(left.axis)} and '{right.joint.name}' "
        f"{_shown(right.axis)} point against each other: the same speed for both turns the robot "
        "on the spot, so a command to drive straight on spins it"
    )
    wrong = left if left.axis[1] < right.axis[1] else right
    own = np.asarray(wrong.joint.T_model_joint.inverse().rotate(tuple(-wrong.axis)))
    axis_text = " ".join(f"{value:.4g}" for value in np.round(own, 4) + 0.0)
    fix = f"write <axis xyz=\"{axis_text}\"/> in joint '{wrong.joint.name}'"
    # Without a drive it is a picture of a robot, and a peculiarity at most.
    driven = model.plugins or model.transmissions or model.ros2_controls
    severity = None if driven else Severity.INFO
    diagnostics.report(
        "robot.wheel-axes-opposed", text, wrong.joint.span, fix=fix, severity=severity
    )


def _shown(axis: NDArray[np.float64]) -> str:
    return "(" + ", ".join(f"{value:.2g}" for value in np.round(axis, 3) + 0.0) + ")"
