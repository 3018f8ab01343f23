"""Limits of joints from description and parameters, as joint_limits_interface reads them.

Each class takes all joints of one command interface at once. Formulas: ros_control,
``joint_limits_interface.h`` (noetic). A bound that a joint does not have is infinite, which leaves
every formula as it is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from gazelle.control.interface_values import Array
from gazelle.control.resource_manager import JointLimits
from gazelle.description.model import Joint, JointAxis, JointType

__all__ = [
    "EffortLimits",
    "PositionLimits",
    "VelocityLimits",
    "limits_from_parameters",
    "limits_of",
]


class _Bounds:
    """Columns of the limits of some joints."""

    def __init__(self, limits: Sequence[JointLimits]) -> None:
        has = [item.has_position_limits for item in limits]
        self.lower = _column(limits, "lower", -math.inf, has)
        self.upper = _column(limits, "upper", math.inf, has)
        self.velocity = _column(limits, "max_velocity", math.inf)
        self.acceleration = _column(limits, "max_acceleration", math.inf)
        self.effort = _column(limits, "max_effort", math.inf)
        soft = [item.has_soft_limits for item in limits]
        self.soft = np.array(soft, dtype=bool)
        # Without position limits, soft ones do not look at the position.
        zoned = [a and b for a, b in zip(soft, has, strict=True)]
        self.soft_lower = _column(limits, "soft_lower", 0.0, zoned)
        self.soft_upper = _column(limits, "soft_upper", 0.0, zoned)
        self.k_position = _column(limits, "k_position", 0.0, zoned)
        self.k_velocity = _column(limits, "k_velocity", 0.0, soft)
        self.zoned = np.array(zoned, dtype=bool)

    def velocity_bounds(self, position: Array) -> tuple[Array, Array]:
        """Return how fast joints may move: the nearer to a soft limit, the slower."""
        low, high = -self.velocity, self.velocity
        if not self.zoned.any():
            return low, high
        soft_low = _saturate(-self.k_position * (position - self.soft_lower), low, high)
        soft_high = _saturate(-self.k_position * (position - self.soft_upper), low, high)
        return np.where(self.zoned, soft_low, low), np.where(self.zoned, soft_high, high)


class PositionLimits:
    """Position commands within the limits, and no faster than the velocity limit.

    The bound moves from the last command on, not from where the joint is.
    """

    def __init__(self, limits: Sequence[JointLimits]) -> None:
        self._bounds = _Bounds(limits)
        self._last: Array = np.full(len(limits), math.nan)

    def enforce(self, command: Array, position: Array, velocity: Array, period_s: float) -> Array:
        """Return the positions (N,), rad or m, that are allowed; NaN stays NaN.

        Args:
            command: positions (N,), rad or m.
            position: measured (N,).
            velocity: measured (N,), rad/s or m/s.
            period_s: since the last call.
        """
        bounds = self._bounds
        last = np.where(np.isnan(self._last), position, self._last)
        slow, fast = bounds.velocity_bounds(last)
        low = np.maximum(last + slow * period_s, bounds.lower)
        high = np.minimum(last + fast * period_s, bounds.upper)
        allowed = _saturate(command, low, high)
        self._last = np.where(np.isnan(allowed), self._last, allowed)
        return allowed

    def reset(self) -> None:
        """Start again from where the joints are."""
        self._last.fill(math.nan)


class VelocityLimits:
    """Velocity commands within the velocity and acceleration limits."""

    def __init__(self, limits: Sequence[JointLimits]) -> None:
        self._bounds = _Bounds(limits)
        self._last: Array = np.zeros(len(limits))

    def enforce(self, command: Array, position: Array, velocity: Array, period_s: float) -> Array:
        """Return the velocities (N,), rad/s or m/s, that are allowed; NaN stays NaN.

        Args:
            command: velocities (N,), rad/s or m/s.
            position: measured (N,), rad or m.
            velocity: measured (N,).
            period_s: since the last call.
        """
        bounds = self._bounds
        low, high = bounds.velocity_bounds(position)
        # Soft limits count the acceleration from the measured speed, hard ones from the command.
        start = np.where(bounds.soft, velocity, self._last)
        change = bounds.acceleration * period_s
        allowed = _saturate(
            command, np.maximum(start - change, low), np.minimum(start + change, high)
        )
        self._last = np.where(np.isnan(allowed), self._last, allowed)
        return allowed

    def reset(self) -> None:
        """Start again from rest."""
        self._last.fill(0.0)


class EffortLimits:
    """Efforts within the effort limit, and none that pushes beyond position or velocity limits.

    Without soft limits the effort towards a limit that is passed is cut to 0; with them it fades
    out: ``-k_velocity (velocity - bound)``.
    """

    def __init__(self, limits: Sequence[JointLimits]) -> None:
        self._bounds = _Bounds(limits)
        self._any_soft = bool(self._bounds.soft.any())

    def enforce(self, command: Array, position: Array, velocity: Array, period_s: float) -> Array:
        """Return the efforts (N,), N·m or N, that are allowed; NaN stays NaN.

        Args:
            command: efforts (N,), N·m or N.
            position: measured (N,), rad or m.
            velocity: measured (N,), rad/s or m/s.
            period_s: since the last call.
        """
        low, high = self.bounds(position, velocity)
        return _saturate(command, low, high)

    def bounds(self, position: Array, velocity: Array) -> tuple[Array, Array]:
        """Return the smallest and largest efforts, (N,) each, N·m or N, that are allowed.

        Args:
            position: measured (N,), rad or m.
            velocity: measured (N,), rad/s or m/s.
        """
        bounds = self._bounds
        too_low = (position < bounds.lower) | (velocity < -bounds.velocity)
        too_high = (position > bounds.upper) | (velocity > bounds.velocity)
        low = np.where(too_low, 0.0, -bounds.effort)
        high = np.where(too_high, 0.0, bounds.effort)
        if self._any_soft:
            low, high = self._soft(position, velocity, low, high)
        return low, high

    def reset(self) -> None:
        """Do nothing: these limits remember nothing."""

    def _soft(
        self, position: Array, velocity: Array, low: Array, high: Array
    ) -> tuple[Array, Array]:
        bounds = self._bounds
        slow, fast = bounds.velocity_bounds(position)
        with np.errstate(invalid="ignore"):
            # Without a velocity limit there is no bound to keep away from.
            soft_low = -bounds.k_velocity * (velocity - slow)
            soft_high = -bounds.k_velocity * (velocity - fast)
        soft_low = _saturate(np.nan_to_num(soft_low, nan=-math.inf), -bounds.effort, bounds.effort)
        soft_high = _saturate(np.nan_to_num(soft_high, nan=math.inf), -bounds.effort, bounds.effort)
        return np.where(bounds.soft, soft_low, low), np.where(bounds.soft, soft_high, high)


def _saturate(value: Array, low: Array, high: Array) -> Array:
    # In this order the upper bound wins where the two cross, as in the original.
    saturated: Array = np.minimum(np.maximum(value, low), high)
    return saturated


def _column(
    limits: Sequence[JointLimits], name: str, missing: float, counts: Sequence[bool] | None = None
) -> Array:
    values = [getattr(item, name) for item in limits]
    if counts is not None:
        values = [value if there else None for value, there in zip(values, counts, strict=True)]
    return np.array([missing if value is None else value for value in values], dtype=np.float64)


_WITH_POSITIONS = (JointType.REVOLUTE, JointType.PRISMATIC)


def limits_of(joint: Joint) -> JointLimits:
    """Return the limits that a description gives: ``<limit>`` and ``<safety_controller>``.

    Only revolute and prismatic joints have position limits (``joint_limits_urdf.h``).
    """
    axis = joint.axis or JointAxis()
    has_positions = joint.type in _WITH_POSITIONS and (
        math.isfinite(axis.lower) or math.isfinite(axis.upper)
    )
    safety = joint.safety
    limits = JointLimits(
        has_position_limits=has_positions,
        lower=axis.lower if has_positions else 0.0,
        upper=axis.upper if has_positions else 0.0,
        max_velocity=_finite(axis.velocity),
        max_effort=_finite(axis.effort),
    )
    if safety is None:
        return limits
    return replace(
        limits,
        has_soft_limits=True,
        soft_lower=safety.soft_lower_limit,
        soft_upper=safety.soft_upper_limit,
        k_position=safety.k_position,
        k_velocity=safety.k_velocity,
    )


def limits_from_parameters(limits: JointLimits, tree: Mapping[str, Any]) -> JointLimits:
    """Return limits with those of ``joint_limits/<joint>`` laid over them.

    ``has_…: false`` takes a limit away; ``has_…: true`` counts only together with its values
    (``joint_limits_rosparam.h``). Soft limits need all four values and ``has_soft_limits``.
    """
    limits = _positions(limits, tree)
    limits = replace(
        limits,
        max_velocity=_bound(limits.max_velocity, tree, "velocity"),
        max_acceleration=_bound(limits.max_acceleration, tree, "acceleration"),
        max_jerk=_bound(limits.max_jerk, tree, "jerk"),
        max_effort=_bound(limits.max_effort, tree, "effort"),
    )
    keys = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
    values = [_number(tree.get(word)) for word in keys]
    if tree.get("has_soft_limits") is not True or None in values:
        return limits
    lower, upper, k_position, k_velocity = (value or 0.0 for value in values)
    return replace(
        limits,
        has_soft_limits=True,
        soft_lower=lower,
        soft_upper=upper,
        k_position=k_position,
        k_velocity=k_velocity,
    )


def _positions(limits: JointLimits, tree: Mapping[str, Any]) -> JointLimits:
    wanted = tree.get("has_position_limits")
    lower, upper = _number(tree.get("min_position")), _number(tree.get("max_position"))
    if wanted is False:
        return replace(limits, has_position_limits=False, lower=0.0, upper=0.0)
    if wanted is True and lower is not None and upper is not None:
        return replace(limits, has_position_limits=True, lower=lower, upper=upper)
    return limits


def _bound(present: float | None, tree: Mapping[str, Any], kind: str) -> float | None:
    wanted, value = tree.get(f"has_{kind}_limits"), _number(tree.get(f"max_{kind}"))
    if wanted is False:
        return None
    return value if wanted is True and value is not None else present


def _number(value: Any) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value)


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
