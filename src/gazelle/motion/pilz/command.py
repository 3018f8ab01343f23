"""What is asked of the Pilz industrial motion planner."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError

__all__ = ["Auxiliary", "AuxiliaryKind", "Command", "CommandKind"]

_MIN_SCALING = 1e-4


class CommandKind(enum.StrEnum):
    """Planner ids of the pipeline."""

    PTP = "PTP"
    LIN = "LIN"
    CIRC = "CIRC"


class AuxiliaryKind(enum.StrEnum):
    """Names of the path constraint of a CIRC request."""

    CENTER = "center"
    INTERIM = "interim"


@dataclass(frozen=True, eq=False)
class Auxiliary:
    """The point that fixes a circle.

    Attributes:
        kind: whether it is the circle's center or a point passed on the way.
        point_m: shape (3,), in the planning frame.
    """

    kind: AuxiliaryKind
    point_m: FloatArray


@dataclass(frozen=True, eq=False)
class Command:
    """One motion.

    Attributes:
        kind: how the tip moves.
        goal: positions of the joints, shape (n,), or a pose of the link, shape (4, 4).
        auxiliary: for CIRC.
        velocity_scaling: above 0, up to 1.
        acceleration_scaling: above 0, up to 1.
        blend_radius_m: in a sequence, how early the next motion may begin.
    """

    kind: CommandKind
    goal: FloatArray
    auxiliary: Auxiliary | None = None
    velocity_scaling: float = 1.0
    acceleration_scaling: float = 1.0
    blend_radius_m: float = 0.0

    def check(self) -> None:
        """Refuse what Pilz refuses of every request.

        Raises:
            PlanningError: INVALID_MOTION_PLAN or INVALID_GOAL_CONSTRAINTS.
        """
        factors = ("Velocity", self.velocity_scaling), ("Acceleration", self.acceleration_scaling)
        for name, value in factors:
            if not _MIN_SCALING <= value <= 1.0:
                text = f"{name} scaling not in range [{_MIN_SCALING:g}, 1], actual value is: "
                raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, f"{text}{value:g}")
        if not np.isfinite(self.goal).all():
            reason = f"the goal of {self.kind} has numbers that are not finite"
            raise PlanningError(ErrorCode.INVALID_GOAL_CONSTRAINTS, reason)
        if self.auxiliary is not None and not np.isfinite(self.auxiliary.point_m).all():
            reason = f"the {self.auxiliary.kind} point has numbers that are not finite"
            raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)
        if self.kind is CommandKind.CIRC and self.auxiliary is None:
            reason = 'CIRC needs a path constraint named "interim" or "center" with one position'
            raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)
