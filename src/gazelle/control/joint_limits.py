"""Limits of joints from description and parameters, as joint_limits_interface reads them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from gazelle.control.robot import JointLimits
from gazelle.description.model import Joint, JointAxis, JointType

__all__ = ["limits_from_parameters", "limits_of"]

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
    words = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
    values = [_number(tree.get(word)) for word in words]
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
