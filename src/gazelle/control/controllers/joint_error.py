"""Limits and angle errors of the joints that a position is commanded of."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.control.angles import shortest_angular_distance
from gazelle.control.controllers.controller import ControllerContext
from gazelle.description.model import JointType

__all__ = ["JointRange"]

_TURN = 2.0 * math.pi


@dataclass(frozen=True, slots=True)
class JointRange:
    """Where a joint may be commanded to go.

    Attributes:
        type: revolute joints have limits and turn the shorter way that keeps within them,
            continuous ones turn the shorter way, the others just go.
        lower, upper: limits of revolute and prismatic joints.
    """

    type: JointType
    lower: float = -math.inf
    upper: float = math.inf

    @classmethod
    def of(cls, context: ControllerContext, name: str) -> JointRange:
        """Return the range that the robot's description gives a joint.

        Raises:
            ControllerError: the hardware has no such joint.
        """
        resource = context.joint(name)
        for joint in context.robot.model.joints:
            if joint.name == name:
                if joint.axis is None or joint.type is JointType.CONTINUOUS:
                    return cls(joint.type)
                return cls(joint.type, joint.axis.lower, joint.axis.upper)
        if resource.is_continuous:
            return cls(JointType.CONTINUOUS)
        limits = resource.limits
        if not limits.has_position_limits:
            return cls(JointType.PRISMATIC)
        return cls(JointType.REVOLUTE, limits.lower, limits.upper)

    def clip(self, command: float) -> float:
        """Return the command within the limits."""
        return min(max(command, self.lower), self.upper)

    def error(self, position: float, command: float) -> float:
        """Return the way to the command (rad or m).

        A revolute joint takes the shorter way round if it ends within the limits, else the longer
        one, else the shorter one all the same
        (``angles::shortest_angular_distance_with_large_limits``).
        """
        if self.type is JointType.REVOLUTE:
            short = shortest_angular_distance(position, command)
            if self.lower <= position + short <= self.upper:
                return short
            long = short - math.copysign(_TURN, short)
            return long if self.lower <= position + long <= self.upper else short
        if self.type is JointType.CONTINUOUS:
            return shortest_angular_distance(position, command)
        return command - position
