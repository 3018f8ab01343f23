"""MuJoCo's own files, MJCF: worlds written as such, and such files read as worlds."""

from __future__ import annotations

from gazelle.engine.mjcf.reader import is_mjcf, read_mjcf
from gazelle.engine.mjcf.writer import to_mjcf

__all__ = ["is_mjcf", "read_mjcf", "to_mjcf"]
