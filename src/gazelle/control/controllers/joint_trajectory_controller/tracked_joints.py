"""The joints of a trajectory controller, what they are like and how closely they must follow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.trajectory.tolerances import Tolerances
from gazelle.control.trajectory.waypoints import wrap_in_place
from gazelle.description.model import JointType

__all__ = ["TrackedJoints", "joint_names", "read_tolerances"]

_MIN_FAR = math.pi * math.pi


@dataclass(frozen=True, slots=True)
class TrackedJoints:
    """Joints by place, as a controller's ``joints`` gives them.

    Attributes:
        names: of the joints.
        wraps: (N,) which ones take the shorter way to a new trajectory.
        is_angle: (N,) which ones have errors that are never more than half a turn.
    """

    names: tuple[str, ...]
    wraps: NDArray[np.bool_]
    is_angle: NDArray[np.bool_]

    @classmethod
    def of_ros1(cls, context: ControllerContext) -> TrackedJoints:
        """Return a ROS 1 controller's joints: errors of all that turn are ways between angles."""
        names = joint_names(context)
        turns = [_type(context, name) is not JointType.PRISMATIC for name in names]
        return cls(names, _continuous(context, names), np.array(turns))

    @classmethod
    def of_ros2(cls, context: ControllerContext) -> TrackedJoints:
        """Return a ROS 2 controller's joints: continuous ones and those told so wrap."""
        names = joint_names(context)
        wraps = _continuous(context, names)
        for index, name in enumerate(names):
            for word in ("angle_wraparound", "normalize_error"):
                wraps[index] |= context.parameters.flag(f"gains.{name}.{word}")
        return cls(names, wraps, wraps)

    def error(self, desired: Array, actual: Array, out: Array) -> None:
        """Put desired - actual (K, N) into `out`, positions of angles the shorter way."""
        np.subtract(desired, actual, out=out)
        way = out[0]
        # One product tells that no difference can exceed half a turn.
        if np.dot(way, way) > _MIN_FAR:
            wrap_in_place(way, self.is_angle)


def joint_names(context: ControllerContext, key: str = "joints") -> tuple[str, ...]:
    """Return a list of joints that the hardware has.

    Raises:
        ControllerError: the list is missing or empty, a name is there twice or unknown.
    """
    context.parameters.require(key)
    names = context.parameters.texts(key)
    where = context.parameters.full_name(key)
    if not names:
        raise ControllerError(f"controller '{context.name}': '{where}' is empty")
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        text = f"controller '{context.name}': joint '{twice}' is twice in '{where}'"
        raise ControllerError(text)
    for name in names:
        context.joint(name)
    return names


def read_tolerances(context: ControllerContext, names: Sequence[str]) -> Tolerances:
    """Return the ``constraints``: 0.01 for the velocity at rest, nothing else by default."""
    number = context.parameters.number
    return Tolerances.of(
        [number(f"constraints.{name}.trajectory") for name in names],
        [number(f"constraints.{name}.goal") for name in names],
        number("constraints.stopped_velocity_tolerance"),
        max(number("constraints.goal_time"), 0.0),
    )


def _continuous(context: ControllerContext, names: Sequence[str]) -> NDArray[np.bool_]:
    return np.array([context.joint(name).is_continuous for name in names])


def _type(context: ControllerContext, name: str) -> JointType:
    joint = context.robot.model.joint(name)
    return JointType.REVOLUTE if joint is None else joint.type
