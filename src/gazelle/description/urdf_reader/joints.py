"""``<joint>``: type, ends, axis, limits and what else URDF hangs on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from gazelle.description.model import Joint, JointAxis, JointType, Mimic, SafetyController
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import (
    check_vocabulary,
    number_attribute,
    origin_of,
    vector_attribute,
)
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose

__all__ = ["Limits", "ReadJoint", "read_joint", "read_limits"]

_RANGED = (JointType.REVOLUTE, JointType.PRISMATIC)
_TYPES = {
    "continuous": JointType.CONTINUOUS,
    "fixed": JointType.FIXED,
    "floating": JointType.FLOATING,
    "planar": JointType.PLANAR,
    "prismatic": JointType.PRISMATIC,
    "revolute": JointType.REVOLUTE,
}
_ONCE = (
    "axis",
    "calibration",
    "child",
    "dynamics",
    "limit",
    "mimic",
    "origin",
    "parent",
    "safety_controller",
)
# Written as an example where no joint of the robot has a limit.
_EXAMPLES = {"effort": "10", "velocity": "1"}
_WITHOUT_AXIS = (JointType.FIXED, JointType.FLOATING)


class Limits(NamedTuple):
    """Limits in rad or m, N·m or N, rad/s or m/s; infinite where there is none."""

    lower: float = -math.inf
    upper: float = math.inf
    effort: float = math.inf
    velocity: float = math.inf


class ReadJoint(NamedTuple):
    """A joint whose pose in the model is not known yet."""

    joint: Joint
    T_parent_joint: Pose
    tag: Tag


def read_limits(
    joint: Tag, name: str, kind: JointType, context: ReadContext, others: Sequence[Tag] = ()
) -> Limits:
    """Return a joint's limits; what is missing is reported as check_urdf does.

    Negative effort and velocity mean no limit, as in Gazebo.

    Args:
        joint: the ``<joint>``.
        name: its name.
        kind: its type; only revolute and prismatic joints have a range.
        context: where to report.
        others: joints whose limits are examples of what is missing.
    """
    tag = joint.find("limit")
    if tag is None:
        if kind in _RANGED:
            message = f"joint '{name}' is {kind.value} but it does not specify limits"
            context.diagnostics.report(
                "urdf.limit-missing", message, joint.span, fix=_limits_to_add(kind, others)
            )
        return Limits()
    known = ("lower", "upper", "effort", "velocity")
    check_vocabulary(tag, context.diagnostics, attributes=known)
    missing = [word for word in ("effort", "velocity") if word not in tag.attributes]
    if missing:
        message = f"<limit> of joint '{name}' lacks {' and '.join(missing)}"
        fix = f"add {_bounds(missing, others)}, with the numbers of this joint"
        context.diagnostics.report("urdf.limit-incomplete", message, tag.span, fix=fix)
    effort = _bound(tag, "effort", context)
    velocity = _bound(tag, "velocity", context)
    if kind is not JointType.FIXED:
        _report_zero(tag, name, effort, velocity, context)
    if kind not in _RANGED:
        _read_range(tag, context)
        return Limits(effort=effort, velocity=velocity)
    lower, upper = _ordered(tag, name, context)
    return Limits(lower, upper, effort, velocity)


def read_joint(
    tag: Tag, name: str, context: ReadContext, others: Sequence[Tag] = ()
) -> ReadJoint | None:
    """Return a joint; None (reported) when its type or an end is missing.

    Args:
        tag: the ``<joint>``.
        name: its name.
        context: where to report.
        others: joints whose limits are examples of what is missing.
    """
    check_vocabulary(
        tag, context.diagnostics, attributes=("name", "type"), children=_ONCE, once=_ONCE
    )
    kind = _read_type(tag, name, context)
    parent, child = _end(tag, "parent"), _end(tag, "child")
    if not parent or not child:
        lacking = " and ".join(
            f'<{end} link="…"/>' for end, link in (("parent", parent), ("child", child)) if not link
        )
        message = f"joint '{name}' is missing {lacking}"
        ends = ("parent", parent), ("child", child)
        written = [found for end, link in ends if not link and (found := tag.find(end))]
        span = written[0].span if written else tag.span
        fix = _end_to_write(written)
        context.diagnostics.report("urdf.joint-ends", message, span, fix=fix)
    if kind is None:
        return None
    origin = origin_of(tag, context.diagnostics)
    limits = read_limits(tag, name, kind, context, others)
    calibration = tag.find("calibration")
    joint = Joint(
        name,
        kind,
        parent,
        child,
        axis=_read_axis(tag, name, kind, limits, context),
        mimic=_read_mimic(tag, name, context),
        safety=_read_safety(tag, name, context),
        calibration_rising=_calibration(calibration, "rising", context),
        calibration_falling=_calibration(calibration, "falling", context),
        span=tag.span,
    )
    return ReadJoint(joint, origin, tag) if parent and child else None


def _bound(tag: Tag, word: str, context: ReadContext) -> float:
    value = number_attribute(tag, word, context.diagnostics)
    return math.inf if value is None or value < 0.0 else value


def _read_range(tag: Tag, context: ReadContext) -> tuple[float, float]:
    lower = number_attribute(tag, "lower", context.diagnostics)
    upper = number_attribute(tag, "upper", context.diagnostics)
    return lower or 0.0, upper or 0.0


def _ordered(tag: Tag, name: str, context: ReadContext) -> tuple[float, float]:
    lower, upper = _read_range(tag, context)
    if lower > upper:
        message = f"<limit> of joint '{name}': lower {lower:g} is above upper {upper:g}; exchanged"
        fix = f'write lower="{tag.attributes["upper"]}" upper="{tag.attributes["lower"]}"'
        both = "lower" in tag.attributes and "upper" in tag.attributes
        context.diagnostics.report("urdf.limit-order", message, tag.span, fix=fix if both else "")
        return upper, lower
    if lower == upper:
        message = f"<limit> of joint '{name}' leaves no range ({lower:g} to {upper:g}): it is stuck"
        context.diagnostics.report("urdf.limit-no-range", message, tag.span)
    return lower, upper


def _report_zero(tag: Tag, name: str, effort: float, velocity: float, context: ReadContext) -> None:
    if effort == 0.0:
        message = f"joint '{name}' has effort=\"0\": no motor and no controller can move it"
        context.diagnostics.report("urdf.effort-zero", message, tag.span)
    if velocity == 0.0:
        message = f"joint '{name}' has velocity=\"0\": controllers that obey limits hold it still"
        context.diagnostics.report("urdf.velocity-zero", message, tag.span)


def _read_type(tag: Tag, name: str, context: ReadContext) -> JointType | None:
    word = tag.attributes.get("type", "").strip()
    if not word:
        message = f"joint '{name}' has no type"
        context.diagnostics.report("urdf.joint-no-type", message, tag.span, fix=_type_to_write(tag))
        return None
    if word not in _TYPES:
        hint = did_you_mean(word, _TYPES) or f"use one of {', '.join(sorted(_TYPES))}"
        message = f"joint '{name}' has no known type: '{word}'"
        context.diagnostics.report("urdf.joint-type", message, tag.span, fix=hint)
        return None
    return _TYPES[word]


def _type_to_write(tag: Tag) -> str:
    """Guess a joint's type by what is written for it."""
    limit, axis = tag.find("limit"), tag.find("axis")
    if limit is not None and ("lower" in limit.attributes or "upper" in limit.attributes):
        kind, why = "revolute", 'it has limits; "prismatic" where it slides'
    elif axis is not None or limit is not None or tag.find("dynamics") is not None:
        kind, why = "continuous", "it has an axis and no limits"
    else:
        kind, why = "fixed", "it has neither axis nor limits"
    return f'write type="{kind}" ({why})'


def _limits_to_add(kind: JointType, others: Sequence[Tag]) -> str:
    lower, upper = ("-3.1416", "3.1416") if kind is JointType.REVOLUTE else ("0", "0.1")
    bounds = _bounds(("effort", "velocity"), others)
    fix = f'add <limit lower="{lower}" upper="{upper}" {bounds}/> with the numbers of this joint'
    return fix + (", or make it continuous" if kind is JointType.REVOLUTE else "")


def _bounds(words: Sequence[str], others: Sequence[Tag]) -> str:
    """Write bounds as other joints of the robot have them, as an example."""
    found = []
    limits = [tag for joint in others if (tag := joint.find("limit")) is not None]
    for word in words:
        values = [tag.attributes[word] for tag in limits if tag.attributes.get(word)]
        value = max(values, key=values.count) if values else _EXAMPLES[word]
        found.append(f'{word}="{value}"')
    return " ".join(found)


def _end_to_write(written: Sequence[Tag]) -> str:
    """Say how an end is written whose link stands in an attribute of another name."""
    for tag in written:
        if len(tag.attributes) == 1:
            (value,) = tag.attributes.values()
            return f'write <{tag.name} link="{value}"/>'
    return ""


def _end(tag: Tag, which: str) -> str:
    end = tag.find(which)
    return end.attributes.get("link", "").strip() if end is not None else ""


def _read_axis(
    tag: Tag, name: str, kind: JointType, limits: Limits, context: ReadContext
) -> JointAxis | None:
    axis, dynamics = tag.find("axis"), tag.find("dynamics")
    xyz = (1.0, 0.0, 0.0)
    if axis is not None:
        check_vocabulary(axis, context.diagnostics, attributes=("xyz",))
        xyz = vector_attribute(axis, "xyz", context.diagnostics) or xyz
    damping, friction = _read_dynamics(dynamics, name, context)
    if kind in _WITHOUT_AXIS:
        return None
    length = math.hypot(*xyz)
    if length == 0.0 and axis is not None:
        message = f"the axis of joint '{name}' is 0 0 0: it has no direction"
        context.diagnostics.report("urdf.zero-axis", message, axis.span)
        xyz, length = (1.0, 0.0, 0.0), 1.0
    return JointAxis(
        (xyz[0] / length, xyz[1] / length, xyz[2] / length),
        lower=limits.lower,
        upper=limits.upper,
        effort=limits.effort,
        velocity=limits.velocity,
        damping=damping,
        friction=friction,
        span=axis.span if axis is not None else None,
    )


def _read_dynamics(tag: Tag | None, name: str, context: ReadContext) -> tuple[float, float]:
    if tag is None:
        return 0.0, 0.0
    check_vocabulary(tag, context.diagnostics, attributes=("damping", "friction"))
    if "damping" not in tag.attributes and "friction" not in tag.attributes:
        message = f"<dynamics> of joint '{name}' has neither damping nor friction"
        context.diagnostics.report("urdf.dynamics-empty", message, tag.span)
    damping = number_attribute(tag, "damping", context.diagnostics) or 0.0
    friction = number_attribute(tag, "friction", context.diagnostics) or 0.0
    if damping < 0.0 or friction < 0.0:
        message = f"<dynamics> of joint '{name}' is negative: it would feed energy in; 0 is used"
        context.diagnostics.report("urdf.dynamics-negative", message, tag.span)
    return max(0.0, damping), max(0.0, friction)


def _read_mimic(tag: Tag, name: str, context: ReadContext) -> Mimic | None:
    mimic = tag.find("mimic")
    if mimic is None:
        return None
    check_vocabulary(mimic, context.diagnostics, attributes=("joint", "multiplier", "offset"))
    leader = mimic.attributes.get("joint", "").strip()
    if not leader:
        message = f"<mimic> of joint '{name}' names no joint"
        context.diagnostics.report("urdf.mimic-no-joint", message, mimic.span)
        return None
    multiplier = number_attribute(mimic, "multiplier", context.diagnostics)
    offset = number_attribute(mimic, "offset", context.diagnostics)
    return Mimic(leader, 1.0 if multiplier is None else multiplier, offset or 0.0)


def _read_safety(tag: Tag, name: str, context: ReadContext) -> SafetyController | None:
    safety = tag.find("safety_controller")
    if safety is None:
        return None
    names = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
    check_vocabulary(safety, context.diagnostics, attributes=names)
    if "k_velocity" not in safety.attributes:
        message = f"<safety_controller> of joint '{name}' has no k_velocity"
        context.diagnostics.report("urdf.safety-incomplete", message, safety.span)
    values = [number_attribute(safety, word, context.diagnostics) or 0.0 for word in names]
    return SafetyController(*values)


def _calibration(tag: Tag | None, word: str, context: ReadContext) -> float | None:
    if tag is None:
        return None
    check_vocabulary(
        tag, context.diagnostics, attributes=("rising", "falling", "reference_position")
    )
    return number_attribute(tag, word, context.diagnostics)
