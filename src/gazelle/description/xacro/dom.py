"""DOM documents whose elements know where they were written and how they came to be there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import FrameType
from typing import Any, NamedTuple
from xml.dom import expatbuilder, minidom

from gazelle.description.xacro.error_recovery import RerunPatches
from gazelle.diagnostics import SourceSpan

__all__ = ["EntityRefusedError", "Tracker", "node_in", "span_of"]

_KEY = "gazelle:place"
# A stack of hundreds of calls says no more than its innermost part.
_MAX_DEPTH = 12


class EntityRefusedError(Exception):
    """The document declares an entity."""

    def __init__(self, name: str, line: int, column: int) -> None:
        self.name = name
        self.line = line
        self.column = column
        super().__init__(f"entity '{name}' is refused")


class Tracker:
    """Parses files into DOM documents and stamps every element with its place.

    Attributes:
        calls: places of the includes and macro calls being worked on, outermost first.
        files: the files parsed, in order.
        on_copy: called for each element that is copied.
    """

    def __init__(self, patches: RerunPatches) -> None:
        self.calls: list[SourceSpan] = []
        self.on_copy: Callable[[], None] = _ignored
        self.files: list[str] = []
        self._repairs = patches
        self._via: tuple[SourceSpan, ...] = ()
        self._paths: list[tuple[SourceSpan, ...]] = []

    def parse(self, text: str | bytes, file: str) -> minidom.Document:
        """Parse a document.

        Args:
            text: the document.
            file: name for the places.

        Raises:
            xml.parsers.expat.ExpatError: it is not well-formed.
            EntityRefusedError: it declares an entity.
        """
        self.files.append(file)
        builder = _Builder(self, file)
        document: minidom.Document = builder.parseString(text)
        for element, span in builder.elements if self._repairs.touch(file) else ():
            self._repairs.apply(element, span)
        return document

    def enter(self, span: SourceSpan) -> None:
        """Note that the include or macro call at a place is being worked on from here on."""
        self.calls.append(span)
        # A call by name is worked on twice, by the library's two functions for it; a macro that
        # calls itself again and again says so once.
        repeated = self._via[:1] == (span,)
        self._paths.append(self._via)
        self._via = self._via if repeated else (span, *self._via[: _MAX_DEPTH - 1])

    def leave(self) -> None:
        """Note that the innermost include or macro call has been worked on."""
        self.calls.pop()
        self._via = self._paths.pop()

    def stamp(self, element: Any, base: SourceSpan, via: tuple[SourceSpan, ...]) -> None:
        """Note where an element stands; copies of it get the calls of their own time."""
        element.setUserData(_KEY, _Stamp(base, via), self)

    def handle(self, _operation: int, _key: str, stamp: _Stamp, _source: Any, copy: Any) -> None:
        """Stamp a copy that minidom has just made of a stamped element."""
        if copy is not None:
            self.on_copy()
            copy.setUserData(_KEY, _Stamp(stamp.base, self._via or stamp.via), self)

    def via(self) -> tuple[SourceSpan, ...]:
        """Return the calls being worked on, innermost first."""
        return self._via


def span_of(node: Any) -> SourceSpan | None:
    """Return where a node, or the nearest element around it, was written."""
    while node is not None:
        stamp = node.getUserData(_KEY) if node.nodeType == minidom.Node.ELEMENT_NODE else None
        if stamp is not None:
            base: SourceSpan = stamp.base
            return replace(base, via=stamp.via) if stamp.via else base
        node = node.parentNode
    return None


def node_in(frame: FrameType) -> Any:
    """Return the DOM node that a function of the library works on in this frame, or None."""
    for name in ("node", "elt", "tag", "element"):
        found = frame.f_locals.get(name)
        if isinstance(found, minidom.Node):
            return found
    return None


class _Stamp(NamedTuple):
    """What is stored with an element: the start tag's place, and the calls that copied it."""

    base: SourceSpan
    via: tuple[SourceSpan, ...]


def _ignored() -> None:
    """Hear of a copy."""


class _Builder(expatbuilder.ExpatBuilderNS):
    """minidom's own builder, so that the document is the one xacro expects, plus places."""

    def __init__(self, tracker: Tracker, file: str) -> None:
        super().__init__()
        self.elements: list[tuple[Any, SourceSpan]] = []
        self._tracker = tracker
        self._file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        parser = self.getParser()
        line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
        base = SourceSpan(self._file, line, column, len(element.tagName) + 1)
        self.elements.append((element, base))
        self._tracker.stamp(element, base, self._tracker.via())

    def entity_decl_handler(self, entity: str, *_rest: Any) -> None:
        parser = self.getParser()
        raise EntityRefusedError(entity, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
