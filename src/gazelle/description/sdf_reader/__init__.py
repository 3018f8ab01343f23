"""SDF 1.4 to 1.12: worlds, models and their parts."""

from __future__ import annotations

from gazelle.description.sdf_reader.document import (
    SdfDocument,
    read_model_file,
    read_sdf,
    read_world_file,
)

__all__ = ["SdfDocument", "read_model_file", "read_sdf", "read_world_file"]
