"""The limits that a trajectory keeps to, after MoveIt's scaling factors and defaults."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace

__all__ = ["Limits", "limits_of"]

_DEFAULT_VELOCITY = 1.0
_DEFAULT_ACCELERATION = 1.0
_DEFAULT_JERK = 1000.0
"""MoveIt's defaults of its time parameterisations, in rad or m."""


@dataclass(frozen=True, eq=False)
class Limits:
    """Finite limits of the joints, shape (n,) each, and what was assumed."""

    velocity: FloatArray
    acceleration: FloatArray
    jerk: FloatArray
    notes: tuple[str, ...] = ()


def limits_of(
    space: JointSpace, velocity_scaling: float, acceleration_scaling: float, *, jerk: bool
) -> Limits:
    """Return the limits of a space, scaled.

    Args:
        space: limits of the joints, infinite where unknown.
        velocity_scaling: MoveIt's max_velocity_scaling_factor; 0 counts as 1, as in MoveIt.
        acceleration_scaling: MoveIt's max_acceleration_scaling_factor; 0 counts as 1.
        jerk: whether limits of jerk are asked for.

    Raises:
        ValueError: a limit is not above zero.
    """
    notes: list[str] = []
    velocity = _finite(space, "velocity", space.velocity, _DEFAULT_VELOCITY, notes)
    acceleration = _finite(space, "acceleration", space.acceleration, _DEFAULT_ACCELERATION, notes)
    jerks = np.full(space.size, np.inf)
    if jerk:
        jerks = _finite(space, "jerk", space.jerk, _DEFAULT_JERK, notes)
    return Limits(
        velocity * _factor("velocity", velocity_scaling, notes),
        acceleration * _factor("acceleration", acceleration_scaling, notes),
        jerks,
        tuple(notes),
    )


def _finite(
    space: JointSpace, kind: str, values: FloatArray, default: float, notes: list[str]
) -> FloatArray:
    wrong = [space.names[i] for i in np.flatnonzero(~(values > 0.0))]
    if wrong:
        text = f"the {kind} limit of {_listed(wrong)} is not above zero"
        raise ValueError(f"{text}: such a joint cannot move; correct joint_limits.yaml")
    unknown = [space.names[i] for i in np.flatnonzero(np.isinf(values))]
    if unknown:
        notes.append(
            f"no {kind} limit is known for {_listed(unknown)}; {default:g} is used, as in MoveIt "
            f"(give max_{kind} in joint_limits.yaml)"
        )
    return np.where(np.isinf(values), default, values)


def _factor(kind: str, factor: float, notes: list[str]) -> float:
    if 0.0 < factor <= 1.0:
        return factor
    notes.append(
        f"the max_{kind}_scaling_factor is {factor:g}, which is not within (0, 1]; 1 is used, "
        "as in MoveIt"
    )
    return 1.0


def _listed(names: list[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
