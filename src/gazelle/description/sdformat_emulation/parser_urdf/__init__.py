"""Robot descriptions turned into SDF exactly as sdformat's parser_urdf turns them."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.parser_urdf.conversion import urdf_to_sdf
from gazelle.description.sdformat_emulation.parser_urdf.dropped_links import (
    DroppedLink,
    dropped_links,
    lumped_links,
)

__all__ = ["DroppedLink", "dropped_links", "lumped_links", "urdf_to_sdf"]
