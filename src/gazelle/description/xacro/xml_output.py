"""The expanded document as text, with the line of every element; in one go."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any
from xml.dom import Node, minidom

from gazelle.description.xacro.dom import span_of
from gazelle.diagnostics import SourceSpan

__all__ = ["UnwritableError", "Written", "written"]

_INDENT = "  "


class UnwritableError(Exception):
    """An attribute is no text: ``<xacro:attribute>`` sets what its expression gives."""

    def __init__(self, element: Any, name: str, value: object) -> None:
        self.element = element
        self.name = name
        self.value = value
        super().__init__(f"{type(value).__name__!r} object has no attribute 'replace'")


@dataclass
class Written:
    """A text that is being put together, as ``toprettyxml`` of the library's document would be.

    Attributes:
        spans: where each element was written, in document order.
        lines: the line of each element in the text, from 1.
        names: the names of all elements.
        unexpanded: places of CDATA sections with expressions, which xacro does not expand.
    """

    spans: list[SourceSpan | None] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    names: set[str] = field(default_factory=set)
    unexpanded: list[SourceSpan | None] = field(default_factory=list)
    _parts: list[str] = field(default_factory=list)
    _line: int = 1

    @property
    def text(self) -> str:
        """The text so far."""
        return "".join(self._parts)

    def write(self, text: str) -> None:
        """Add a piece; what minidom's nodes call."""
        self._parts.append(text)
        self._line += text.count("\n")

    def add_element(self, element: Any, indent: str, escape_options: dict[str, bool]) -> None:
        """Add an element with all that is in it, as the library's ``fixed_writexml`` does."""
        write = self.write
        self.spans.append(span_of(element))
        self.lines.append(self._line)
        self.names.add(element.tagName)
        write(f"{indent}<{element.tagName}")
        attributes = element._get_attributes()
        for name in sorted(attributes.keys()):
            write(f' {name}="')
            value = attributes[name].value
            if not isinstance(value, str):
                raise UnwritableError(element, name, value)
            minidom._write_data(self, value, **escape_options)  # type: ignore[attr-defined]
            write('"')
        children = element.childNodes
        if not children:
            write("/>\n")
        elif len(children) == 1 and children[0].nodeType == Node.TEXT_NODE:
            write(">")
            children[0].writexml(self, "", "", "")
            write(f"</{element.tagName}>\n")
        else:
            write(">\n")
            for node in children:
                self._add_child(node, indent + _INDENT, escape_options)
            write(f"{indent}</{element.tagName}>\n")

    def _add_child(self, node: Any, indent: str, escape_options: dict[str, bool]) -> None:
        if node.nodeType == Node.ELEMENT_NODE:
            self.add_element(node, indent, escape_options)
            return
        if node.nodeType == Node.TEXT_NODE and (not node.data or node.data.isspace()):
            return
        if node.nodeType == Node.CDATA_SECTION_NODE and "${" in node.data:
            self.unexpanded.append(span_of(node.parentNode))
        node.writexml(self, indent, _INDENT, "\n")


def written(document: Any) -> Written:
    """Write a document byte for byte as ``document.toprettyxml(indent="  ")`` does."""
    from xacro import xmlutils

    result = Written()
    result.write(minidom.Document().toprettyxml(indent=_INDENT))
    for node in document.childNodes:
        if node.nodeType == Node.ELEMENT_NODE:
            result.add_element(node, "", xmlutils._WRITE_DATA_EXTRA_KWARGS)
        else:
            node.writexml(result, "", _INDENT, "\n")
    return result
