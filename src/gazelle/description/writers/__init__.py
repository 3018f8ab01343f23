"""Models as texts of other formats: URDF and SDF."""

from __future__ import annotations

from gazelle.description.writers.output_files import Converted, OutputFiles
from gazelle.description.writers.sdf import to_sdf
from gazelle.description.writers.urdf import to_urdf

__all__ = ["Converted", "OutputFiles", "to_sdf", "to_urdf"]
