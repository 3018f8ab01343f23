"""Packages, models and worlds: where they are, and what a URI in a robot's files means."""

from __future__ import annotations

from gazelle.workspace.manifest import Export
from gazelle.workspace.package import Package
from gazelle.workspace.resolved import Resolved
from gazelle.workspace.workspace import Workspace

__all__ = ["Export", "Package", "Resolved", "Workspace"]
