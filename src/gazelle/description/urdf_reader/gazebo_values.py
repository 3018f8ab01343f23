"""``<gazebo>`` blocks by what they refer to, and the values of their elements."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from gazelle.description.model import Collision, Visual
from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag, bool_from, floats_from
from gazelle.diagnostics import did_you_mean

__all__ = [
    "blocks_by_reference",
    "bool_value",
    "float_value",
    "report_passed_over",
    "report_unknown",
    "value_of",
]


def blocks_by_reference(robot: Tag) -> dict[str, list[Tag]]:
    """Return the ``<gazebo>`` elements by ``reference``, empty for the whole robot."""
    blocks: dict[str, list[Tag]] = {}
    for tag in robot.find_all("gazebo"):
        blocks.setdefault(tag.attributes.get("reference", "").strip(), []).append(tag)
    return blocks


def value_of(tag: Tag) -> str:
    """Return the text or, as sdformat allows too, the ``value`` attribute."""
    return tag.attributes.get("value", tag.text).strip()


def float_value(tag: Tag, context: ReadContext) -> float | None:
    """Return the number in an element; None (reported) when it holds none."""
    found = floats_from(
        value_of(tag), 1, (), what=f"<{tag.name}>", span=tag.span, diagnostics=context.diagnostics
    )
    return found[0] if found else None


def bool_value(tag: Tag, default: bool, context: ReadContext) -> bool:
    """Return the truth value in an element; `default` (reported) when it holds none."""
    return bool_from(replace(tag, text=value_of(tag)), default, context.diagnostics)


def report_unknown(tag: Tag, where: str, known: Iterable[str], context: ReadContext) -> None:
    """Report an element that has no meaning in this ``<gazebo>`` block."""
    message = f"<{tag.name}> is not known in <gazebo> for {where}; it has no effect"
    context.diagnostics.report(
        "xml.unknown-tag", message, tag.span, fix=did_you_mean(tag.name, known)
    )


def report_passed_over(
    link: str, shapes: Iterable[Visual | Collision], tag: Tag, context: ReadContext
) -> None:
    """Report shapes that sdformat would not apply a link's ``<gazebo>`` values to."""
    names = [shape.name for shape in shapes if link not in shape.name]
    if names:
        shown = ", ".join(f"'{name}'" for name in names)
        message = (
            f"<{tag.name}> acts on all shapes of link '{link}'; Gazebo would pass over {shown}"
        )
        context.diagnostics.report("urdf.gazebo-named-shape", message, tag.span)
