"""``gazelle view``: a picture of a robot, a model or a world, without a display."""

from __future__ import annotations

from gazelle.cli.view.command import main

__all__ = ["main"]
