"""``<inertial auto="true">`` of SDF 1.11: mass properties from the collisions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from gazelle.description.context import ReadContext
from gazelle.description.model import (
    Collision,
    Heightmap,
    Inertial,
    MeshShape,
    Plane,
    Polyline,
    Shape,
    Solid,
)
from gazelle.description.sdf.values import child_float, optional_float
from gazelle.description.xml import Tag
from gazelle.errors import GazelleError
from gazelle.geometry import Pose
from gazelle.geometry.mass import MassProperties, combined_mass_properties

__all__ = ["computed_inertial"]

_WATER_KG_M3 = 1000.0


def computed_inertial(
    link: Tag, tag: Tag, collisions: Sequence[Collision], context: ReadContext
) -> Inertial:
    """Return mass properties of a link from its collisions' volumes.

    The density is the collision's, else the ``<inertial>``'s, else water's. A ``<mass>`` beside
    ``auto`` scales the result (SDF 1.11 and later).

    Args:
        link: the ``<link>``.
        tag: its ``<inertial auto="true">``.
        collisions: its collisions as read.
        context: where problems are reported.
    """
    usual = _density(tag, _WATER_KG_M3, context)
    densities = {
        child.attributes.get("name", "").strip(): _density(child, usual, context)
        for child in link.find_all("collision")
    }
    bodies = []
    for item in collisions:
        body = _body(item.shape, densities.get(item.name, usual), item, context)
        if body is not None:
            bodies.append(body.transformed(item.T_link_collision))
    if not bodies:
        name = link.attributes.get("name", "")
        message = f"link '{name}' has no collision with a volume to compute its inertia from"
        context.diagnostics.report("sdf.auto-inertia", message, tag.span)
        return Inertial(1.0, span=tag.span)
    whole = combined_mass_properties(bodies)
    mass_kg = optional_float(tag, "mass", context)
    if mass_kg is not None and mass_kg > 0.0:
        whole = whole.with_mass(mass_kg)
    return Inertial(
        whole.mass_kg, Pose(whole.center_m), whole.inertia_kg_m2, estimated=True, span=tag.span
    )


def _density(tag: Tag, usual: float, context: ReadContext) -> float:
    value = child_float(tag, "density", usual, context)
    if value > 0.0:
        return value
    place = tag.find("density") or tag
    message = f"<density> is {value:g} kg/m³; it must be positive, {usual:g} is used"
    context.diagnostics.report("sdf.bad-value", message, place.span)
    return usual


def _body(
    shape: Shape, density: float, collision: Collision, context: ReadContext
) -> MassProperties | None:
    """Return one shape of even density; None when it has no volume."""
    match shape:
        case Solid():
            return shape.body(density)
        case MeshShape() | Polyline():
            return _mesh_body(shape, density, collision, context)
        case Plane() | Heightmap():
            return None
        case _:
            assert_never(shape)


def _mesh_body(
    shape: MeshShape | Polyline, density: float, collision: Collision, context: ReadContext
) -> MassProperties | None:
    from gazelle.geometry import load_mesh_reported, mesh_mass_properties, polyline_mesh

    try:
        if isinstance(shape, Polyline):
            part = polyline_mesh(shape.outlines_m, shape.height_m)
            return mesh_mass_properties(part, density_kg_m3=density)
        if shape.path is None:
            return None
        mesh = load_mesh_reported(shape.path, context.diagnostics, shape.span, smooth=False)
        if mesh is not None and shape.submesh:
            mesh = mesh.submesh(shape.submesh, shape.center_submesh)
        if mesh is None:
            return None
        return mesh_mass_properties(mesh.scaled(shape.scale), density_kg_m3=density)
    except (ValueError, GazelleError) as error:
        message = f"collision '{collision.name}' has no volume: {error}"
        context.diagnostics.report("sdf.auto-inertia", message, collision.span)
        return None
