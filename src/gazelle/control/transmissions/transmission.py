"""What a transmission does to positions, velocities and efforts.

All three kinds of ros_control are linear: ``v_actuator = G v_joint`` with a constant matrix G of
reductions. An ideal transmission loses no power, τ_a · v_a = τ_j · v_j for every velocity, hence
``τ_joint = Gᵀ τ_actuator``. Positions map as velocities do, about the joints' offsets.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from gazelle.control.interface_values import Array
from gazelle.description.model import ActuatorTag, TransmissionJoint, TransmissionTag
from gazelle.diagnostics import Diagnostics, did_you_mean

__all__ = [
    "Transmission",
    "differential_transmission",
    "four_bar_linkage_transmission",
    "read_transmission",
    "simple_transmission",
]


@dataclass(frozen=True, slots=True, eq=False)
class Transmission:
    """A transmission of as many actuators as joints.

    Attributes:
        ratios: G (N, N): actuator velocities from joint velocities.
        offsets: joint positions (N,) at which the actuators read 0, rad or m.
    """

    ratios: Array
    offsets: Array

    def joint_positions(self, actuators: Array) -> Array:
        """Return joint positions (N,) from actuator positions."""
        return self.joint_velocities(actuators) + self.offsets

    def joint_velocities(self, actuators: Array) -> Array:
        """Return joint velocities (N,) from actuator velocities."""
        result: Array = np.linalg.solve(self.ratios, actuators).astype(np.float64)
        return result

    def joint_efforts(self, actuators: Array) -> Array:
        """Return joint efforts (N,) from actuator efforts."""
        result: Array = self.ratios.T @ actuators
        return result

    def actuator_positions(self, joints: Array) -> Array:
        """Return actuator positions (N,) from joint positions."""
        result: Array = self.ratios @ (joints - self.offsets)
        return result

    def actuator_velocities(self, joints: Array) -> Array:
        """Return actuator velocities (N,) from joint velocities."""
        result: Array = self.ratios @ joints
        return result

    def actuator_efforts(self, joints: Array) -> Array:
        """Return actuator efforts (N,) from joint efforts."""
        result: Array = np.linalg.solve(self.ratios.T, joints).astype(np.float64)
        return result


def simple_transmission(reduction: float, offset: float = 0.0) -> Transmission:
    """Return a reducer: one actuator turns `reduction` times as fast as its joint.

    Raises:
        ValueError: the reduction is 0.
    """
    _check(reduction)
    return Transmission(np.array([[reduction]], dtype=np.float64), np.array([offset], dtype=float))


def differential_transmission(
    actuator_reductions: Sequence[float],
    joint_reductions: Sequence[float] = (1.0, 1.0),
    offsets: Sequence[float] = (0.0, 0.0),
) -> Transmission:
    """Return a differential: the actuators' sum moves joint 1, their difference joint 2.

    ``v_a1 = n_a1 (n_j1 v_j1 + n_j2 v_j2)``, ``v_a2 = n_a2 (n_j1 v_j1 - n_j2 v_j2)``
    (transmission_interface, ``differential_transmission.h``).

    Raises:
        ValueError: a reduction is 0.
    """
    _check(*actuator_reductions, *joint_reductions)
    (a1, a2), (j1, j2) = actuator_reductions, joint_reductions
    ratios = np.array([[a1 * j1, a1 * j2], [a2 * j1, -a2 * j2]])
    return Transmission(ratios, np.array(offsets, dtype=np.float64))


def four_bar_linkage_transmission(
    actuator_reductions: Sequence[float],
    joint_reductions: Sequence[float] = (1.0, 1.0),
    offsets: Sequence[float] = (0.0, 0.0),
) -> Transmission:
    """Return a four-bar linkage: actuator 2 moves joint 2 relative to joint 1's link.

    ``v_a1 = n_a1 n_j1 v_j1``, ``v_a2 = n_a2 (v_j1 + n_j2 v_j2)`` (transmission_interface,
    ``four_bar_linkage_transmission.h``). The efforts there do not fit these velocities: power
    would come from nowhere. Here they follow from them.

    Raises:
        ValueError: a reduction is 0.
    """
    _check(*actuator_reductions, *joint_reductions)
    (a1, a2), (j1, j2) = actuator_reductions, joint_reductions
    ratios = np.array([[a1 * j1, 0.0], [a2, a2 * j2]])
    return Transmission(ratios, np.array(offsets, dtype=np.float64))


def _check(*reductions: float) -> None:
    if 0.0 in reductions:
        raise ValueError("a reduction of 0 transmits nothing")


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
        diagnostics.report("control.transmission-type", text, tag.type_span, fix=hint)
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
