"""Tags and elements in the text of a file that need not be whole XML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

__all__ = ["Tag", "children", "closing_tag", "element_end", "tag_at", "tags"]

_TAG = re.compile(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<[?!][^>]*>"
    r"|<(?P<close>/?)(?P<name>[^\s<>/!?\"'=]+)"
    r"(?:[^<>\"']|\"[^\"]*\"|'[^']*')*?(?P<empty>/?)>",
    re.DOTALL,
)


class Tag(NamedTuple):
    """A tag of a text.

    Attributes:
        begin, end: from its ``<`` to behind its ``>``, in characters.
        name: of the element.
        closes: it begins with ``</``.
        is_empty: it ends with ``/>``.
    """

    begin: int
    end: int
    name: str
    closes: bool
    is_empty: bool


def tags(text: str, begin: int = 0, end: int | None = None) -> Iterator[Tag]:
    """Return the tags of a part of a text; comments hold none."""
    for found in _TAG.finditer(text, begin, len(text) if end is None else end):
        if found["name"]:
            closes, empty = bool(found["close"]), bool(found["empty"])
            yield Tag(found.start(), found.end(), found["name"], closes, empty)


def tag_at(text: str, at: int) -> Tag | None:
    """Return the opening tag that a place is in, or the last that begins before it."""
    begin = text.rfind("<", 0, at + 1)
    while begin >= 0:
        tag = next(tags(text, begin), None)
        if tag is not None and tag.begin == begin and not tag.closes:
            return tag
        begin = text.rfind("<", 0, begin)
    return None


def closing_tag(text: str, tag: Tag) -> Tag | None:
    """Return the tag that ends an element, None for one that has none."""
    if tag.is_empty:
        return None
    depth = 0
    for other in tags(text, tag.end):
        if other.name != tag.name or other.is_empty:
            continue
        if other.closes and depth == 0:
            return other
        depth += -1 if other.closes else 1
    return None


def element_end(text: str, tag: Tag) -> int:
    """Return where an element ends, in characters."""
    closing = closing_tag(text, tag)
    return tag.end if closing is None else closing.end


def children(text: str, tag: Tag) -> Iterator[Tag]:
    """Return the opening tags of the elements directly in an element."""
    closing = closing_tag(text, tag)
    at = tag.end
    while closing is not None:
        child = next(tags(text, at, closing.begin), None)
        if child is None:
            return
        if not child.closes:
            yield child
        at = element_end(text, child)
