"""``<link>``: inertia, visuals and collisions."""

from __future__ import annotations

from gazelle.description.model import Collision, Inertial, Link, Material, Visual
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import check_vocabulary, number_attribute, origin_of
from gazelle.description.urdf_reader.materials import visual_material
from gazelle.description.urdf_reader.shapes import read_geometry
from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan, nearest_names

__all__ = ["read_link"]

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def read_link(tag: Tag, name: str, materials: dict[str, Material], context: ReadContext) -> Link:
    """Return a link in its own frame; its pose in the model comes later.

    Args:
        tag: the ``<link>``.
        name: its name.
        materials: named materials known so far; grows.
        context: workspace for meshes and where to report.
    """
    check_vocabulary(
        tag,
        context.diagnostics,
        attributes=("name", "type"),
        children=("inertial", "visual", "collision"),
        once=("inertial",),
    )
    inertial = tag.find("inertial")
    return Link(
        name,
        inertial=_read_inertial(inertial, name, context) if inertial is not None else None,
        collisions=_read_collisions(tag, name, context),
        visuals=_read_visuals(tag, name, materials, context),
        span=tag.span,
        inertial_tag=inertial,
    )


def _read_inertial(tag: Tag, link: str, context: ReadContext) -> Inertial | None:
    once = ("origin", "mass", "inertia")
    check_vocabulary(tag, context.diagnostics, children=once, once=once)
    T_link_com = origin_of(tag, context.diagnostics)
    mass, inertia = tag.find("mass"), tag.find("inertia")
    if mass is None or "value" not in mass.attributes:
        near = nearest_names("value", mass.attributes, count=1) if mass is not None else ()
        fix = f"did you mean 'value' for '{near[0]}'?" if near else ""
        _incomplete(mass or tag, link, '<mass> must have value="…"', context, fix)
        mass_kg = None
    else:
        check_vocabulary(mass, context.diagnostics, attributes=("value",))
        mass_kg = number_attribute(mass, "value", context.diagnostics)
    tensor = _read_tensor(inertia, tag, link, context)
    if mass_kg is None or tensor is None:
        return None
    return Inertial(mass_kg, T_link_com, tensor, span=tag.span)


def _read_tensor(
    tag: Tag | None, inertial: Tag, link: str, context: ReadContext
) -> tuple[float, float, float, float, float, float] | None:
    if tag is None:
        _incomplete(inertial, link, "there is no <inertia>", context)
        return None
    check_vocabulary(tag, context.diagnostics, attributes=_TENSOR)
    missing = [name for name in _TENSOR if name not in tag.attributes]
    if missing:
        near = nearest_names(missing[0], tag.attributes.keys() - set(_TENSOR), count=1)
        fix = f"did you mean '{missing[0]}' for '{near[0]}'?" if near else ""
        _incomplete(tag, link, f"<inertia> lacks {', '.join(missing)}", context, fix)
        return None
    values = [number_attribute(tag, name, context.diagnostics) for name in _TENSOR]
    good = [value for value in values if value is not None]
    if len(good) < len(_TENSOR):
        return None
    return (good[0], good[1], good[2], good[3], good[4], good[5])


def _incomplete(tag: Tag, link: str, what: str, context: ReadContext, fix: str = "") -> None:
    message = f"the <inertial> of link '{link}' cannot be used: {what}"
    context.diagnostics.report("urdf.inertial-incomplete", message, tag.span, fix=fix)


def _read_collisions(tag: Tag, link: str, context: ReadContext) -> tuple[Collision, ...]:
    found: list[Collision] = []
    for index, child in enumerate(tag.find_all("collision")):
        check_vocabulary(
            child,
            context.diagnostics,
            attributes=("name", "group"),
            children=("origin", "geometry", "verbose"),
            once=("origin", "geometry"),
        )
        pose = origin_of(child, context.diagnostics)
        shape = read_geometry(child, link, context)
        if shape is not None:
            name = _shape_name(child, link, index, {item.name for item in found})
            found.append(Collision(name, shape, pose, span=child.span, shape_span=_place(child)))
    return tuple(found)


def _read_visuals(
    tag: Tag, link: str, materials: dict[str, Material], context: ReadContext
) -> tuple[Visual, ...]:
    found: list[Visual] = []
    for index, child in enumerate(tag.find_all("visual")):
        check_vocabulary(
            child,
            context.diagnostics,
            attributes=("name",),
            children=("origin", "geometry", "material"),
            once=("origin", "geometry", "material"),
        )
        pose = origin_of(child, context.diagnostics)
        shape = read_geometry(child, link, context)
        material = visual_material(child, link, materials, context)
        if shape is not None:
            name = _shape_name(child, link, index, {item.name for item in found})
            found.append(
                Visual(name, shape, pose, material, span=child.span, shape_span=_place(child))
            )
    return tuple(found)


def _shape_name(tag: Tag, link: str, index: int, taken: set[str]) -> str:
    """Name shapes as sdformat's URDF conversion does: ``link_visual``, then ``link_visual_1``."""
    name = tag.attributes.get("name", "").strip()
    if name and name not in taken:
        return name
    base = name or f"{link}_{tag.name}"
    return base if index == 0 else f"{base}_{index}"


def _place(owner: Tag) -> SourceSpan | None:
    geometry = owner.find("geometry")
    return geometry.children[0].span if geometry is not None and geometry.children else None
