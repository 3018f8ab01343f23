"""``<geometry>``: the shapes of visuals and collisions, and finding mesh files."""

from __future__ import annotations

import re
from itertools import chain, islice

from gazelle.description.model import (
    SOLIDS,
    Length,
    MeshShape,
    Shape,
    Solid,
    thickened,
)
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import (
    check_vocabulary,
    find_file,
    number_attribute,
    vector_attribute,
)
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean, nearest_names

__all__ = ["read_geometry"]

_ONES = (1.0, 1.0, 1.0)
_MAX_M = 1e9


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
    if shape.name not in _WORDS:
        hint = did_you_mean(shape.name, _WORDS) or f"use one of {', '.join(_WORDS)}"
        message = f"unknown geometry type '{shape.name}': the {where} is left out"
        context.diagnostics.report("urdf.geometry-unknown", message, shape.span, fix=hint)
        return None
    check_vocabulary(geometry, context.diagnostics, children=(shape.name,), once=(shape.name,))
    kind = _SOLIDS.get(shape.name)
    if kind is None:
        return _mesh(shape, owner, link, context)
    return _solid(kind, shape, owner, link, context)


def _solid(
    kind: type[Solid], tag: Tag, owner: Tag, link: str, context: ReadContext
) -> Solid | None:
    rows, diagnostics = kind.lengths(), context.diagnostics
    check_vocabulary(tag, diagnostics, attributes=tuple(row.word for row in rows))
    missing = [row for row in rows if row.word not in tag.attributes]
    if missing:
        needs = " and ".join(
            f'{row.word}="{"x y z" if isinstance(row.usual, tuple) else "…"}"' for row in missing
        )
        _incomplete(tag, owner, link, f"a {tag.name} needs {needs}", context)
        return None
    read = [_length(tag, row, context) for row in rows]
    lengths = [value for value in read if value is not None]
    if len(lengths) < len(rows):
        return None
    sizes = _usable(tag, tuple(chain.from_iterable(lengths)), link, context)
    if sizes is None:
        return None
    left = iter(sizes)
    values = [tuple(islice(left, len(value))) for value in lengths]
    return kind.of_lengths(tuple(one if len(one) > 1 else one[0] for one in values))


def _length(tag: Tag, row: Length, context: ReadContext) -> tuple[float, ...] | None:
    if isinstance(row.usual, tuple):
        return vector_attribute(tag, row.word, context.diagnostics)
    value = number_attribute(tag, row.word, context.diagnostics)
    return None if value is None else (value,)


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


_SOLIDS = {kind.word: kind for kind in SOLIDS if kind.in_urdf}
_WORDS = tuple(sorted((*_SOLIDS, "mesh")))


def _usable(
    tag: Tag, sizes: tuple[float, ...], link: str, context: ReadContext
) -> tuple[float, ...] | None:
    """Return the sizes with those of 0 as thin as in Gazebo; None, reported, for others."""
    used = thickened(sizes)
    if used == sizes and all(0.0 < size < _MAX_M for size in sizes):
        return sizes
    is_bad = not all(0.0 < size < _MAX_M for size in used)
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
    wanted = [word for word in re.findall(r"(\w+)=", needs) if word not in tag.attributes]
    near = [(word, nearest_names(word, tag.attributes, count=1)) for word in wanted]
    slips = [f"did you mean '{word}' for '{found[0]}'?" for word, found in near if found]
    context.diagnostics.report("urdf.geometry-incomplete", message, tag.span, fix=" ".join(slips))
