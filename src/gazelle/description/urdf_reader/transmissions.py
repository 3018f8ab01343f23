"""``<transmission>`` in the syntax of the PR2 and in that of ROS Indigo and later."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from gazelle.description.model import ActuatorTag, TransmissionJoint, TransmissionTag
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import check_vocabulary
from gazelle.description.xml import Tag, float_from
from gazelle.diagnostics import did_you_mean, nearest_names
from gazelle.diagnostics.suggestions import likeness

__all__ = ["read_transmission"]

# Classes of hardware_interface and transmission_interface, and the PR2's.
_INTERFACES = (
    "ActuatorStateInterface",
    "EffortActuatorInterface",
    "EffortJointInterface",
    "ForceTorqueSensorInterface",
    "ImuSensorInterface",
    "JointStateInterface",
    "PosVelAccJointInterface",
    "PosVelJointInterface",
    "PositionActuatorInterface",
    "PositionJointInterface",
    "VelocityActuatorInterface",
    "VelocityJointInterface",
)
_TYPES = (
    "DifferentialTransmission",
    "FourBarLinkageTransmission",
    "GripperTransmission",
    "PR2GripperTransmission",
    "SimpleTransmission",
    "WristTransmission",
)
_SLIP = 0.85
_CHILDREN = ("type", "joint", "actuator", "mechanicalReduction", "motorTorqueConstant")
# Wrist and gripper transmissions of the PR2 have members of their own; control looks at them.
_PR2_MEMBERS = (
    "compensator",
    "flexJoint",
    "gap_joint",
    "leftActuator",
    "leftJoint",
    "passive_joint",
    "rightActuator",
    "rightJoint",
    "rollJoint",
    "simulated_actuated_joint",
    "use_simulated_gripper_joint",
)


def read_transmission(
    tag: Tag, joints: Collection[str], context: ReadContext
) -> TransmissionTag | None:
    """Return a transmission; None (reported) when type or joints are missing.

    A mechanical reduction beside the joint and actuator (PR2) is given to both kinds of member
    that have none of their own.

    Args:
        tag: the ``<transmission>``.
        joints: names of the robot's joints.
        context: where to report.
    """
    check_vocabulary(
        tag,
        context.diagnostics,
        attributes=("name", "type"),
        children=_CHILDREN + _PR2_MEMBERS,
        once=("type",),
    )
    name = tag.attributes.get("name", "").strip()
    kind = tag.text_of("type") or tag.attributes.get("type", "").strip()
    members = tuple(_read_joint(child, joints, name, context) for child in tag.find_all("joint"))
    if not kind or not (members or any(child.name in _PR2_MEMBERS for child in tag.children)):
        lacking = "a <type>" if not kind else "a <joint>"
        message = f"transmission '{name}' lacks {lacking} and is left out"
        context.diagnostics.report("urdf.transmission-incomplete", message, tag.span)
        return None
    reduction = float_from(tag.find("mechanicalReduction"), 1.0, context.diagnostics)
    actuators = tuple(
        _read_actuator(child, reduction, context) for child in tag.find_all("actuator")
    )
    for place in tag.find_all("type"):
        _check_word(place, place.text, _TYPES, f"transmission '{name}'", context)
    type_span = next((child.span for child in tag.find_all("type")), tag.span)
    return TransmissionTag(name, kind, members, actuators, tag.span, type_span)


def _read_joint(
    tag: Tag, joints: Collection[str], transmission: str, context: ReadContext
) -> TransmissionJoint:
    check_vocabulary(
        tag,
        context.diagnostics,
        attributes=("name",),
        children=("hardwareInterface", "role", "mechanicalReduction", "offset"),
    )
    name = tag.attributes.get("name", "").strip()
    if name not in joints:
        hint = did_you_mean(name, joints)
        message = f"transmission '{transmission}' names joint '{name}', which does not exist"
        context.diagnostics.report("urdf.transmission-joint", message, tag.span, fix=hint)
    return TransmissionJoint(
        name,
        _interfaces(tag, f"joint '{name}' of transmission '{transmission}'", context),
        tag.text_of("role"),
        float_from(tag.find("mechanicalReduction"), 1.0, context.diagnostics),
        float_from(tag.find("offset"), 0.0, context.diagnostics),
        tag.span,
    )


def _read_actuator(tag: Tag, reduction: float, context: ReadContext) -> ActuatorTag:
    known = ("hardwareInterface", "role", "mechanicalReduction", "motorTorqueConstant")
    check_vocabulary(tag, context.diagnostics, attributes=("name",), children=known)
    name = tag.attributes.get("name", "").strip()
    return ActuatorTag(
        name,
        float_from(tag.find("mechanicalReduction"), reduction, context.diagnostics),
        _interfaces(tag, f"actuator '{name}'", context),
        tag.text_of("role"),
    )


def _interfaces(tag: Tag, owner: str, context: ReadContext) -> tuple[str, ...]:
    found = [child for child in tag.find_all("hardwareInterface") if child.text]
    for child in found:
        _check_word(child, child.text, _INTERFACES, owner, context)
    return tuple(child.text for child in found)


def _check_word(
    tag: Tag, text: str, known: Sequence[str], owner: str, context: ReadContext
) -> None:
    """Report the name of a class that is a slip for one of ROS's; others may be a package's own."""
    word = text.replace("::", "/").rpartition("/")[2]
    near = nearest_names(word, known, count=1) if word not in known else ()
    if near and likeness(word, near[0]) >= _SLIP:
        message = f"<{tag.name}> of {owner} is '{text}', which is not known"
        fix = f"did you mean '{near[0]}'?"
        context.diagnostics.report("urdf.transmission-class", message, tag.span, fix=fix)
