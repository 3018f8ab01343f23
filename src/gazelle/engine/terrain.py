"""Heightmaps: an image as a field of heights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Heightmap
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.images import PictureError, opened_picture

__all__ = ["read_terrain"]


def read_terrain(
    shape: Heightmap, name: str, span: SourceSpan | None, diagnostics: Diagnostics
) -> NDArray[np.float64] | None:
    """Return the heights of a heightmap's image, 0 for black to 1 for white, row 0 at −y.

    They are (rows, columns). Gazebo puts the image's top edge at the largest y.
    """
    if shape.path is None:
        return None
    try:
        with opened_picture(shape.path) as image:
            pixels = np.asarray(image.convert("I;16" if image.mode.startswith("I") else "L"))
    except (OSError, PictureError) as error:
        diagnostics.report(
            "engine.unreadable-terrain",
            f"the heightmap '{shape.uri}' of collision '{name}' cannot be read as an image"
            f" ({error}); it does not collide",
            shape.span or span,
        )
        return None
    top = 65535.0 if pixels.dtype.itemsize > 1 else 255.0
    return np.flipud(pixels).astype(np.float64) / top
