"""What a failed run is repeated with, so that the problems behind the first one are found too."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from gazelle.diagnostics import SourceSpan

__all__ = ["UNKNOWN", "UNKNOWN_NAME", "RerunPatches", "Unknown"]

UNKNOWN_NAME = "gazelle_unknown"
_STAND_IN = f"${{{UNKNOWN_NAME}}}"
_TEXT = "#text"

SpanKey = tuple[str, int, int]


class Unknown:
    """A value that nobody knows: every operation with it is possible and gives one again."""

    def _same(self, *_arguments: Any, **_options: Any) -> Unknown:
        return self

    def __getattr__(self, name: str) -> Unknown:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __str__(self) -> str:
        return "0"

    def __bool__(self) -> bool:
        return False

    def __int__(self) -> int:
        return 0

    def __float__(self) -> float:
        return 0.0

    def __len__(self) -> int:
        return 0

    def __iter__(self) -> Any:
        return iter(())

    def __contains__(self, _item: object) -> bool:
        return False

    def __hash__(self) -> int:
        return 0

    def __eq__(self, other: object) -> Any:
        return self

    __call__ = __getitem__ = __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _same
    __truediv__ = __rtruediv__ = __floordiv__ = __rfloordiv__ = __mod__ = __rmod__ = _same
    __pow__ = __rpow__ = __neg__ = __pos__ = __abs__ = __round__ = _same
    __lt__ = __le__ = __gt__ = __ge__ = __ne__ = _same  # type: ignore[assignment]
    __index__ = __int__


UNKNOWN = Unknown()


@dataclass
class RerunPatches:
    """What is taken out of the files, by place, and which names are taken as defined.

    Attributes:
        names: names that are defined as `Unknown`.
        suspects: names of macros and arguments whose definition was taken out.
        is_incomplete: an include was taken out, which may have defined anything.
    """

    names: set[str] = field(default_factory=set)
    suspects: set[str] = field(default_factory=set)
    is_incomplete: bool = False
    _parts: dict[SpanKey, list[tuple[str, str]]] = field(default_factory=dict)
    _removed: set[SpanKey] = field(default_factory=set)

    def touch(self, file: str) -> bool:
        """Tell whether anything of a file is changed."""
        return any(span[0] == file for span in [*self._parts, *self._removed])

    def replace_part(self, span: SourceSpan, attribute: str, part: str) -> bool:
        """Put an unknown value in place of an expression; False when that was done before.

        Args:
            span: of the element.
            attribute: the attribute that holds the expression; empty for the element's text.
            part: the expression with its brackets; all of the value when empty.
        """
        parts = self._parts.setdefault(_key(span), [])
        if (attribute or _TEXT, part) in parts:
            return False
        parts.append((attribute or _TEXT, part))
        return True

    def remove(self, span: SourceSpan) -> bool:
        """Take an element out; False when that was done before."""
        if _key(span) in self._removed:
            return False
        self._removed.add(_key(span))
        return True

    def apply(self, element: Any, span: SourceSpan) -> None:
        """Change an element that has just been parsed."""
        key = _key(span)
        for attribute, part in self._parts.get(key, ()):
            if attribute == _TEXT:
                _replace_in_texts(element, part)
            elif element.hasAttribute(attribute):
                value = element.getAttribute(attribute)
                replaced = value.replace(part, _STAND_IN) if part in value and part else _STAND_IN
                element.setAttribute(attribute, replaced)
        if key in self._removed and element.parentNode.nodeType == element.ELEMENT_NODE:
            element.parentNode.removeChild(element)


def _replace_in_texts(element: Any, part: str) -> None:
    for child in element.childNodes:
        if hasattr(child, "data"):
            child.data = child.data.replace(part, _STAND_IN)


def _key(span: SourceSpan) -> SpanKey:
    return span.file, span.line, span.column
