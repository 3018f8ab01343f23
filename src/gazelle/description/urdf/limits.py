"""``<limit>``: range, effort and velocity, and the values that hurt later."""

from __future__ import annotations

import math
from typing import NamedTuple

from gazelle.description.context import ReadContext
from gazelle.description.model import JointType
from gazelle.description.urdf.attributes import check_vocabulary, number_attribute
from gazelle.description.xml import Tag

__all__ = ["Limits", "read_limits"]

_RANGED = (JointType.REVOLUTE, JointType.PRISMATIC)


class Limits(NamedTuple):
    """Limits in rad or m, N·m or N, rad/s or m/s; infinite where there is none."""

    lower: float = -math.inf
    upper: float = math.inf
    effort: float = math.inf
    velocity: float = math.inf


def read_limits(joint: Tag, name: str, kind: JointType, context: ReadContext) -> Limits:
    """Return a joint's limits; what is missing is reported as check_urdf does.

    Negative effort and velocity mean no limit, as in Gazebo.

    Args:
        joint: the ``<joint>``.
        name: its name.
        kind: its type; only revolute and prismatic joints have a range.
        context: where to report.
    """
    tag = joint.find("limit")
    if tag is None:
        if kind in _RANGED:
            message = f"joint '{name}' is {kind.value} but it does not specify limits"
            context.diagnostics.report("urdf.limit-missing", message, joint.span)
        return Limits()
    known = ("lower", "upper", "effort", "velocity")
    check_vocabulary(tag, context.diagnostics, attributes=known)
    missing = [word for word in ("effort", "velocity") if word not in tag.attributes]
    if missing:
        message = f"<limit> of joint '{name}' lacks {' and '.join(missing)}"
        context.diagnostics.report("urdf.limit-incomplete", message, tag.span)
    effort = _bound(tag, "effort", context)
    velocity = _bound(tag, "velocity", context)
    if kind is not JointType.FIXED:
        _report_zero(tag, name, effort, velocity, context)
    if kind not in _RANGED:
        _read_range(tag, context)
        return Limits(effort=effort, velocity=velocity)
    lower, upper = _ordered(tag, name, context)
    return Limits(lower, upper, effort, velocity)


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
        context.diagnostics.report("urdf.limit-order", message, tag.span)
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
