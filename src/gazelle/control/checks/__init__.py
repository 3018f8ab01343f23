"""Checks of controllers before the first step: names, limits, gains."""

from __future__ import annotations

from gazelle.control.checks.all_checks import LoopDynamics, check_control
from gazelle.control.checks.configured_controllers import (
    ConfiguredController,
    MoveItController,
    configured_controllers,
    moveit_controllers,
)
from gazelle.control.checks.gain_stability import (
    joint_inertias,
    largest_stable_factor,
    spectral_radius,
)
from gazelle.control.checks.joint_names import Disagreement, disagreements, table_text

__all__ = [
    "ConfiguredController",
    "Disagreement",
    "LoopDynamics",
    "MoveItController",
    "check_control",
    "configured_controllers",
    "disagreements",
    "joint_inertias",
    "largest_stable_factor",
    "moveit_controllers",
    "spectral_radius",
    "table_text",
]
