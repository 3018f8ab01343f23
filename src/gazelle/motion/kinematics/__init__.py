"""Forward and inverse kinematics; importing this loads compiled kernels."""

from __future__ import annotations

from gazelle.motion.kinematics.kernel_warm_up import warm_up
from gazelle.motion.kinematics.solver import Patience, Solver, link_poses

__all__ = ["Patience", "Solver", "link_poses", "warm_up"]
