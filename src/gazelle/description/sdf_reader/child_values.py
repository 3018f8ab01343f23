"""Typed values of child elements, with SDF's defaults."""

from __future__ import annotations

import re
from typing import cast

from gazelle.description.model import Rgba
from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag, bool_from, float_from, floats_from, int_from
from gazelle.geometry import Vector3

__all__ = [
    "child_bool",
    "child_float",
    "child_int",
    "child_rgba",
    "child_vector3",
    "name_of",
    "optional_float",
    "optional_int",
    "optional_vector3",
    "vector3_from",
]

_ZERO: Vector3 = (0.0, 0.0, 0.0)
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]+")


def child_float(tag: Tag, name: str, default: float, context: ReadContext) -> float:
    """Return the number in child `name`."""
    return float_from(tag.find(name), default, context.diagnostics)


def child_int(tag: Tag, name: str, default: int, context: ReadContext) -> int:
    """Return the integer in child `name`."""
    return int_from(tag.find(name), default, context.diagnostics)


def child_bool(tag: Tag, name: str, default: bool, context: ReadContext) -> bool:
    """Return the truth value in child `name`."""
    return bool_from(tag.find(name), default, context.diagnostics)


def optional_float(tag: Tag | None, name: str, context: ReadContext) -> float | None:
    """Return the number in child `name`, None when there is none."""
    found = tag.find(name) if tag is not None else None
    if found is None or not found.text:
        return None
    return float_from(found, 0.0, context.diagnostics)


def optional_int(tag: Tag | None, name: str, context: ReadContext) -> int | None:
    """Return the integer in child `name` (``0x…`` is understood), None when there is none."""
    found = tag.find(name) if tag is not None else None
    if found is None or not found.text:
        return None
    if _HEXADECIMAL.fullmatch(found.text):
        return int(found.text, 16)
    return int_from(found, 0, context.diagnostics)


def vector3_from(tag: Tag | None, default: Vector3, context: ReadContext) -> Vector3:
    """Return the three numbers in a tag's text; `default` when it is None or empty."""
    if tag is None or not tag.text:
        return default
    return cast(Vector3, _numbers(tag, 3, default, context))


def child_vector3(tag: Tag, name: str, default: Vector3, context: ReadContext) -> Vector3:
    """Return the three numbers in child `name`."""
    return vector3_from(tag.find(name), default, context)


def optional_vector3(tag: Tag | None, name: str, context: ReadContext) -> Vector3 | None:
    """Return the three numbers in child `name`, None when there is none."""
    found = tag.find(name) if tag is not None else None
    if found is None or not found.text:
        return None
    return vector3_from(found, _ZERO, context)


def child_rgba(tag: Tag, name: str, default: Rgba, context: ReadContext) -> Rgba:
    """Return the colour in child `name`; without alpha it is opaque."""
    found = tag.find(name)
    if found is None or not found.text:
        return default
    if len(found.text.split()) == 3:
        red, green, blue = _numbers(found, 3, default[:3], context)
        return (red, green, blue, 1.0)
    return cast(Rgba, _numbers(found, 4, default, context))


def name_of(tag: Tag, context: ReadContext, *, default: str = "") -> str:
    """Return the ``name`` attribute; a missing one is reported and `default` used."""
    name = tag.attributes.get("name", "").strip()
    if not name:
        chosen = f"'{default}' is used" if default else "the element is left out"
        context.diagnostics.report(
            "xml.missing-attribute", f"<{tag.name}> has no name; {chosen}", tag.span
        )
        return default
    return name


def _numbers(
    tag: Tag, count: int, default: tuple[float, ...], context: ReadContext
) -> tuple[float, ...]:
    return floats_from(
        tag.text,
        count,
        default,
        what=f"<{tag.name}>",
        span=tag.span,
        diagnostics=context.diagnostics,
    )
