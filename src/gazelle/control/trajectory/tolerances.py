"""How far joints may be from their trajectory (control_msgs/JointTolerance)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array, Indices
from gazelle.interfaces.stamps import seconds_of

__all__ = ["ToleranceError", "Tolerances", "goal_tolerances", "violated"]

_EPSILON = float(np.finfo(np.float32).eps)
_FIELDS = ("position", "velocity", "acceleration")


class ToleranceError(ValueError):
    """A goal's tolerances cannot be used; the message says why."""


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Tolerances of some joints; infinity where none is enforced.

    Attributes:
        path: (3, N), of position, velocity and acceleration while a trajectory runs.
        goal: (3, N), at its end.
        goal_time_s: how much later than planned the goal may be reached.
        has_path: whether any of `path` is finite.
    """

    path: Array
    goal: Array
    goal_time_s: float
    has_path: bool = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "has_path", bool(np.isfinite(self.path).any()))

    @classmethod
    def of(
        cls,
        path_position: Sequence[float],
        goal_position: Sequence[float],
        stopped_velocity: float,
        goal_time_s: float,
    ) -> Tolerances:
        """Return those of a controller's ``constraints``; 0 and less mean that none is enforced."""
        n = len(path_position)
        path, goal = np.full((3, n), math.inf), np.full((3, n), math.inf)
        path[0] = [_enforced(value) for value in path_position]
        goal[0] = [_enforced(value) for value in goal_position]
        goal[1] = _enforced(stopped_velocity)
        return cls(path, goal, goal_time_s)

    @classmethod
    def none(cls, n_joints: int) -> Tolerances:
        """Return tolerances that enforce nothing."""
        return cls.of([0.0] * n_joints, [0.0] * n_joints, 0.0, 0.0)

    def of_joints(self, indices: Indices) -> Tolerances:
        """Return those of m of the joints, given by index (m,)."""
        return Tolerances(self.path[:, indices], self.goal[:, indices], self.goal_time_s)


def violated(error: Array, limits: Array) -> NDArray[np.bool_]:
    """Return which joints (N,) exceed their tolerances; both are (3, N), NaN exceeds nothing."""
    exceeded: NDArray[np.bool_] = np.logical_or.reduce(np.abs(error) > limits)
    return exceeded


def goal_tolerances(
    defaults: Tolerances, goal: Any, joints: Sequence[str], *, strict: bool
) -> Tolerances:
    """Return a controller's tolerances with those of a goal over them.

    Positive values replace the default, 0 leaves it, a negative one takes it away.

    Args:
        defaults: the controller's.
        goal: control_msgs/FollowJointTrajectory goal.
        joints: the controller's.
        strict: ROS 2's rules: unknown joints and negative values other than -1 are errors; ROS 1
            takes any negative value for -1 and skips unknown joints.

    Raises:
        ToleranceError: by ROS 2's rules they are wrong; then the defaults are to be used.
    """
    path, end = defaults.path.copy(), defaults.goal.copy()
    seconds = seconds_of(goal.goal_time_tolerance)
    goal_time_s = _resolved(seconds, "goal_time_tolerance", strict)
    for rows, table, title in (
        (goal.path_tolerance, path, "path_tolerance"),
        (goal.goal_tolerance, end, "goal_tolerance"),
    ):
        for row in rows:
            if row.name in joints:
                _take(row, table[:, list(joints).index(row.name)], title, strict)
            elif strict:
                text = f"joint '{row.name}' specified in goal.{title} does not exist"
                raise ToleranceError(f"{text}. Using default tolerances")
    if goal_time_s is None:
        goal_time_s = defaults.goal_time_s
    return Tolerances(path, end, 0.0 if math.isinf(goal_time_s) else goal_time_s)


def _take(row: Any, column: Array, title: str, strict: bool) -> None:
    for index, name in enumerate(_FIELDS):
        value = _resolved(getattr(row, name), f"{title} ({name} of joint '{row.name}')", strict)
        if value is not None:
            column[index] = value


def _resolved(value: float, title: str, strict: bool) -> float | None:
    """Return None for "as before", infinity for "not at all"."""
    if value > 0.0:
        return value
    if value == 0.0:
        return None
    if strict and abs(value + 1.0) >= _EPSILON:
        raise ToleranceError(f"illegal value {value:g} in goal.{title}. Using default tolerances")
    return math.inf


def _enforced(value: float) -> float:
    return value if value > 0.0 else math.inf
