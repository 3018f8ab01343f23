"""The start of a simulation without a process, a graph or a socket."""

from __future__ import annotations

from gazelle.doctor.dry_start.node import DryNode
from gazelle.doctor.dry_start.records import ControllerStart, DryStart, Program, StartPlan
from gazelle.doctor.dry_start.start import dry_start

__all__ = ["ControllerStart", "DryNode", "DryStart", "Program", "StartPlan", "dry_start"]
