"""XML text to `Tag`s, with line and column, without entities and without network."""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, NamedTuple
from xml.parsers import expat

from gazelle.description.xml.tag import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import TEXT_BYTES, FileLimitError, LimitError, read_limited, scaled
from gazelle.documents.malformed_xml import malformed_xml

__all__ = ["parse_xml", "read_data", "read_xml", "remembering_documents", "too_much_in"]

_MAX_ELEMENTS = 500_000
_MAX_ATTRIBUTES = 1000
# Readers go down element by element; Python itself allows a thousand calls.
_MAX_DEPTH = 100
_FORGIVEN = "this is no XML: '--' in a comment, a bare '&' or something before <?xml …?>"
_COMMENT = re.compile(rb"<!--(.*?)-->", re.DOTALL)
_LATE_DECLARATION = re.compile(rb"(?<=\S)\s*<\?xml\s[^>]{0,200}\?>")
_BARE_AND = re.compile(rb"&(?!#\d+;|#x[0-9A-Fa-f]+;|[A-Za-z_][\w.-]*;)")
_MOST_REMEMBERED = 64
_REMEMBERED_BYTES = 16_000_000


class _Outcome(NamedTuple):
    root: Tag | None
    found: Diagnostics


class _Remembered:
    """Documents that have been parsed, the newest last."""

    def __init__(self) -> None:
        self._outcomes: OrderedDict[tuple[str, str | None, bytes], _Outcome] = OrderedDict()
        self._bytes = 0

    def outcome(self, data: bytes, encoding: str | None, file: str) -> _Outcome:
        key = file, encoding, data
        known = self._outcomes.get(key)
        if known is None:
            found = Diagnostics()
            known = _Outcome(_parsed_or_reported(data, encoding, file, found), found)
            self._outcomes[key] = known
            self._bytes += len(data)
        self._outcomes.move_to_end(key)
        while len(self._outcomes) > _MOST_REMEMBERED or self._bytes > _REMEMBERED_BYTES:
            (_file, _encoding, oldest), _outcome = self._outcomes.popitem(last=False)
            self._bytes -= len(oldest)
        return known


_remembered: ContextVar[_Remembered | None] = ContextVar("remembered documents", default=None)


@contextmanager
def remembering_documents() -> Iterator[None]:
    """Parse the same text of the same file once within a ``with`` block.

    For who looks at files in several ways, one after the other. What is wrong with a document is
    told each time.
    """
    token = _remembered.set(_Remembered())
    try:
        yield
    finally:
        _remembered.reset(token)


def read_xml(path: Path, diagnostics: Diagnostics) -> Tag | None:
    """Read a file and parse it; None (and an error reported) when that is impossible."""
    data = read_data(path, diagnostics)
    return None if data is None else parse_xml(data, str(path), diagnostics)


def read_data(path: Path, diagnostics: Diagnostics) -> bytes | None:
    """Return a document's bytes; None (and an error reported) when it cannot be read.

    Args:
        path: a file, or a pipe, which can be read only once.
        diagnostics: receives ``xml.unreadable`` or ``limits.file-size``.
    """
    try:
        return read_limited(path, TEXT_BYTES)
    except FileLimitError as error:
        message = f"'{path}' is not read: {error.reason}"
        diagnostics.report("limits.file-size", message, SourceSpan(str(path)))
    except OSError as error:
        reason = error.strerror or str(error)
        diagnostics.report(
            "xml.unreadable", f"cannot read '{path}': {reason}", SourceSpan(str(path))
        )
    return None


def parse_xml(text: str | bytes, file: str, diagnostics: Diagnostics) -> Tag | None:
    """Parse a document; None (and an error reported) when it is not well-formed.

    Args:
        text: the document; bytes follow their XML declaration's encoding.
        file: name for the spans.
        diagnostics: receives ``xml.malformed``, ``xml.entity``, ``xml.lenient`` or
            ``limits.elements``.
    """
    # A str is already decoded; an encoding named in its declaration no longer applies.
    encoding = "utf-8" if isinstance(text, str) else None
    # Half a surrogate pair is no character; expat says where it stands.
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    remembered = _remembered.get()
    if remembered is None:
        return _parsed_or_reported(data, encoding, file, diagnostics)
    root, found = remembered.outcome(data, encoding, file)
    diagnostics.extend(found)
    return root


def too_much_in(data: bytes) -> str:
    """Return why a document is too large to be read, empty when it is not.

    Its tags are counted, which is much sooner done than reading half of it.
    """
    if len(data) > scaled(TEXT_BYTES):
        return f"the document has {len(data)} bytes, the limit is {scaled(TEXT_BYTES)}"
    most = scaled(_MAX_ELEMENTS)
    # In UTF-16 end tags look different; there the elements are counted one by one.
    if data.count(b"<") > most and b"\0" not in data[:16]:
        count = data.count(b"<") - sum(data.count(word) for word in (b"</", b"<!", b"<?"))
        if count > most:
            return f"the document has {count} elements, the limit is {most}"
    return ""


def _parsed_or_reported(
    data: bytes, encoding: str | None, file: str, diagnostics: Diagnostics
) -> Tag | None:
    try:
        if reason := too_much_in(data):
            raise _TooMuchError(reason, SourceSpan(file))
        return _parsed_or_repaired(data, encoding, file, diagnostics)
    except expat.ExpatError as error:
        found = malformed_xml(data, error)
        span = SourceSpan(file, found.line, found.column)
        diagnostics.report("xml.malformed", found.message, span, fix=found.fix)
    except (LookupError, ValueError) as error:
        # Python's own words about an encoding that is unknown or of several bytes.
        message = f"not well-formed XML: {error}"
        diagnostics.report("xml.malformed", message, SourceSpan(file, 1, 1))
    except _EntityError as error:
        diagnostics.report("xml.entity", f"entity '{error.name}' is refused", error.span)
    except _TooMuchError as error:
        diagnostics.report("limits.elements", str(error), error.span)
    return None


def _parsed_or_repaired(
    data: bytes, encoding: str | None, file: str, diagnostics: Diagnostics
) -> Tag | None:
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


def _parsed(data: bytes, encoding: str | None, file: str) -> Tag | None:
    builder = _Builder(file)
    builder.parse(data, encoding)
    return builder.root


def _repaired(data: bytes) -> bytes:
    """Return a document with what TinyXML, the parser of Gazebo and urdfdom, lets pass.

    These are ``--`` inside comments, as in command lines that worlds quote, ``&`` that starts no
    reference, and a licence before the declaration. Lines stay where they are.
    """
    # Behind the last '-->' no comment ends, and looking for the end of each would take for ever.
    end = data.rfind(b"-->") + 3
    quiet = (
        _COMMENT.sub(lambda found: b"<!--%b-->" % found[1].replace(b"-", b" "), data[: max(end, 0)])
        + data[max(end, 0) :]
    )
    quiet = _LATE_DECLARATION.sub(lambda found: re.sub(rb"[^\n]", b" ", found[0]), quiet)
    return _BARE_AND.sub(b"&amp;", quiet)


class _EntityError(Exception):
    def __init__(self, name: str, span: SourceSpan) -> None:
        self.name = name
        self.span = span
        super().__init__(name)


class _TooMuchError(LimitError):
    def __init__(self, text: str, span: SourceSpan) -> None:
        self.span = span
        super().__init__(text)


class _Open:
    """An element whose end tag has not been seen yet."""

    __slots__ = ("attributes", "children", "name", "span", "text")

    def __init__(self, name: str, attributes: dict[str, str], span: SourceSpan) -> None:
        self.name = name
        self.attributes = attributes
        self.span = span
        self.children: list[Tag] = []
        self.text: list[str] = []

    def close(self) -> Tag:
        if not self.text:
            return Tag(self.name, self.span, self.attributes)
        parted = "".join(self.text)
        raw = parted.replace("\0", "")
        text = raw.strip()
        if text and self.children:
            text = " ".join(part for part in map(str.strip, parted.split("\0")) if part)
        return Tag(self.name, self.span, self.attributes, tuple(self.children), text, raw)


class _Builder:
    def __init__(self, file: str) -> None:
        self.root: Tag | None = None
        self._file = file
        self._stack: list[_Open] = []
        self._parser: Any = None
        self._line_shift = 0
        self._left = scaled(_MAX_ELEMENTS)
        self._most_attributes = scaled(_MAX_ATTRIBUTES)

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
        parser = self._parser
        line = parser.CurrentLineNumber + self._line_shift
        return SourceSpan(self._file, line, parser.CurrentColumnNumber + 1, length)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        stack = self._stack
        span = self._span(len(name) + 1)
        self._left -= 1
        if self._left < 0 or len(stack) >= _MAX_DEPTH or len(attributes) > self._most_attributes:
            raise self._too_much(name, attributes, span)
        stack.append(_Open(name, attributes, span))

    def _too_much(self, name: str, attributes: dict[str, str], span: SourceSpan) -> _TooMuchError:
        if len(self._stack) >= _MAX_DEPTH:
            return _TooMuchError(f"<{name}> is nested deeper than {_MAX_DEPTH} elements", span)
        if self._left < 0:
            text = f"the document has more than {scaled(_MAX_ELEMENTS)} elements"
        else:
            text = f"<{name}> has {len(attributes)} attributes, the limit is "
            text += str(self._most_attributes)
        return _TooMuchError(text, span)

    def _end(self, _name: str) -> None:
        stack = self._stack
        tag = stack.pop().close()
        if stack:
            around = stack[-1]
            around.children.append(tag)
            around.text.append("\0")
        else:
            self.root = tag

    def _text(self, data: str) -> None:
        self._stack[-1].text.append(data)

    def _entity(self, name: str, *_rest: Any) -> None:
        raise _EntityError(name, self._span())
