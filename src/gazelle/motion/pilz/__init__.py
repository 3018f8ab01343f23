"""The Pilz industrial motion planner: point to point, lines, circles and blended sequences."""

from __future__ import annotations

from gazelle.motion.pilz.command import (
    Auxiliary,
    AuxiliaryKind,
    Command,
    CommandKind,
)
from gazelle.motion.pilz.planner import Kinematics, PilzPlanner
from gazelle.motion.pilz.sequence import plan_sequence

__all__ = [
    "Auxiliary",
    "AuxiliaryKind",
    "Command",
    "CommandKind",
    "Kinematics",
    "PilzPlanner",
    "plan_sequence",
]
