"""``gazelle studio``: the browser page on a running graph."""

from __future__ import annotations

from gazelle.cli.studio.command import main

__all__ = ["main"]
