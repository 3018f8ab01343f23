"""Collision meshes as convex pieces, the only solids MuJoCo collides."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import MeshShape, Polyline
from gazelle.diagnostics import Diagnostics
from gazelle.engine.outline import ear_clipped
from gazelle.geometry import load_mesh

__all__ = ["convex_pieces", "polyline_pieces"]

Array = NDArray[np.float64]


def convex_pieces(
    shape: MeshShape, name: str, *, static: bool, diagnostics: Diagnostics
) -> tuple[Array, ...]:
    """Return point sets whose convex hulls together stand for a mesh."""
    if shape.path is None:
        return ()
    mesh = load_mesh(shape.path).scaled(shape.scale)
    if shape.submesh:
        part = mesh.submesh(shape.submesh, shape.center_submesh)
        if part is None:
            return ()
        mesh = part
    return (mesh.vertices_m,)


def polyline_pieces(shape: Polyline) -> tuple[Array, ...]:
    """Return the prisms that make up extruded outlines."""
    pieces: list[Array] = []
    for outline in shape.outlines_m:
        for triangle in ear_clipped(outline):
            pieces.append(_prism(triangle, shape.height_m))
    return tuple(pieces)


def _prism(corners: Sequence[tuple[float, float]], height_m: float) -> Array:
    base = np.array([[x, y, 0.0] for x, y in corners])
    return np.vstack([base, base + np.array([0.0, 0.0, height_m])])
