"""Constraints of a motion, with the meaning that ``moveit_msgs/Constraints`` gives them."""

from __future__ import annotations

from gazelle.motion.constraints.kinds import (
    ForwardKinematics,
    JointConstraint,
    OrientationConstraint,
    PathConstraint,
    PositionConstraint,
)
from gazelle.motion.constraints.path import Constrained, narrowed, projection
from gazelle.motion.constraints.region import Region
from gazelle.motion.constraints.rotation import Parameterization

__all__ = [
    "Constrained",
    "ForwardKinematics",
    "JointConstraint",
    "OrientationConstraint",
    "Parameterization",
    "PathConstraint",
    "PositionConstraint",
    "Region",
    "narrowed",
    "projection",
]
