"""Finds what would go wrong before anything is started."""

from __future__ import annotations

from gazelle.doctor.report import Report, Section

__all__ = ["Report", "Section"]
