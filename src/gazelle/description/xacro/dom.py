"""DOM documents whose elements know where they were written and how they came to be there."""

from __future__ import annotations

from dataclasses import replace
from types import FrameType
from typing import Any, NamedTuple
from xml.dom import expatbuilder, minidom

from gazelle.diagnostics import SourceSpan

__all__ = ["EntityRefusedError", "Tracker", "node_in", "place_of"]

_KEY = "gazelle:place"


class EntityRefusedError(Exception):
    """The document declares an entity."""

    def __init__(self, name: str, line: int, column: int) -> None:
        self.name = name
        self.line = line
        self.column = column
        super().__init__(f"entity '{name}' is refused")


class _Stamp(NamedTuple):
    """What is stored with an element."""

    span: SourceSpan


class Tracker:
    """Parses files into DOM documents and stamps every element with its place.

    Attributes:
        calls: places of the includes and macro calls being worked on, outermost first.
    """

    def __init__(self) -> None:
        self.calls: list[SourceSpan] = []

    def parse_file(self, stream: Any, file: str) -> minidom.Document:
        """Parse an open file.

        Raises:
            xml.parsers.expat.ExpatError: it is not well-formed.
            EntityRefusedError: it declares an entity.
        """
        return _Builder(self, file).parseFile(stream)

    def parse_text(self, text: str | bytes, file: str) -> minidom.Document:
        """Parse a text; errors as in `parse_file`."""
        return _Builder(self, file).parseString(text)

    def stamp(self, element: Any, span: SourceSpan) -> None:
        """Note where an element stands; copies of it get the calls of their own time."""
        element.setUserData(_KEY, _Stamp(span), self)

    def handle(self, _operation: int, _key: str, stamp: _Stamp, _source: Any, copy: Any) -> None:
        """Stamp a copy that minidom has just made of a stamped element."""
        if copy is not None:
            self.stamp(copy, replace(stamp.span, via=self.via() or stamp.span.via))

    def via(self) -> tuple[SourceSpan, ...]:
        """Return the calls being worked on, innermost first."""
        return tuple(reversed(self.calls))


def place_of(node: Any) -> SourceSpan | None:
    """Return where a node, or the nearest element around it, was written."""
    while node is not None:
        stamp = node.getUserData(_KEY) if node.nodeType == minidom.Node.ELEMENT_NODE else None
        if stamp is not None:
            found: SourceSpan = stamp.span
            return found
        node = node.parentNode
    return None


def node_in(frame: FrameType) -> Any:
    """Return the DOM node that a function of the library works on in this frame, or None."""
    for name in ("node", "elt", "tag", "element"):
        found = frame.f_locals.get(name)
        if isinstance(found, minidom.Node):
            return found
    return None


class _Builder(expatbuilder.ExpatBuilderNS):
    """minidom's own builder, so that the document is the one xacro expects, plus places."""

    def __init__(self, tracker: Tracker, file: str) -> None:
        super().__init__()
        self._tracker = tracker
        self._file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        parser = self.getParser()
        span = SourceSpan(
            self._file,
            parser.CurrentLineNumber,
            parser.CurrentColumnNumber + 1,
            len(element.tagName) + 1,
            self._tracker.via(),
        )
        self._tracker.stamp(element, span)

    def entity_decl_handler(self, entity: str, *_rest: Any) -> None:
        parser = self.getParser()
        raise EntityRefusedError(entity, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
