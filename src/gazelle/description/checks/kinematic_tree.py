"""What a robot's tree of links and joints promises and cannot keep.

KDL leaves out the mass of a root link; a joint may start outside its limits, or its own damping
and friction may hold it.
"""

from __future__ import annotations

import math

from gazelle.description.model import Joint, JointAxis, JointType, Link, Model
from gazelle.diagnostics import Diagnostics

__all__ = ["check_joints", "check_root"]

# The PR2's joints need up to three times their effort for their top speed.
_MAX_SHARE = 5.0


def check_root(model: Model, diagnostics: Diagnostics) -> None:
    """Report a root link with mass, which KDL leaves out."""
    root = _root(model)
    if model.source_format != "urdf" or root is None or root.name == "world":
        return
    if root.inertial is None or root.inertial.estimated or len(model.links) == 1:
        return
    text = (
        f"the root link '{root.name}' has an inertia. KDL keeps none for a root: "
        "robot_state_publisher warns, and dynamics computed with KDL lack its mass"
    )
    fix = (
        '<link name="base_footprint"/>\n'
        '<joint name="base_footprint_joint" type="fixed">\n'
        f'  <parent link="base_footprint"/>\n  <child link="{root.name}"/>\n</joint>'
    )
    span = root.inertial.span or root.span
    diagnostics.report("robot.root-inertia", text, span, fix=f"add an empty root:\n{fix}")


def check_joints(model: Model, diagnostics: Diagnostics) -> None:
    """Report joints that start outside their limits and joints their damping or friction holds."""
    for joint in model.joints:
        axis = joint.axis
        if axis is None or joint.type is JointType.FIXED:
            continue
        _check_start(joint, axis, diagnostics)
        _check_resistance(joint, axis, diagnostics)


def _root(model: Model) -> Link | None:
    children = {joint.child for joint in model.joints}
    return next((link for link in model.links if link.name not in children), None)


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
    effort, unit = axis.effort, "N·m" if joint.type.is_hinge else "N"
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
        speed = "rad/s" if joint.type.is_hinge else "m/s"
        text = (
            f"joint '{joint.name}' has a damping of {axis.damping:g} {unit}·s/{speed[:-2]}: its "
            f"{effort:g} {unit} drive it at {effort / axis.damping:.3g} {speed} at most, its limit "
            f"says {axis.velocity:g} {speed}"
        )
        fix = f"write damping {0.1 * effort / axis.velocity:.3g}, or raise <limit effort>"
        diagnostics.report("robot.joint-held", text, joint.span, fix=fix)
