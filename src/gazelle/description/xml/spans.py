"""Places inside a start tag or a text, looked up in the file only when somebody asks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache
from html import unescape
from pathlib import Path
from typing import NamedTuple

from gazelle.description.xml.tag import Tag
from gazelle.diagnostics import SourceSpan
from gazelle.documents import TEXT_BYTES, read_limited

__all__ = [
    "attribute_holding",
    "attribute_span",
    "text_span",
    "with_spans",
    "written_attributes",
]

_NAME = re.compile(r"<[^\s/>]+")
_ATTRIBUTE = re.compile(r"\s+([^\s=/>]+)\s*=\s*(\"[^\"]*\"|'[^']*')")
_PIECE = re.compile(r"&(?:#\d+|#x[0-9A-Fa-f]+|lt|gt|amp|quot|apos);|.", re.DOTALL)
_TOKEN = re.compile(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|</[^>]*>"
    r"|<(?:[^<>\"']|\"[^\"]*\"|'[^']*')*>|[^<]+",
    re.DOTALL,
)


class _Raw(NamedTuple):
    """An attribute as it stands in the file: offsets of its name and of its value."""

    name: str
    start: int
    value_start: int
    value: str


def attribute_span(
    span: SourceSpan, name: str, part: str = "", *, whole: bool = False
) -> SourceSpan:
    """Return the place of an attribute's value, or of a part of it.

    Args:
        span: place of the element's start tag.
        name: the attribute.
        part: text inside the value that is meant; the value when empty or not found there.
        whole: return the place of ``name="value"``.

    Returns:
        The place with the way there of `span`; `span` itself when the file has changed, is no
        file, or the tag has no such attribute.
    """
    source = _source(span.file)
    for raw in _attributes(source, span):
        if raw.name == name:
            if whole:
                length = raw.value_start + len(raw.value) + 1 - raw.start
                return _at(source, span, raw.start, length)
            start, length = _found(raw.value, part)
            return _at(source, span, raw.value_start + start, length)
    return span


def attribute_holding(span: SourceSpan, text: str) -> str:
    """Return the name of the attribute whose value is this text, empty when none is."""
    found = (name for name, value in written_attributes(span).items() if value == text)
    return next(found, "")


def written_attributes(span: SourceSpan) -> dict[str, str]:
    """Return the attributes of the start tag at a place, as the file has them now."""
    return {raw.name: _plain(raw.value) for raw in _attributes(_source(span.file), span)}


def text_span(span: SourceSpan, part: str) -> SourceSpan:
    """Return the place of a part of the text directly inside an element.

    Args:
        span: place of the element's start tag.
        part: what is looked for, without entities.

    Returns:
        The place; `span` when the element has no such text.
    """
    source = _source(span.file)
    for start, token in _own_texts(source, _offset(source, span)):
        offset, length = _found(token, part)
        if length < len(token) or _plain(token) == part:
            return _at(source, span, start + offset, length)
    return span


def with_spans(root: Tag, spans: Iterable[SourceSpan | None]) -> Tag:
    """Return a tree whose elements stand elsewhere.

    Args:
        root: the tree.
        spans: one for each element in document order; None keeps the element's own.
    """
    return _with_spans(root, iter(spans))


def _with_spans(tag: Tag, spans: Iterator[SourceSpan | None]) -> Tag:
    span = next(spans, None) or tag.span
    children = tuple(_with_spans(child, spans) for child in tag.children)
    return replace(tag, span=span, children=children)


def _source(file: str) -> str:
    try:
        state = Path(file).stat()
    except (OSError, ValueError):
        return ""
    return _source_at(file, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=4)
def _source_at(file: str, _mtime_ns: int, _size: int) -> str:
    """Read a file once for all the findings about it."""
    try:
        data = read_limited(file, TEXT_BYTES)
    except (OSError, ValueError):
        return ""
    return data.decode("utf-8-sig", errors="replace").replace("\r\n", "\n")


def _offset(source: str, span: SourceSpan) -> int:
    """Return where a place is in the text, -1 when no start tag is there."""
    offset = 0
    for _ in range(span.line - 1):
        offset = source.find("\n", offset) + 1
        if not offset:
            return -1
    offset += span.column - 1
    return offset if span.line and span.column and source[offset : offset + 1] == "<" else -1


def _attributes(source: str, span: SourceSpan) -> Iterator[_Raw]:
    offset = _offset(source, span)
    name = _NAME.match(source, offset) if offset >= 0 else None
    position = name.end() if name else len(source)
    while found := _ATTRIBUTE.match(source, position):
        yield _Raw(found[1], found.start(1), found.start(2) + 1, found[2][1:-1])
        position = found.end()


def _own_texts(source: str, offset: int) -> Iterator[tuple[int, str]]:
    """Yield the texts and comments that are children of the element at an offset."""
    depth = 0
    while offset >= 0 and (token := _TOKEN.match(source, offset)):
        text = token[0]
        if depth == 1 and (text.startswith(("<!--", "<![CDATA[")) or not text.startswith("<")):
            yield token.start(), text
        elif text.startswith("</"):
            depth -= 1
        elif text.startswith("<") and text[1] not in "!?" and not text.endswith("/>"):
            depth += 1
        offset = token.end() if depth > 0 else -1


def _plain(raw: str) -> str:
    return "".join(_character(piece) for piece in _PIECE.findall(raw))


def _character(piece: str) -> str:
    # XML makes a space of every line end and tab in an attribute.
    return unescape(piece) if len(piece) > 1 else " " if piece in "\n\t" else piece


def _found(raw: str, part: str) -> tuple[int, int]:
    """Return offset and length of a part in raw text; all of it when it is not there."""
    pieces = _PIECE.findall(raw)
    wanted = "".join(" " if letter in "\n\t" else letter for letter in part)
    index = "".join(map(_character, pieces)).find(wanted) if part else -1
    if index < 0:
        return 0, len(raw)
    before = sum(map(len, pieces[:index]))
    return before, sum(map(len, pieces[index : index + len(wanted)]))


def _at(source: str, span: SourceSpan, offset: int, length: int) -> SourceSpan:
    line = source.count("\n", 0, offset) + 1
    column = offset - (source.rfind("\n", 0, offset) + 1) + 1
    end = source.find("\n", offset)
    on_line = (len(source) if end < 0 else end) - offset
    return replace(span, line=line, column=column, length=max(1, min(length, on_line)))
