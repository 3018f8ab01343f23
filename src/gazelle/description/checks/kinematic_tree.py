"""Joints that cannot do what their numbers promise."""

from __future__ import annotations

import math

from gazelle.description.model import Joint, JointAxis, JointType, Model
from gazelle.diagnostics import Diagnostics

__all__ = ["check_joints"]

_TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)
# The PR2's joints need up to three times their effort for their top speed.
_MAX_SHARE = 5.0


def check_joints(model: Model, diagnostics: Diagnostics) -> None:
    """Report joints that start outside their limits and joints their damping or friction holds."""
    for joint in model.joints:
        axis = joint.axis
        if axis is None or joint.type is JointType.FIXED:
            continue
        _check_start(joint, axis, diagnostics)
        _check_resistance(joint, axis, diagnostics)


def _check_start(joint: Joint, axis: JointAxis, diagnostics: Diagnostics) -> None:
    if joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC) or joint.mimic is not None:
        return
    if axis.lower > axis.upper or axis.lower <= axis.position <= axis.upper:
        return
    unit = "m" if joint.type is JointType.PRISMATIC else "rad"
    middle = (axis.lower + axis.upper) / 2
    text = (
        f"joint '{joint.name}' starts at {axis.position:g} {unit}, outside its limits "
        f"{axis.lower:g} … {axis.upper:g}: the limit pushes it in with a jerk"
    )
    fix = f"spawn with: -J {joint.name} {middle:.4g}"
    diagnostics.report("robot.start-outside-limits", text, joint.span, fix=fix)


def _check_resistance(joint: Joint, axis: JointAxis, diagnostics: Diagnostics) -> None:
    effort, unit = axis.effort, "N·m" if joint.type in _TURNING else "N"
    if not 0.0 < effort < math.inf:
        return
    if axis.friction >= effort:
        text = (
            f"joint '{joint.name}' has a friction of {axis.friction:g} {unit} and an effort limit "
            f"of {effort:g} {unit}: its motor cannot move it"
        )
        fix = "lower <dynamics friction>, or raise <limit effort>"
        diagnostics.report("robot.joint-held", text, joint.span, fix=fix)
        return
    if not 0.0 < axis.velocity < math.inf:
        return
    if axis.damping * axis.velocity > _MAX_SHARE * effort:
        speed = "rad/s" if joint.type in _TURNING else "m/s"
        text = (
            f"joint '{joint.name}' has a damping of {axis.damping:g} {unit}·s/{speed[:-2]}: its "
            f"{effort:g} {unit} drive it at {effort / axis.damping:.3g} {speed} at most, its limit "
            f"says {axis.velocity:g} {speed}"
        )
        fix = f"write damping {0.1 * effort / axis.velocity:.3g}, or raise <limit effort>"
        diagnostics.report("robot.joint-held", text, joint.span, fix=fix)
