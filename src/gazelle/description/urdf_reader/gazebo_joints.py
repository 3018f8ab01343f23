"""What ``<gazebo reference="joint">`` changes about a joint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.description.model import Joint
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.sensors import read_sensor
from gazelle.description.urdf_reader.gazebo_values import bool_value, float_value, report_unknown
from gazelle.description.xml import Tag

__all__ = ["apply_to_joint"]

_ELSEWHERE = ("plugin",)


def apply_to_joint(joint: Joint, blocks: list[Tag], context: ReadContext) -> Joint:
    """Return the joint with all its ``<gazebo reference>`` blocks applied, the later ones last.

    Args:
        joint: the joint as URDF describes it.
        blocks: the ``<gazebo>`` elements that refer to it.
        context: where to report.
    """
    for tag in (tag for block in blocks for tag in block.children):
        handler = _JOINT_WORDS.get(tag.name)
        if handler is not None:
            joint = handler(joint, tag, context)
        elif tag.name not in _ELSEWHERE:
            report_unknown(tag, f"joint '{joint.name}'", _JOINT_WORDS, context)
    return joint


def _number(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        value = float_value(tag, context)
        changes: dict[str, Any] = {} if value is None else {name: value}
        return replace(joint, **changes)

    return apply


def _flag(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        changes: dict[str, Any] = {name: bool_value(tag, False, context)}
        return replace(joint, **changes)

    return apply


def _spring(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        value = float_value(tag, context)
        if value is None:
            return joint
        if joint.axis is None:
            message = f"<{tag.name}> has no effect: joint '{joint.name}' is {joint.type.value}"
            context.diagnostics.report("urdf.gazebo-no-axis", message, tag.span)
            return joint
        changes: dict[str, Any] = {name: value}
        return replace(joint, axis=replace(joint.axis, **changes))

    return apply


def _keep_fixed(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    kept = joint.disable_fixed_joint_lumping or bool_value(tag, False, context)
    return replace(joint, disable_fixed_joint_lumping=kept)


def _fudge_factor(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    message = f"<fudgeFactor> of joint '{joint.name}' is a word of ODE's solver; it has no effect"
    context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span)
    return joint


def _sensor(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    sensor = read_sensor(tag, context)
    return joint if sensor is None else replace(joint, sensors=(*joint.sensors, sensor))


def _physics(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    """SDF's own ``<physics>``, which sdformat copies into the joint."""
    ode = tag.find("ode")
    for block in (block for block in (tag, ode) if block is not None):
        for child in block.children:
            if child.name in _PHYSICS_WORDS:
                joint = _PHYSICS_WORDS[child.name](joint, child, context)
            elif child.name == "limit":
                for value in child.children:
                    if value.name in _LIMIT_WORDS:
                        joint = _LIMIT_WORDS[value.name](joint, value, context)
            elif child.name != "ode":
                report_unknown(child, f"joint '{joint.name}'", _PHYSICS_WORDS, context)
    return joint


_PHYSICS_WORDS: dict[str, Callable[[Joint, Tag, ReadContext], Joint]] = {
    "cfm": _number("cfm"),
    "cfm_damping": _flag("implicit_spring_damper"),
    "erp": _number("erp"),
    "implicit_spring_damper": _flag("implicit_spring_damper"),
    "provide_feedback": _flag("provide_feedback"),
}
_LIMIT_WORDS = {"cfm": _number("limit_cfm"), "erp": _number("limit_erp")}
_JOINT_WORDS: dict[str, Callable[[Joint, Tag, ReadContext], Joint]] = {
    "cfmDamping": _flag("implicit_spring_damper"),
    "disableFixedJointLumping": _keep_fixed,
    "fudgeFactor": _fudge_factor,
    "implicitSpringDamper": _flag("implicit_spring_damper"),
    "physics": _physics,
    "preserveFixedJoint": _keep_fixed,
    "provideFeedback": _flag("provide_feedback"),
    "sensor": _sensor,
    "springReference": _spring("spring_reference"),
    "springStiffness": _spring("spring_stiffness"),
    "stopCfm": _number("limit_cfm"),
    "stopErp": _number("limit_erp"),
}
