"""Precompiled headers: which source of a package begins with which."""

from __future__ import annotations

from pathlib import Path

from gazelle.cpp.build_settings import Unit

__all__ = ["precompiled_table"]


def precompiled_table(unit: Unit) -> Path | None:
    """Return the table of a package's sources and the headers they begin with, None for none."""
    return None
