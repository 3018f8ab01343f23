"""``gazelle convert SOURCE -o TARGET``: robots and worlds in other formats."""

from __future__ import annotations

from gazelle.cli.convert.command import main

__all__ = ["main"]
