"""``gazelle doctor``: finds what would go wrong before anything is started."""

from __future__ import annotations

from gazelle.cli.doctor.command import main

__all__ = ["main"]
