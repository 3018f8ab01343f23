"""SDF ``<inertial>``: as written, or computed from the collisions (SDF 1.11)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import assert_never

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
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_float, optional_float
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag
from gazelle.diagnostics import Severity
from gazelle.errors import GazelleError
from gazelle.geometry import Pose
from gazelle.geometry.mass_properties import (
    MassProperties,
    combined_mass_properties,
    inertia_problems,
    legalised_inertia,
)

__all__ = ["computed_inertial", "read_inertial"]

_WATER_KG_M3 = 1000.0
Inertia6 = tuple[float, float, float, float, float, float]
_WORDS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_DEFAULTS: Inertia6 = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
_TRUE = ("1", "true")
_NOT_NUMBERS = frozenset({"inf", "+inf", "-inf", "nan", "-nan"})


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


def read_inertial(
    link: Tag, collisions: Sequence[Collision], context: ReadContext, *, static: bool
) -> Inertial:
    """Return a link's mass properties; SDF's default is 1 kg with moments of 1 kg·m².

    Args:
        link: the ``<link>``.
        collisions: its collisions, for ``auto="true"``.
        context: where problems are reported.
        static: the model never moves; impossible values do no harm then.
    """
    tag = link.find("inertial")
    if tag is None:
        return Inertial(1.0, span=link.span)
    if tag.attributes.get("auto", "").strip().lower() in _TRUE:
        return computed_inertial(link, tag, collisions, context)
    inertial = Inertial(
        mass_kg=child_float(tag, "mass", 1.0, context),
        T_link_com=pose_of(tag, context),
        inertia_kg_m2=_tensor(tag.find("inertia"), link, context),
        span=tag.span,
    )
    return inertial if static else _checked(inertial, link, tag, context)


def _density(tag: Tag, usual: float, context: ReadContext) -> float:
    value = child_float(tag, "density", usual, context)
    if value > 0.0:
        return value
    faulty_tag = tag.find("density") or tag
    message = f"<density> is {value:g} kg/m³; it must be positive, {usual:g} is used"
    context.diagnostics.report("sdf.bad-value", message, faulty_tag.span)
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


def _tensor(tag: Tag | None, link: Tag, context: ReadContext) -> Inertia6:
    if tag is None:
        return _DEFAULTS
    # CAD exporters write nan for shapes without volume; Gazebo goes on with its defaults.
    lost = [child.name for child in tag.children if child.text.strip().lower() in _NOT_NUMBERS]
    if lost:
        name = link.attributes.get("name", "")
        message = (
            f"the inertia of link '{name}' is not finite ({', '.join(lost)}); the default, moments "
            "of 1 kg m2, is used"
        )
        context.diagnostics.report("sdf.bad-inertia", message, tag.span, severity=Severity.WARNING)
        return _DEFAULTS
    ixx, ixy, ixz, iyy, iyz, izz = (
        child_float(tag, word, default, context)
        for word, default in zip(_WORDS, _DEFAULTS, strict=True)
    )
    return ixx, ixy, ixz, iyy, iyz, izz


def _checked(inertial: Inertial, link: Tag, tag: Tag, context: ReadContext) -> Inertial:
    """Report a mass or tensor that no body can have; return one that a body can have."""
    name = link.attributes.get("name", "")
    # Gazebo classic, at home up to SDF 1.6, says nothing and simulates something.
    worst = Severity.WARNING if context.version < (1, 7) else Severity.ERROR
    if inertial.mass_kg <= 0.0:
        faulty_tag = tag.find("mass") or tag
        message = f"link '{name}' has the mass {inertial.mass_kg:g} kg; 1 kg is used"
        context.diagnostics.report("sdf.bad-inertia", message, faulty_tag.span, severity=worst)
        inertial = replace(inertial, mass_kg=1.0)
    problems = inertia_problems(inertial.inertia_kg_m2)
    if not problems:
        return inertial
    faulty_tag = tag.find("inertia") or tag
    message = (
        f"no body has the inertia of link '{name}': {'; '.join(problems)}; "
        "the nearest possible tensor is used"
    )
    positive = min(
        MassProperties(1.0, inertia_kg_m2=inertial.inertia_kg_m2).principal_moments_kg_m2
    )
    severity = Severity.WARNING if positive > 0.0 else worst
    context.diagnostics.report("sdf.bad-inertia", message, faulty_tag.span, severity=severity)
    return replace(inertial, inertia_kg_m2=legalised_inertia(inertial.inertia_kg_m2))
