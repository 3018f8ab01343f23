"""The start of a simulation without a process, a graph or a socket."""

from __future__ import annotations

from gazelle.doctor.dry_start.bringup import dry_start
from gazelle.doctor.dry_start.plan import ControllerStart, DryNode, DryStart, Program, StartPlan

__all__ = ["ControllerStart", "DryNode", "DryStart", "Program", "StartPlan", "dry_start"]
