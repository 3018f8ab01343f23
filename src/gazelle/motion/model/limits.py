"""Limits of joints: the URDF's, and what joint_limits.yaml changes."""

from __future__ import annotations

import math

from gazelle.description.model import Joint, JointType
from gazelle.description.moveit import JointLimit
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model.joints import VariableLimit

__all__ = ["limit_of_joint", "overridden"]

_INFINITE = math.inf


def limit_of_joint(joint: Joint, diagnostics: Diagnostics) -> VariableLimit:
    """Return the limits that a URDF gives a joint with one variable.

    Soft limits of ``<safety_controller>`` narrow the range, as MoveIt has it.
    """
    axis = joint.axis
    if axis is None:
        return VariableLimit()
    velocity = axis.velocity if axis.velocity > 0 else _INFINITE
    if joint.type is JointType.CONTINUOUS:
        return VariableLimit(continuous=True, velocity=velocity)
    lower, upper = axis.lower, axis.upper
    safety = joint.safety
    if safety is not None:
        soft = max(lower, safety.soft_lower_limit), min(upper, safety.soft_upper_limit)
        if soft[0] < soft[1]:
            lower, upper = soft
        else:
            message = f"the soft limits of joint '{joint.name}' leave it no room"
            message += f" ({safety.soft_lower_limit:g} to {safety.soft_upper_limit:g}); they are"
            message += " ignored, MoveIt would plan no motion of it"
            diagnostics.report("motion.no-room", message, joint.span)
    return VariableLimit(lower, upper, velocity=velocity)


def overridden(
    limit: VariableLimit, change: JointLimit | None, name: str, diagnostics: Diagnostics
) -> VariableLimit:
    """Return limits with the changes of joint_limits.yaml.

    Args:
        limit: the URDF's.
        change: the file's entry for this variable, None when it has none.
        name: of the variable, for messages.
        diagnostics: receives ``motion.no-room`` and ``motion.continuous-limit``.
    """
    if change is None:
        return limit
    lower, upper = limit.lower, limit.upper
    given = change.min_position is not None or change.max_position is not None
    if given and limit.continuous:
        message = f"joint '{name}' turns without end; its position limits of joint_limits.yaml"
        message += " have no effect, as in MoveIt"
        diagnostics.report("motion.continuous-limit", message, change.span)
    elif given:
        lower = limit.lower if change.min_position is None else change.min_position
        upper = limit.upper if change.max_position is None else change.max_position
    if lower > upper:
        message = f"the limits of joint '{name}' in joint_limits.yaml leave it no room together"
        message += f" with the URDF's ({lower:g} to {upper:g}); the URDF's stay"
        diagnostics.report("motion.no-room", message, change.span)
        lower, upper = limit.lower, limit.upper
    return VariableLimit(
        lower,
        upper,
        limit.continuous,
        _value(change.has_velocity, change.max_velocity, limit.velocity),
        _value(change.has_acceleration, change.max_acceleration, limit.acceleration),
        _value(change.has_jerk, change.max_jerk, limit.jerk),
    )


def _value(flag: bool | None, value: float | None, old: float) -> float:
    if flag is None:
        return old
    return value if flag and value is not None else _INFINITE
