"""Joints of a robot as motion sees them: variables with limits, between two links."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["JointKind", "MimicRule", "RobotJoint", "VariableLimit"]

_INFINITE = float("inf")


class JointKind(Enum):
    """How a joint moves; fixed, planar and floating are the words of virtual joints as well."""

    FIXED = "fixed"
    TURNING = "turning"
    SLIDING = "sliding"
    PLANAR = "planar"
    FLOATING = "floating"


@dataclass(frozen=True, slots=True)
class MimicRule:
    """``position = multiplier · position(joint) + offset``."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True, slots=True)
class VariableLimit:
    """Limits of one variable: rad or m, and per s, s² and s³; infinite where there is none.

    Attributes:
        continuous: an angle without limits, equal every 2 pi.
    """

    lower: float = -_INFINITE
    upper: float = _INFINITE
    continuous: bool = False
    velocity: float = _INFINITE
    acceleration: float = _INFINITE
    jerk: float = _INFINITE


@dataclass(frozen=True, slots=True)
class RobotJoint:
    """A joint and the link it carries.

    ``T_parent_child = T_parent_joint · motion(variables) · T_joint_child``.

    Attributes:
        name: of the joint.
        kind: how it moves.
        parent: name of the link above; empty for the joint that holds the root.
        child: name of the link it carries.
        axis: unit vector in the joint's frame, of turning and sliding joints.
        variables: names of its variables: its own name, or ``name/x``, ``name/y``, ``name/theta``
            of planar and ``name/trans_x`` … ``name/rot_w`` of floating joints, as in MoveIt.
        first: place of its first variable in a robot's positions.
        limits: of each variable.
        mimic: what it follows, or None.
        is_passive: nothing drives it.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    T_parent_joint: Pose = IDENTITY_POSE
    T_joint_child: Pose = IDENTITY_POSE
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    variables: tuple[str, ...] = ()
    first: int = 0
    limits: tuple[VariableLimit, ...] = ()
    mimic: MimicRule | None = None
    is_passive: bool = False

    @property
    def is_active(self) -> bool:
        """Whether it has variables of its own."""
        return bool(self.variables) and self.mimic is None
