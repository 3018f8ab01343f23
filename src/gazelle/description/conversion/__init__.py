"""Models as texts of other formats: URDF and SDF."""

from __future__ import annotations

from gazelle.description.conversion.beside import Beside, Converted
from gazelle.description.conversion.sdf_text import to_sdf
from gazelle.description.conversion.urdf_text import to_urdf

__all__ = ["Beside", "Converted", "to_sdf", "to_urdf"]
