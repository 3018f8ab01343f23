"""Time parameterisation: when a robot is where along a path."""

from __future__ import annotations

from gazelle.motion.timing.time_parameterization import (
    Method,
    method_of,
    parameterise,
)
from gazelle.motion.timing.trajectory import Trajectory

__all__ = ["Method", "Trajectory", "method_of", "parameterise"]
