"""The URDF reader."""

from __future__ import annotations

from gazelle.description.urdf_reader.reader import read_urdf

__all__ = ["read_urdf"]
