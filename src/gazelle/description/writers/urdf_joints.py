"""``<joint>`` and ``<transmission>``."""

from __future__ import annotations

import math

from gazelle.description.model import Joint, JointAxis, JointType, TransmissionTag
from gazelle.description.writers.urdf_elements import add_origin
from gazelle.description.writers.xml_markup import Markup, number, numbers, tidy
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["NO_LIMIT", "add_joint", "add_transmission"]

NO_LIMIT = 1e16
"""What SDF writes for no limit; URDF has no word for it."""

_RANGED = (JointType.REVOLUTE, JointType.PRISMATIC)


def add_joint(robot: Markup, joint: Joint, T_parent_joint: Pose, diagnostics: Diagnostics) -> None:
    """Append a joint of one axis or none.

    Args:
        robot: the ``<robot>``.
        joint: what to write.
        T_parent_joint: its place in the frame the parent link has in the new file.
        diagnostics: receives what cannot be said.
    """
    axis = joint.axis
    kind = joint.type
    if kind is JointType.REVOLUTE and axis and not _is_limited(axis):
        kind = JointType.CONTINUOUS
    item = robot.add("joint", name=joint.name, type=kind.value)
    add_origin(item, T_parent_joint)
    item.add("parent", link=joint.parent)
    item.add("child", link=joint.child)
    if axis is not None:
        item.add("axis", xyz=numbers(map(tidy, axis.xyz)))
        _add_limit(item, kind, axis)
        if axis.damping or axis.friction:
            item.add("dynamics", damping=number(axis.damping), friction=number(axis.friction))
        if axis.position:
            message = (
                f"joint '{joint.name}' starts at {axis.position:g}; in URDF every joint starts at 0"
            )
            diagnostics.report("convert.left-out", message, joint.span)
    _add_extras(item, joint)


def _is_limited(axis: JointAxis) -> bool:
    return axis.lower > -NO_LIMIT or axis.upper < NO_LIMIT


def _bounded(value: float) -> str:
    return number(math.copysign(NO_LIMIT, value) if abs(value) >= NO_LIMIT else value)


def _add_limit(item: Markup, kind: JointType, axis: JointAxis) -> None:
    limit = Markup("limit")
    if kind in _RANGED:
        limit.attributes["lower"] = _bounded(axis.lower)
        limit.attributes["upper"] = _bounded(axis.upper)
    if kind in _RANGED or axis.effort < NO_LIMIT or axis.velocity < NO_LIMIT:
        limit.attributes["effort"] = _bounded(axis.effort)
        limit.attributes["velocity"] = _bounded(axis.velocity)
    item.children += [limit] if limit.attributes else []


def _add_extras(item: Markup, joint: Joint) -> None:
    mimic, safety = joint.mimic, joint.safety
    if mimic is not None:
        words = {"multiplier": number(mimic.multiplier), "offset": number(mimic.offset)}
        item.add("mimic", joint=mimic.joint, **words)
    if safety is not None:
        names = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
        item.add("safety_controller", **{name: number(getattr(safety, name)) for name in names})
    found = {"rising": joint.calibration_rising, "falling": joint.calibration_falling}
    given = {name: number(value) for name, value in found.items() if value is not None}
    if given:
        item.add("calibration", **given)


def add_transmission(
    robot: Markup, transmission: TransmissionTag, diagnostics: Diagnostics
) -> None:
    """Append a transmission in the syntax of ROS Indigo and later."""
    if not transmission.joints:
        message = (
            f"transmission '{transmission.name}' is of a kind of the PR2 with members of its own; "
            "it is left out"
        )
        diagnostics.report("convert.left-out", message, transmission.span)
        return
    item = robot.add("transmission", name=transmission.name)
    item.add("type", transmission.type)
    for joint in transmission.joints:
        member = item.add("joint", name=joint.name)
        for interface in joint.hardware_interfaces:
            member.add("hardwareInterface", interface)
        if joint.role:
            member.add("role", joint.role)
        if joint.mechanical_reduction != 1.0:
            member.add("mechanicalReduction", number(joint.mechanical_reduction))
        if joint.offset:
            member.add("offset", number(joint.offset))
    for actuator in transmission.actuators:
        member = item.add("actuator", name=actuator.name)
        for interface in actuator.hardware_interfaces:
            member.add("hardwareInterface", interface)
        if actuator.role:
            member.add("role", actuator.role)
        member.add("mechanicalReduction", number(actuator.mechanical_reduction))
