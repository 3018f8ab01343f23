"""``joint_limits.yaml``: limits that take the place of the URDF's."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.moveit.parameter_tables import JOINT_LIMIT, keys_of
from gazelle.diagnostics import SourceSpan

__all__ = ["JointLimit", "read_joint_limits"]

_QUANTITIES = ("velocity", "acceleration", "jerk")


@dataclass(frozen=True, slots=True)
class JointLimit:
    """Limits of a joint, or of one variable of a planar or floating joint; rad, m and seconds.

    A number is None when the file does not change it. ``has_…_limits: false`` switches a limit
    off, the URDF's as well; that is None for velocity, acceleration and jerk with the flag False.

    Attributes:
        has_velocity: False when there is no velocity limit, None when the URDF's stays.
        has_acceleration: the same of acceleration; the URDF has none.
        has_jerk: the same of jerk.
        max_deceleration: below zero; Pilz' planner brakes PTP with it, nothing else knows it.
    """

    min_position: float | None = None
    max_position: float | None = None
    has_velocity: bool | None = None
    max_velocity: float | None = None
    has_acceleration: bool | None = None
    max_acceleration: float | None = None
    has_jerk: bool | None = None
    max_jerk: float | None = None
    max_deceleration: float | None = None
    span: SourceSpan | None = None


def read_joint_limits(branch: Settings, variables: Collection[str]) -> dict[str, JointLimit]:
    """Read the ``joint_limits`` branch.

    As in MoveIt, ``max_velocity`` counts only beside ``has_velocity_limits: true``, and so on.

    Args:
        branch: the branch.
        variables: names of the robot's joints, and of the variables of those that have several.
    """
    found: dict[str, JointLimit] = {}
    for name, settings in branch.entries():
        if branch.check_name(name, "joint", variables):
            found[name] = _read_limit(settings)
    return found


def _read_limit(settings: Settings) -> JointLimit:
    settings.check_keys(keys_of(JOINT_LIMIT))
    low, high = settings.number("min_position"), settings.number("max_position")
    if low is not None and high is not None and low > high:
        message = f"{settings.name()}: min_position {low:g} is above max_position {high:g}; both"
        message += " are ignored"
        settings.diagnostics.report("moveit.bad-limit", message, settings.span("min_position"))
        low = high = None
    velocity, acceleration, jerk = (_read_maximum(settings, item) for item in _QUANTITIES)
    braking = _read_deceleration(settings)
    return JointLimit(low, high, *velocity, *acceleration, *jerk, braking, settings.span())


def _read_deceleration(settings: Settings) -> float | None:
    flag, value = settings.flag("has_deceleration_limits"), settings.number("max_deceleration")
    if not flag or value is None:
        return None
    if value >= 0:
        message = f"{settings.name('max_deceleration')} is {value:g}, decelerations are below 0; "
        message += "it is ignored, Pilz' planner ends here"
        settings.diagnostics.report("moveit.bad-limit", message, settings.span("max_deceleration"))
        return None
    return value


def _read_maximum(settings: Settings, quantity: str) -> tuple[bool | None, float | None]:
    flag, value = settings.flag(f"has_{quantity}_limits"), settings.number(f"max_{quantity}")
    span = settings.span(f"max_{quantity}")
    if flag and value is None:
        message = (
            f"{settings.name()} has a {quantity} limit and no max_{quantity}; the URDF's stays"
        )
        settings.diagnostics.report("moveit.limit-without-value", message, settings.span())
        return None, None
    if flag and value is not None and value <= 0:
        message = f"{settings.name('max_' + quantity)} is {value:g}, limits are above 0; it is"
        message += " ignored"
        settings.diagnostics.report("moveit.bad-limit", message, span)
        return None, None
    if flag is None and value is not None:
        message = f"{settings.name('max_' + quantity)} has no effect, as in MoveIt, for"
        message += f" has_{quantity}_limits is not true"
        fix = f"add has_{quantity}_limits: true"
        settings.diagnostics.report("moveit.limit-without-flag", message, span, fix=fix)
    return flag, value if flag else None
