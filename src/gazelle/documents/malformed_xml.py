"""Where a document stops being XML: the tag or quote that was left open, not where it shows.

A parser stops where what it reads can no longer be right. That is often lines behind the mistake:
an element without an end is noticed at the next end of another one, a quote without its partner at
the next tag.
"""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from typing import NamedTuple
from xml.parsers.expat import ErrorString, ExpatError, errors

__all__ = ["MalformedXml", "malformed_xml"]

_MISMATCH = errors.codes[errors.XML_ERROR_TAG_MISMATCH]
_SLIP = 0.8
_NO_END = errors.codes[errors.XML_ERROR_NO_ELEMENTS]
_TOKEN = errors.codes[errors.XML_ERROR_INVALID_TOKEN]
_MARKUP = re.compile(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<[?!][^>]*>"
    r"|<(?P<end>/?)(?P<name>[^\s<>/!?\"'=]+)(?P<rest>(?:[^<>\"']|\"[^\"<]*\"|'[^'<]*')*?)(?P<empty>/?)>",
    re.DOTALL,
)


# A value that goes on to the quote that begins the next one.
_SWALLOWED = re.compile(
    r"(?P<name>[\w:.-]+)\s*=\s*(?P<quote>[\"'])(?P<value>[^\"'<>=\s]*)\s[^\"'<>]*=\s*(?P=quote)"
)


class MalformedXml(NamedTuple):
    """What is wrong with a document.

    Attributes:
        message: for the user.
        line, column: where, from 1.
        fix: what to write, or an empty string.
    """

    message: str
    line: int
    column: int
    fix: str = ""


class _Open(NamedTuple):
    name: str
    at: int


def malformed_xml(data: bytes, error: ExpatError) -> MalformedXml:
    """Explain why a document is no XML.

    Args:
        data: the document, as it was parsed.
        error: what the parser says.
    """
    plain = MalformedXml(
        f"not well-formed XML: {ErrorString(error.code)}", error.lineno, error.offset + 1
    )
    # In UTF-16 and its like a place of the parser's is none of the text's.
    if b"\0" in data[:16]:
        return plain
    text = data.decode("utf-8", errors="replace")
    stop = _offset(text, error)
    if error.code == _MISMATCH:
        return _of_mismatch(text, stop, plain)
    if error.code == _NO_END:
        return _of_end(text, plain)
    if error.code == _TOKEN:
        return _of_quote(text, stop, plain)
    return plain


def _offset(text: str, error: ExpatError) -> int:
    lines = text.split("\n")
    before = sum(len(line) + 1 for line in lines[: error.lineno - 1])
    rest = lines[error.lineno - 1] if error.lineno <= len(lines) else ""
    return before + len(rest.encode("utf-8")[: error.offset].decode("utf-8", errors="ignore"))


def _open_tags(text: str, stop: int) -> list[_Open]:
    """Return the elements that are open at a place, the innermost last."""
    open_tags: list[_Open] = []
    for found in _MARKUP.finditer(text, 0, stop):
        name = found["name"]
        if name is None or found["empty"]:
            continue
        if not found["end"]:
            open_tags.append(_Open(name, found.start()))
        elif open_tags:
            open_tags.pop()
    return open_tags


def _of_mismatch(text: str, stop: int, plain: MalformedXml) -> MalformedXml:
    begin = text.rfind("</", 0, stop + 1)
    end = re.compile(r"</([^\s<>/]*)").match(text, begin) if begin >= 0 else None
    open_tags = _open_tags(text, begin) if begin >= 0 else []
    if end is None or not open_tags:
        return plain
    name, inner = end[1], open_tags[-1]
    if all(one.name != name for one in open_tags):
        line = text.count("\n", 0, inner.at) + 1
        if _is_slip(inner.name, name) and _count(text, inner.name) < _count(text, name):
            # The name that is rarer in the file is the one that is written wrongly.
            end_line = text.count("\n", 0, begin) + 1
            message = f"{plain.message}: <{inner.name}> is ended by </{name}> of line {end_line}"
            return _at(text, inner.at, message, f"did you mean '{name}'?")
        message = f"{plain.message}: </{name}> ends nothing, <{inner.name}> of line {line} is open"
        return _at(text, begin, message, f"write </{inner.name}>")
    line = text.count("\n", 0, begin) + 1
    message = f"{plain.message}: <{inner.name}> has no end before </{name}> of line {line}"
    return _at(text, inner.at, message, _end_of(text, inner))


def _is_slip(name: str, other: str) -> bool:
    return SequenceMatcher(None, name, other).ratio() >= _SLIP


def _count(text: str, name: str) -> int:
    return len(re.findall(rf"(?<![\w-]){re.escape(name.rpartition(':')[2])}(?![\w-])", text))


def _of_end(text: str, plain: MalformedXml) -> MalformedXml:
    open_tags = _open_tags(text, len(text))
    if not open_tags:
        return plain
    inner = open_tags[-1]
    message = f"{plain.message}: <{inner.name}> has no end, and the file is over"
    return _at(text, inner.at, message, _end_of(text, inner))


def _of_quote(text: str, stop: int, plain: MalformedXml) -> MalformedXml:
    """Look for a quote that is open where the parser stopped, at a tag in a value."""
    begin = text.rfind("<", 0, stop)
    swallowed = begin >= 0 and _SWALLOWED.search(text, begin, stop + 1)
    if swallowed and swallowed.end() >= stop:
        quote, name = swallowed["quote"], swallowed["name"]
        message = f"{plain.message}: the value of {name} begins with {quote} and has no end"
        at = swallowed.start("quote")
        return _at(text, at, message, f"write {quote}{swallowed['value']}{quote}")
    if begin < 0 or text[stop : stop + 1] != "<" or text.startswith("<!--", begin):
        return plain
    opened, quote = -1, ""
    for at in range(begin, stop):
        sign = text[at]
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "\"'":
            opened, quote = at, sign
    if not quote:
        return plain
    attribute = re.search(r"([\w:.-]+)\s*=\s*$", text[begin:opened])
    name = f" of {attribute[1]}" if attribute else ""
    message = f"{plain.message}: the value{name} begins with {quote} and has no end"
    value = re.compile(r"[^\s<>]*").match(text, opened + 1)
    written = (value[0] if value else "").rstrip("/")
    return _at(text, opened, message, f"write {quote}{written}{quote}")


def _end_of(text: str, opened: _Open) -> str:
    """Say how an element is ended: one that holds nothing by a slash."""
    tag = _MARKUP.match(text, opened.at)
    is_short = tag is not None and opened.name in _WITHOUT_CONTENT
    return f"write <{opened.name} …/>" if is_short else f"write </{opened.name}> where it ends"


# Elements of URDF, SDF and launch files that hold nothing.
_WITHOUT_CONTENT = frozenset({
    "arg", "axis", "box", "child", "color", "cylinder", "dynamics", "inertia", "limit", "mass",
    "mesh", "mimic", "origin", "param", "parent", "remap", "safety_controller", "sphere", "texture",
})  # fmt: skip


def _at(text: str, offset: int, message: str, fix: str) -> MalformedXml:
    line = text.count("\n", 0, offset) + 1
    return MalformedXml(message, line, offset - text.rfind("\n", 0, offset), fix)
