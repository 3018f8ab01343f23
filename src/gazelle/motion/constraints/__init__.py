"""Constraints of a motion, with the meaning that ``moveit_msgs/Constraints`` gives them."""

from __future__ import annotations

from gazelle.motion.constraints.kinematic_constraints import (
    ForwardKinematics,
    JointConstraint,
    OrientationConstraint,
    Parameterization,
    PathConstraint,
    PositionConstraint,
    Region,
)
from gazelle.motion.constraints.path_constraints import Constrained, narrowed, projection

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
