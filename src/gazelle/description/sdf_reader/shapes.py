"""SDF ``<geometry>``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import cast

from gazelle.description.model import (
    SOLIDS,
    Heightmap,
    Length,
    MeshShape,
    Plane,
    Polyline,
    Shape,
    Solid,
    thickened,
)
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_bool, child_float, child_vector3
from gazelle.description.xml import Tag, floats_from
from gazelle.documents.files import is_folder

__all__ = ["read_shape"]

_ReadShape = Callable[[Tag, ReadContext], Shape | None]
_ONE = (1.0, 1.0, 1.0)
_ZERO = (0.0, 0.0, 0.0)


def read_shape(tag: Tag | None, context: ReadContext, *, owner: Tag) -> Shape | None:
    """Return the shape of a ``<geometry>`` element.

    Args:
        tag: the element; None when the collision or visual has none.
        context: where problems are reported.
        owner: the collision or visual, for messages.

    Returns:
        The shape; None for ``<empty>``, and (with a reported reason) for what cannot be used.
    """
    if tag is None:
        _refuse(owner, "has no <geometry>", owner, context)
        return None
    for child in tag.children:
        if child.name == "polyline":
            return _polyline(tag, owner, context)
        if child.name in _SOLIDS:
            return _solid(_SOLIDS[child.name], child, owner, context)
        if child.name in _READERS:
            return _READERS[child.name](child, context)
        if child.name == "image":
            _refuse(owner, "is an extruded <image>, which is not simulated", child, context)
            return None
    if tag.find("empty") is None:
        fix = f"give it one of {', '.join(_SOLIDS)}, plane, mesh, polyline, heightmap"
        _refuse(owner, "has a <geometry> without a shape", tag, context, fix)
    return None


def _refuse(owner: Tag, reason: str, faulty_tag: Tag, context: ReadContext, fix: str = "") -> None:
    name = owner.attributes.get("name", "")
    message = f"{owner.name} '{name}' {reason}; it is left out"
    context.diagnostics.report("sdf.bad-geometry", message, faulty_tag.span, fix=fix)


def _solid(kind: type[Solid], tag: Tag, owner: Tag, context: ReadContext) -> Solid | None:
    """Return a solid; lengths of 0 are as thin as in Gazebo, for negative ones None, reported."""
    rows = kind.lengths()
    read = [_length(tag, row, context) for row in rows]
    used = []
    for row, value in zip(rows, read, strict=True):
        lengths = value if isinstance(value, tuple) else (value,)
        thick = thickened(lengths)
        faulty_tag = tag.find(row.word) or tag
        what = f"has a <{tag.name}> whose <{row.word}> is"
        if min(thick) <= 0.0:
            _refuse(owner, f"{what} not positive ({min(lengths):g})", faulty_tag, context)
            return None
        if thick != lengths:
            thin_m = max(set(thick) - set(lengths))
            message = f"{owner.name} '{owner.attributes.get('name', '')}' {what} 0; {thin_m:g} m "
            message += "is used, as in Gazebo"
            context.diagnostics.report("sdf.bad-geometry", message, faulty_tag.span)
        used.append(thick if isinstance(value, tuple) else thick[0])
    return kind.of_lengths(tuple(used))


def _length(tag: Tag, row: Length, context: ReadContext) -> float | tuple[float, ...]:
    if isinstance(row.usual, tuple):
        return child_vector3(tag, row.word, row.usual, context)
    return child_float(tag, row.word, row.usual, context)


def _plane(tag: Tag, context: ReadContext) -> Shape:
    normal = child_vector3(tag, "normal", (0.0, 0.0, 1.0), context)
    if not any(normal):
        found = tag.find("normal") or tag
        message = "the <normal> of a plane has length 0; 0 0 1 is used"
        context.diagnostics.report("sdf.bad-value", message, found.span)
        normal = (0.0, 0.0, 1.0)
    return Plane(normal, _pair(tag.find("size"), (1.0, 1.0), context))


def _pair(
    tag: Tag | None, default: tuple[float, float], context: ReadContext
) -> tuple[float, float]:
    if tag is None or not tag.text:
        return default
    found = floats_from(
        tag.text, 2, default, what=f"<{tag.name}>", span=tag.span, diagnostics=context.diagnostics
    )
    return cast(tuple[float, float], found)


def _polyline(geometry: Tag, owner: Tag, context: ReadContext) -> Shape | None:
    outlines = tuple(
        tuple(_pair(point, (0.0, 0.0), context) for point in line.find_all("point"))
        for line in geometry.find_all("polyline")
    )
    usable = tuple(outline for outline in outlines if len(outline) >= 3)
    if len(usable) < len(outlines):
        _refuse(owner, "has a <polyline> with fewer than 3 points", geometry, context)
    height_m = child_float(geometry.find_all("polyline")[0], "height", 1.0, context)
    return Polyline(usable, height_m) if usable else None


def _mesh(tag: Tag, context: ReadContext) -> Shape:
    uri = tag.text_of("uri") or tag.text_of("filename")
    submesh = tag.find("submesh")
    return MeshShape(
        uri=uri,
        path=_file(uri, tag, context),
        scale=_scale(tag, context),
        submesh=submesh.text_of("name") if submesh else "",
        center_submesh=child_bool(submesh, "center", False, context) if submesh else False,
        span=(tag.find("uri") or tag).span,
    )


def _scale(tag: Tag, context: ReadContext) -> tuple[float, float, float]:
    """Return the scale; one number instead of three counts for all axes."""
    scale = tag.find("scale")
    if scale is None or len(scale.text.split()) != 1:
        return child_vector3(tag, "scale", _ONE, context)
    factor = child_float(tag, "scale", 1.0, context)
    message = f"<scale> needs 3 numbers, found 1: {factor:g} is used for all axes"
    context.diagnostics.report("sdf.bad-value", message, scale.span)
    return (factor, factor, factor)


def _heightmap(tag: Tag, context: ReadContext) -> Shape:
    uri = tag.text_of("uri")
    return Heightmap(
        uri=uri,
        path=_file(uri, tag, context),
        size_m=child_vector3(tag, "size", _ONE, context),
        position_m=child_vector3(tag, "pos", _ZERO, context),
        span=(tag.find("uri") or tag).span,
    )


def _file(uri: str, tag: Tag, context: ReadContext) -> Path | None:
    """Return the file a ``<uri>`` means, None (reported) when there is none."""
    faulty_tag = tag.find("uri") or tag
    if not uri:
        context.diagnostics.report(
            "sdf.missing-file", f"<{tag.name}> names no file in <uri>", faulty_tag.span
        )
        return None
    found = context.resolve(uri)
    if found.path is None or is_folder(found.path):
        if context.first_time("missing file", uri, context.file):
            context.diagnostics.report("sdf.missing-file", found.explain(uri), faulty_tag.span)
        return None
    context.report_note(uri, found, faulty_tag.span, "sdf.bad-value")
    return found.path


_SOLIDS = {kind.word: kind for kind in SOLIDS}
_READERS: dict[str, _ReadShape] = {
    "plane": _plane,
    "mesh": _mesh,
    "heightmap": _heightmap,
}
