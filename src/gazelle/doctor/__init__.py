"""Finds what would go wrong before anything is started."""

from __future__ import annotations

from gazelle.doctor.command_line import examine
from gazelle.doctor.report import Options, Report, Section

__all__ = ["Options", "Report", "Section", "examine"]
