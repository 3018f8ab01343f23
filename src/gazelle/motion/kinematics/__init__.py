"""Forward and inverse kinematics; importing this loads compiled kernels."""

from __future__ import annotations

from gazelle.motion.kinematics.poses import link_poses
from gazelle.motion.kinematics.solver import Solver

__all__ = ["Solver", "link_poses"]
