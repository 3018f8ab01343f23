"""Forward and inverse kinematics; importing this loads compiled kernels."""

from __future__ import annotations

from gazelle.motion.kinematics.poses import link_poses
from gazelle.motion.kinematics.solver import Patience, Solver
from gazelle.motion.kinematics.warm_up import warm_up

__all__ = ["Patience", "Solver", "link_poses", "warm_up"]
