"""Transmissions from their tags in a robot description."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from gazelle.control.transmissions.transmission import (
    Transmission,
    differential_transmission,
    four_bar_linkage_transmission,
    simple_transmission,
)
from gazelle.description.model import ActuatorTag, TransmissionJoint, TransmissionTag
from gazelle.diagnostics import Diagnostics, did_you_mean

__all__ = ["read_transmission"]

# What the last word of a type means; packages in front of it differ over the years.
_TYPES = {
    "SimpleTransmission": "simple",
    "DifferentialTransmission": "differential",
    "FourBarLinkageTransmission": "four_bar_linkage",
    # The PR2's wrist is a differential, rolled by the sum of both motors.
    "WristTransmission": "differential",
}

_Part = TypeVar("_Part", TransmissionJoint, ActuatorTag)
_Make = Callable[[Sequence[float], Sequence[float], Sequence[float]], Transmission]
_PAIRS: dict[str, _Make] = {
    "differential": differential_transmission,
    "four_bar_linkage": four_bar_linkage_transmission,
}


def _kind(type_name: str) -> str:
    """Return ``simple``, ``differential``, ``four_bar_linkage``, or empty for another type."""
    last = type_name.replace("::", "/").rpartition("/")[2]
    return _TYPES.get(last, "")


def read_transmission(tag: TransmissionTag, diagnostics: Diagnostics) -> Transmission | None:
    """Return the transmission that a tag describes; None (reported) when it makes no sense."""
    kind = _kind(tag.type)
    if not kind:
        text = f"transmission '{tag.name}' is of type '{tag.type}', which is not known; its joints"
        text += " are driven directly"
        hint = did_you_mean(tag.type.rpartition("/")[2], _TYPES)
        diagnostics.report("control.transmission-type", text, tag.span, fix=hint)
        return None
    count = 1 if kind == "simple" else 2
    if len(tag.joints) != count or len(tag.actuators) != count:
        text = f"transmission '{tag.name}' of type '{tag.type}' needs {count} joint(s) and"
        text += f" {count} actuator(s); it has {len(tag.joints)} and {len(tag.actuators)}"
        diagnostics.report("control.transmission-parts", text, tag.span)
        return None
    joints, actuators = _by_role(tag.joints, "joint"), _by_role(tag.actuators, "actuator")
    if count == 2 and (joints is None or actuators is None):
        text = f"transmission '{tag.name}' needs the roles joint1, joint2, actuator1, actuator2,"
        text += " each once; the order of the file counts"
        diagnostics.report("control.transmission-roles", text, tag.span)
    return _make(tag, kind, joints or tag.joints, actuators or tag.actuators, diagnostics)


def _make(
    tag: TransmissionTag,
    kind: str,
    joints: Sequence[TransmissionJoint],
    actuators: Sequence[ActuatorTag],
    diagnostics: Diagnostics,
) -> Transmission | None:
    motors = [actuator.mechanical_reduction for actuator in actuators]
    gears = [joint.mechanical_reduction for joint in joints]
    offsets = [joint.offset for joint in joints]
    try:
        if kind == "simple":
            return simple_transmission(motors[0], offsets[0])
        return _PAIRS[kind](motors, gears, offsets)
    except ValueError as error:
        text = f"transmission '{tag.name}': {error} (Transmission reduction ratios cannot be zero.)"
        diagnostics.report("control.transmission-reduction", text, tag.span)
        return None


def _by_role(parts: Sequence[_Part], word: str) -> tuple[_Part, ...] | None:
    roles = {part.role: part for part in parts}
    wanted = [f"{word}{number}" for number in range(1, len(parts) + 1)]
    return tuple(roles[role] for role in wanted) if set(roles) == set(wanted) else None
