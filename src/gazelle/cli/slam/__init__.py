"""``gazelle slam FILE``: a map and a trajectory of a log."""

from __future__ import annotations

from gazelle.cli.slam.command import main

__all__ = ["main"]
