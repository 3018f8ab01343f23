"""The element tree that sdformat's parsers build and its printer prints."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.description.xml import Tag

__all__ = ["SdfElement", "raw_element"]


@dataclass(slots=True)
class SdfElement:
    """One element; mutable, as parsers fill it step by step.

    Attributes:
        name: element name.
        attributes: values by name, in the order they are printed.
        text: value, stripped; empty for elements that only have children.
        children: in document order.
        line: line of the text it was written in, 0 when it was made.
    """

    name: str
    attributes: dict[str, str] = field(default_factory=dict)
    text: str = ""
    children: list[SdfElement] = field(default_factory=list)
    line: int = 0

    def add(self, name: str, text: str = "", /, **attributes: str) -> SdfElement:
        """Append a child and return it."""
        child = SdfElement(name, dict(attributes), text)
        self.children.append(child)
        return child

    def find(self, name: str) -> SdfElement | None:
        """Return the first child of a name, None when there is none."""
        return next((child for child in self.children if child.name == name), None)

    def find_all(self, name: str) -> list[SdfElement]:
        """Return all children of a name."""
        return [child for child in self.children if child.name == name]

    def walk(self) -> Iterator[SdfElement]:
        """Yield this element and all below it, in document order."""
        yield self
        for child in self.children:
            yield from child.walk()


def raw_element(tag: Tag) -> SdfElement:
    """Return a tag and all below it; white space in texts is collapsed as TinyXML does."""
    text = " ".join(tag.text.split())
    children = [raw_element(child) for child in tag.children]
    return SdfElement(tag.name, dict(tag.attributes), text, children, tag.span.line or 0)
