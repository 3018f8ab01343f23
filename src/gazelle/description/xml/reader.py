"""XML text to `Tag`s, with line and column, without entities and without network."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from xml.parsers import expat

from gazelle.description.xml.tag import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["parse_xml", "read_xml"]

_FORGIVEN = "this is no XML: '--' in a comment, a bare '&' or something before <?xml …?>"
_COMMENT = re.compile(rb"<!--(.*?)-->", re.DOTALL)
_LATE_DECLARATION = re.compile(rb"(?<=\S)\s*<\?xml\s[^>]*\?>")
_BARE_AND = re.compile(rb"&(?!#\d+;|#x[0-9A-Fa-f]+;|[A-Za-z_][\w.-]*;)")


def read_xml(path: Path, diagnostics: Diagnostics) -> Tag | None:
    """Read a file and parse it; None (and an error reported) when that is impossible."""
    try:
        data = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        diagnostics.report(
            "xml.unreadable", f"cannot read '{path}': {reason}", SourceSpan(str(path))
        )
        return None
    return parse_xml(data, str(path), diagnostics)


def parse_xml(text: str | bytes, file: str, diagnostics: Diagnostics) -> Tag | None:
    """Parse a document; None (and an error reported) when it is not well-formed.

    Args:
        text: the document; bytes follow their XML declaration's encoding.
        file: name for the spans.
        diagnostics: receives ``xml.malformed``, ``xml.entity`` or ``xml.lenient``.
    """
    data = text.encode("utf-8") if isinstance(text, str) else text
    # A str is already decoded; an encoding named in its declaration no longer applies.
    encoding = "utf-8" if isinstance(text, str) else None
    try:
        try:
            return _parsed(data, encoding, file)
        except expat.ExpatError as error:
            repaired = _repaired(data)
            if repaired == data:
                raise
            root = _parsed(repaired, encoding, file)
            span = SourceSpan(file, error.lineno, error.offset + 1)
            diagnostics.report("xml.lenient", _FORGIVEN, span)
            return root
    except expat.ExpatError as error:
        span = SourceSpan(file, error.lineno, error.offset + 1)
        message = f"not well-formed XML: {expat.ErrorString(error.code)}"
        diagnostics.report("xml.malformed", message, span)
    except _EntityError as error:
        diagnostics.report("xml.entity", f"entity '{error.name}' is refused", error.span)
    return None


def _parsed(data: bytes, encoding: str | None, file: str) -> Tag | None:
    builder = _Builder(file)
    builder.parse(data, encoding)
    return builder.root


def _repaired(data: bytes) -> bytes:
    """Return a document with what TinyXML, the parser of Gazebo and urdfdom, lets pass.

    These are ``--`` inside comments, as in command lines that worlds quote, ``&`` that starts no
    reference, and a licence before the declaration. Lines stay where they are.
    """
    quiet = _COMMENT.sub(lambda found: b"<!--%b-->" % found[1].replace(b"-", b" "), data)
    quiet = _LATE_DECLARATION.sub(lambda found: re.sub(rb"[^\n]", b" ", found[0]), quiet)
    return _BARE_AND.sub(b"&amp;", quiet)


class _EntityError(Exception):
    def __init__(self, name: str, span: SourceSpan) -> None:
        self.name = name
        self.span = span
        super().__init__(name)


class _Open:
    """An element whose end tag has not been seen yet."""

    def __init__(self, name: str, attributes: dict[str, str], span: SourceSpan) -> None:
        self.name = name
        self.attributes = attributes
        self.span = span
        self.children: list[Tag] = []
        self.text: list[str] = []

    def close(self) -> Tag:
        raw = "".join(self.text)
        text = " ".join(part for part in map(str.strip, raw.split("\0")) if part)
        children = tuple(self.children)
        return Tag(self.name, self.span, self.attributes, children, text, raw.replace("\0", ""))


class _Builder:
    def __init__(self, file: str) -> None:
        self.root: Tag | None = None
        self._file = file
        self._stack: list[_Open] = []
        self._parser: Any = None
        self._line_shift = 0

    def parse(self, text: bytes, encoding: str | None) -> None:
        self._parser = self._new_parser(encoding)
        # Leading blank lines before <?xml …?> are common in hand-made files and in launch output.
        stripped = text.lstrip(b" \t\r\n")
        self._line_shift = text[: len(text) - len(stripped)].count(b"\n")
        try:
            self._parser.Parse(stripped, True)
        except expat.ExpatError as error:
            error.lineno += self._line_shift
            raise

    def _new_parser(self, encoding: str | None) -> Any:
        # No namespace processing: robot files of 2011 use prefixes they never declare.
        parser = expat.ParserCreate(encoding)
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.EntityDeclHandler = self._entity
        return parser

    def _span(self, length: int = 0) -> SourceSpan:
        line = self._parser.CurrentLineNumber + self._line_shift
        return SourceSpan(self._file, line, self._parser.CurrentColumnNumber + 1, length)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self._stack.append(_Open(name, attributes, self._span(len(name) + 1)))

    def _end(self, _name: str) -> None:
        tag = self._stack.pop().close()
        if self._stack:
            self._stack[-1].children.append(tag)
            self._stack[-1].text.append("\0")
        else:
            self.root = tag

    def _text(self, data: str) -> None:
        self._stack[-1].text.append(data)

    def _entity(self, name: str, *_rest: Any) -> None:
        raise _EntityError(name, self._span())
