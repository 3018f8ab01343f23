"""Parsed XML as elements that can be changed, before any rule of the specification."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.xml import Tag

__all__ = ["raw_element"]


def raw_element(tag: Tag) -> SdfElement:
    """Return a tag and all below it; white space in texts is collapsed as TinyXML does."""
    text = " ".join(tag.text.split())
    children = [raw_element(child) for child in tag.children]
    return SdfElement(tag.name, dict(tag.attributes), text, children, tag.span.line or 0)
