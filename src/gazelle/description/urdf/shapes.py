"""``<geometry>``: the shapes of visuals and collisions, and finding mesh files."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.description.context import ReadContext
from gazelle.description.model import (
    Box,
    Capsule,
    Cylinder,
    MeshShape,
    Shape,
    Sphere,
    thickened,
)
from gazelle.description.urdf.attributes import (
    check_vocabulary,
    number_attribute,
    vector_attribute,
)
from gazelle.description.urdf.files import find_file
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["read_geometry"]

_ONES = (1.0, 1.0, 1.0)
_LARGEST_M = 1e9


def read_geometry(owner: Tag, link: str, context: ReadContext) -> Shape | None:
    """Return the shape of a ``<visual>`` or ``<collision>``; None (reported) without a usable one.

    Args:
        owner: the ``<visual>`` or ``<collision>``.
        link: the link's name, for the messages.
        context: workspace for mesh files and where to report.
    """
    geometry = owner.find("geometry")
    where = f"<{owner.name}> of link '{link}'"
    if geometry is None or not geometry.children:
        message = f"{where} has no shape in <geometry> and is left out"
        context.diagnostics.report("urdf.geometry-missing", message, (geometry or owner).span)
        return None
    shape = geometry.children[0]
    reader = _READERS.get(shape.name)
    if reader is None:
        hint = did_you_mean(shape.name, _READERS) or f"use one of {', '.join(sorted(_READERS))}"
        message = f"unknown geometry type '{shape.name}': the {where} is left out"
        context.diagnostics.report("urdf.geometry-unknown", message, shape.span, fix=hint)
        return None
    check_vocabulary(geometry, context.diagnostics, children=(shape.name,), once=(shape.name,))
    return reader(shape, owner, link, context)


def _box(tag: Tag, owner: Tag, link: str, context: ReadContext) -> Shape | None:
    check_vocabulary(tag, context.diagnostics, attributes=("size",))
    if "size" not in tag.attributes:
        _incomplete(tag, owner, link, 'a box needs size="x y z"', context)
        return None
    size = vector_attribute(tag, "size", context.diagnostics)
    sizes = _usable(tag, size, link, context) if size else None
    return Box((sizes[0], sizes[1], sizes[2])) if sizes else None


def _sphere(tag: Tag, owner: Tag, link: str, context: ReadContext) -> Shape | None:
    check_vocabulary(tag, context.diagnostics, attributes=("radius",))
    numbers = _numbers(tag, owner, link, ("radius",), context)
    return Sphere(numbers[0]) if numbers else None


def _cylinder(tag: Tag, owner: Tag, link: str, context: ReadContext) -> Shape | None:
    check_vocabulary(tag, context.diagnostics, attributes=("radius", "length"))
    numbers = _numbers(tag, owner, link, ("radius", "length"), context)
    return Cylinder(numbers[0], numbers[1]) if numbers else None


def _capsule(tag: Tag, owner: Tag, link: str, context: ReadContext) -> Shape | None:
    check_vocabulary(tag, context.diagnostics, attributes=("radius", "length"))
    numbers = _numbers(tag, owner, link, ("radius", "length"), context)
    return Capsule(numbers[0], numbers[1]) if numbers else None


def _mesh(tag: Tag, owner: Tag, link: str, context: ReadContext) -> Shape | None:
    check_vocabulary(tag, context.diagnostics, attributes=("filename", "scale"))
    uri = tag.attributes.get("filename", "").strip()
    if not uri:
        _incomplete(tag, owner, link, 'a mesh needs filename="package://…"', context)
        return None
    scale = vector_attribute(tag, "scale", context.diagnostics)
    if scale is None and "scale" in tag.attributes:
        return None
    found = find_file(uri, tag.span, context)
    if found.path is None:
        touches = owner.name == "collision"
        code = "urdf.collision-mesh-missing" if touches else "urdf.mesh-missing"
        effect = "will not touch anything" if touches else "cannot be seen"
        message = f"the {owner.name} mesh of link '{link}' {effect}: {found.explain(uri)}"
        context.diagnostics.report(code, message, tag.span)
    return MeshShape(uri, found.path, scale or _ONES, span=tag.span)


_READERS: dict[str, Callable[[Tag, Tag, str, ReadContext], Shape | None]] = {
    "box": _box,
    "capsule": _capsule,
    "cylinder": _cylinder,
    "mesh": _mesh,
    "sphere": _sphere,
}


def _numbers(
    tag: Tag, owner: Tag, link: str, names: tuple[str, ...], context: ReadContext
) -> tuple[float, ...] | None:
    missing = [name for name in names if name not in tag.attributes]
    if missing:
        needs = " and ".join(f'{name}="…"' for name in missing)
        _incomplete(tag, owner, link, f"a {tag.name} needs {needs}", context)
        return None
    values = tuple(number_attribute(tag, name, context.diagnostics) for name in names)
    good = tuple(value for value in values if value is not None)
    return _usable(tag, good, link, context) if len(good) == len(names) else None


def _usable(
    tag: Tag, sizes: tuple[float, ...], link: str, context: ReadContext
) -> tuple[float, ...] | None:
    """Return the sizes with those of 0 as thin as in Gazebo; None, reported, for others."""
    used = thickened(sizes)
    if used == sizes and all(0.0 < size < _LARGEST_M for size in sizes):
        return sizes
    is_bad = not all(0.0 < size < _LARGEST_M for size in used)
    if is_bad:
        limits = (
            "not positive; left out" if min(used) <= 0.0 else "too large to be metres; left out"
        )
    else:
        limits = f"0; {max(set(used) - set(sizes)):g} m is used, as in Gazebo"
    shown = " ".join(f"{size:g}" for size in sizes)
    message = f"the {tag.name} of link '{link}' has a size ({shown}) that is {limits}"
    context.diagnostics.report("urdf.bad-size", message, tag.span)
    return None if is_bad else used


def _incomplete(tag: Tag, owner: Tag, link: str, needs: str, context: ReadContext) -> None:
    message = f"{needs}: the <{owner.name}> of link '{link}' is left out"
    context.diagnostics.report("urdf.geometry-incomplete", message, tag.span)
