"""The mass properties of a link's shapes filled with water."""

from __future__ import annotations

import math
from typing import assert_never

from gazelle.description.context import ReadContext
from gazelle.description.model import (
    Heightmap,
    Link,
    MeshShape,
    Plane,
    Polyline,
    Shape,
    Solid,
)
from gazelle.diagnostics import SourceSpan
from gazelle.errors import GazelleError
from gazelle.geometry import (
    MassProperties,
    Pose,
    combined_mass_properties,
)

__all__ = ["body_of"]

_DENSITY_KG_M3 = 1000.0


def body_of(link: Link, context: ReadContext) -> MassProperties | None:
    """Return mass properties of a link's collisions, or of its visuals when it has none.

    Args:
        link: the link.
        context: where to report meshes that cannot be read.

    Returns:
        Mass, centre and inertia at 1000 kg/m³ in the link's frame; None without any volume.
    """
    collisions = [(item.shape, item.T_link_collision, item.span) for item in link.collisions]
    visuals = [(item.shape, item.T_link_visual, item.span) for item in link.visuals]
    return _whole(collisions, context) or _whole(visuals, context)


def _whole(
    shapes: list[tuple[Shape, Pose, SourceSpan | None]], context: ReadContext
) -> MassProperties | None:
    bodies = []
    for shape, pose, span in shapes:
        body = _body(shape, span, context)
        if body is not None and 0.0 < body.mass_kg < math.inf:
            bodies.append(body.transformed(pose))
    return combined_mass_properties(bodies) if bodies else None


def _body(shape: Shape, span: SourceSpan | None, context: ReadContext) -> MassProperties | None:
    match shape:
        case Solid():
            return shape.body(_DENSITY_KG_M3)
        case MeshShape():
            return _mesh_body(shape, span, context)
        case Plane() | Heightmap() | Polyline():
            return None  # URDF has no word for them
        case _:
            assert_never(shape)


def _mesh_body(
    shape: MeshShape, span: SourceSpan | None, context: ReadContext
) -> MassProperties | None:
    """Return a mesh's properties, those of its convex hull when it is not closed."""
    from gazelle.geometry import convex_hull, load_mesh_reported, mesh_mass_properties

    if shape.path is None:
        return None
    mesh = load_mesh_reported(shape.path, context.diagnostics, shape.span or span, smooth=False)
    if mesh is None:
        return None
    sized = mesh.scaled(shape.scale)
    try:
        return mesh_mass_properties(sized, density_kg_m3=_DENSITY_KG_M3)
    except GazelleError:
        try:
            hull = convex_hull(sized.vertices_m)
            return mesh_mass_properties(hull, density_kg_m3=_DENSITY_KG_M3)
        except (GazelleError, ValueError):
            return None  # flat: no volume, and the caller says that there is nothing to go by
