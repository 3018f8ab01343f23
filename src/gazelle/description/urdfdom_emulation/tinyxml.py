"""Elements as TinyXML 2.6 reads them, the parser below urdfdom 3.

It knows less than XML asks for and forgives other things: values may stand without quotes, line
breaks in values stay line breaks, a DOCTYPE is skipped up to its first ``>``, whatever follows
the outermost element is not looked at. What a file means to ``check_urdf`` depends on it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from gazelle.description.xml import Tag

__all__ = ["Element", "TinyXmlError", "element_of", "parse_tinyxml"]

_SPACE = re.compile(r"[ \t\n\v\f\r]*")
_NAME = re.compile(r"[A-Za-z_\x7f-\U0010ffff][\w\-.:\x7f-\U0010ffff]*", re.ASCII)
_BARE_VALUE = re.compile(r"[^ \t\n\v\f\r/>]*")
_REFERENCE = re.compile(r"&(?:#x([0-9A-Fa-f]+);|#([0-9]+);|(amp|lt|gt|quot|apos);|(#)|)")
_NAMED = {"amp": "&", "lt": "<", "gt": ">", "quot": '"', "apos": "'"}
_CDATA = "<![CDATA["

_EMPTY = "Error document empty."
_ELEMENT = "Error parsing Element."
_NO_NAME = "Failed to read Element name"
_VALUE = "Error reading Element value."
_ATTRIBUTES = "Error reading Attributes."
_EMPTY_TAG = "Error: empty tag."
_END_TAG = "Error reading end tag."


class TinyXmlError(Exception):
    """The text is no document to TinyXML; the message is TinyXML's own."""


@dataclass(slots=True)
class Element:
    """An element; text and comments inside are not kept, nobody here asks for them."""

    name: str
    attributes: dict[str, str] = field(default_factory=dict)
    children: list[Element] = field(default_factory=list)

    def first(self, name: str) -> Element | None:
        """Return the first child of this name."""
        return next((child for child in self.children if child.name == name), None)

    def all(self, name: str) -> list[Element]:
        """Return all children of this name."""
        return [child for child in self.children if child.name == name]


def element_of(root: Tag) -> Element:
    """Return a tag as what urdfdom's parser makes of it."""
    top = Element(root.name, root.attributes)
    waiting = [(root, top)]
    while waiting:
        source, target = waiting.pop()
        for child in source.children:
            made = Element(child.name, child.attributes)
            target.children.append(made)
            if child.name != "gazebo":
                waiting.append((child, made))
    return top


def parse_tinyxml(text: str) -> list[Element]:
    """Return a document's outermost elements, of which it may have several.

    Raises:
        TinyXmlError: as the class says.
    """
    scanner = _Scanner(text.partition("\0")[0].removeprefix("\ufeff"))
    return scanner.document()


class _Scanner:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0

    def document(self) -> list[Element]:
        top: list[Element] = []
        is_empty = True
        self._skip_space()
        while self._sees("<"):
            is_empty = False
            if self._starts_element():
                top.append(self._element())
            elif not self._skip_other():
                break
            self._skip_space()
        if is_empty:
            raise TinyXmlError(_EMPTY)
        return top

    def _element(self) -> Element:
        """Read an element with all below it; the nesting is on a list, not on Python's stack."""
        root, is_open = self._start_tag()
        path = [root] if is_open else []
        while path:
            self._to_markup()
            if self._sees("</"):
                self._end_tag(path.pop().name)
            elif self._starts_element():
                child, is_open = self._start_tag()
                path[-1].children.append(child)
                if is_open:
                    path.append(child)
            elif not self._skip_other():
                raise TinyXmlError(_VALUE)
        return root

    def _to_markup(self) -> None:
        """Go on to the next ``<`` of an element's content."""
        if self._at == len(self._text):
            raise TinyXmlError(_VALUE)
        self._skip_space()
        if self._at == len(self._text):
            raise TinyXmlError(_END_TAG)
        end = self._text.find("<", self._at)
        if end < 0 or _resolved(self._text[self._at : end]) is None:
            raise TinyXmlError(_VALUE)
        self._at = end

    def _start_tag(self) -> tuple[Element, bool]:
        self._at += 1
        name = self._name()
        if name is None or self._at == len(self._text):
            raise TinyXmlError(_NO_NAME)
        element = Element(name)
        while True:
            self._skip_space()
            if self._sees("/"):
                if not self._sees("/>"):
                    raise TinyXmlError(_EMPTY_TAG)
                self._at += 2
                return element, False
            if self._sees(">"):
                self._at += 1
                return element, True
            key, value = self._attribute()
            if key in element.attributes or self._at == len(self._text):
                raise TinyXmlError(_ELEMENT)
            element.attributes[key] = value

    def _end_tag(self, name: str) -> None:
        if not self._sees(f"</{name}"):
            raise TinyXmlError(_END_TAG)
        self._at += len(name) + 2
        self._skip_space()
        if not self._sees(">"):
            raise TinyXmlError(_END_TAG)
        self._at += 1

    def _attribute(self) -> tuple[str, str]:
        name = self._name()
        self._skip_space()
        if name is None or not self._sees("="):
            raise TinyXmlError(_ATTRIBUTES)
        self._at += 1
        self._skip_space()
        quote = self._text[self._at : self._at + 1]
        if not quote:
            raise TinyXmlError(_ATTRIBUTES)
        return name, self._quoted(quote) if quote in "\"'" else self._bare()

    def _quoted(self, quote: str) -> str:
        start = self._at + 1
        end = self._text.find(quote, start)
        value = _resolved(self._text[start:end]) if end >= 0 else None
        if value is None:
            raise TinyXmlError(_ELEMENT)
        self._at = end + 1
        return value

    def _bare(self) -> str:
        value = self._match(_BARE_VALUE)
        if '"' in value or "'" in value:
            raise TinyXmlError(_ATTRIBUTES)
        return value

    def _skip_other(self) -> bool:
        """Skip a comment, CDATA, declaration or unknown; False when the text ends inside."""
        text, at = self._text, self._at
        if text[at : at + 5].lower() == "<?xml":
            return self._skip_past(">")
        if self._sees(_CDATA):
            return self._skip_past("]]>") and self._at < len(text)
        if not self._skip_past("-->" if self._sees("<!--") else ">"):
            self._at = len(text)
        return True

    def _skip_past(self, mark: str) -> bool:
        start = self._at + (4 if mark == "-->" else 1)
        end = self._text.find(mark, start)
        self._at = self._at if end < 0 else end + len(mark)
        return end >= 0

    def _starts_element(self) -> bool:
        return self._sees("<") and _NAME.match(self._text, self._at + 1) is not None

    def _name(self) -> str | None:
        return self._match(_NAME) or None

    def _match(self, pattern: re.Pattern[str]) -> str:
        found = pattern.match(self._text, self._at)
        if found is None:
            return ""
        self._at = found.end()
        return found[0]

    def _skip_space(self) -> None:
        self._match(_SPACE)

    def _sees(self, mark: str) -> bool:
        return self._text.startswith(mark, self._at)


def _resolved(raw: str) -> str | None:
    """Return a text with its references resolved; None when a number in one is broken.

    An ``&`` that starts none is lost: ``a&b`` is read as ``ab``.
    """
    if "&" not in raw:
        return raw
    if any(found[4] for found in _REFERENCE.finditer(raw)):
        return None
    return _REFERENCE.sub(_character, raw)


def _character(found: re.Match[str]) -> str:
    hexadecimal, decimal, name, _ = found.groups()
    if name:
        return _NAMED[name]
    if not hexadecimal and not decimal:
        return ""
    code = int(hexadecimal[:9], 16) if hexadecimal else int(decimal[:12])
    return chr(code) if code < 0x110000 else "\ufffd"
