"""Messages in the text format of protocol buffers: printed, and read as ``linear: {x: 0.5}``.

The format is documented at https://protobuf.dev/reference/protobuf/textformat-spec/.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from gazelle.cli.gz.options import GzError

__all__ = ["number_text", "protobuf_text", "read_protobuf_text"]

_TOKEN = re.compile(
    r"\s*(?:#[^\n]*\n\s*)*(?P<token>[{}<>\[\]:,;]"
    r"|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'"
    r"|[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[fF]?(?![\w.])"
    r"|-?[A-Za-z_][\w.]*)"
)
_CLOSING = {"{": "}", "<": ">"}
_END = ""
_NEAR = 20
_INDENT = "  "
_FEWER_DIGITS, _ALL_DIGITS = 15, 17


class _Reading:
    """Goes through the tokens of a text."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._tokens = list(_tokens(text))
        self._next = 0

    def message(self, closing: str) -> dict[str, Any]:
        fields: dict[str, Any] = {}
        while (name := self._take()) != closing:
            if name == _END:
                raise self._error(f"'{closing}' is missing at the end")
            if not re.fullmatch(r"[A-Za-z_]\w*", name):
                raise self._error(f"a field's name was expected, not '{name}'")
            has_colon = self._peek() == ":"
            if has_colon:
                self._take()
            elif self._peek() not in _CLOSING:
                raise self._error(f"'{name}' wants ':' and a value")
            _add(fields, name, self._value())
            if self._peek() in {",", ";"}:
                self._take()
        return fields

    def _value(self) -> Any:
        word = self._take()
        if word in _CLOSING:
            return self.message(_CLOSING[word])
        if word == "[":
            return self._list()
        if word[:1] in {"'", '"'}:
            return self._string(word)
        if word in {"true", "false"}:
            return word == "true"
        if re.match(r"-?[A-Za-z_]", word):
            return float(word) if word.lstrip("-").lower() in {"inf", "nan"} else word
        if word and word not in "}>]:,;":
            return _number(word)
        raise self._error(f"a value was expected, not {repr(word) if word else 'the end'}")

    def _list(self) -> list[Any]:
        found: list[Any] = []
        while self._peek() != "]":
            if self._peek() == _END:
                raise self._error("']' is missing at the end")
            found.append(self._value())
            if self._peek() == ",":
                self._take()
        self._take()
        return found

    def _string(self, token: str) -> str:
        text = _unquoted(token)
        while self._peek()[:1] in {"'", '"'}:
            text += _unquoted(self._take())
        return text

    def _peek(self) -> str:
        return self._tokens[self._next][0]

    def _take(self) -> str:
        token = self._peek()
        # The last one is the end, which stays.
        self._next = min(self._next + 1, len(self._tokens) - 1)
        return token

    def _error(self, problem: str) -> GzError:
        return _error(problem, self._text, self._tokens[max(self._next - 1, 0)][1])


def read_protobuf_text(text: str) -> dict[str, Any]:
    """Return fields by name; a field that is repeated is a list, a nested message a mapping.

    Words without quotes (enumerations) stay text; ``true`` and ``false`` are truth values.

    Raises:
        GzError: the text is not of this format, with the place.
    """
    return _Reading(text).message(_END)


def protobuf_text(fields: Mapping[str, Any], depth: int = 0) -> str:
    """Return nested fields as text: ``name: value`` or ``name { … }``, a line each.

    Args:
        fields: a value, a mapping, or a list of either under each name.
        depth: of the indentation.
    """
    lines: list[str] = []
    for name, value in fields.items():
        for one in value if isinstance(value, list) else [value]:
            lines += _lines(name, one, depth)
    return "".join(lines)


def number_text(value: float) -> str:
    """Return the shorter of 15 and 17 digits that reads back as the same number."""
    short = f"{value:.{_FEWER_DIGITS}g}"
    return short if float(short) == value or math.isnan(value) else f"{value:.{_ALL_DIGITS}g}"


def _error(problem: str, text: str, offset: int) -> GzError:
    near = text[max(offset - _NEAR, 0) : offset + _NEAR]
    return GzError(f"{problem}: character {offset + 1}, near {near!r}")


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    offset = 0
    while rest := text[offset:].strip():
        found = _TOKEN.match(text, offset)
        if found is None:
            start = text.index(rest[0], offset)
            raise _error(f"'{rest[0]}' is not understood", text, start)
        yield found["token"], found.start("token")
        offset = found.end()
    yield _END, len(text)


def _add(fields: dict[str, Any], name: str, value: Any) -> None:
    if name in fields:
        before = fields[name] if isinstance(fields[name], list) else [fields[name]]
        value = [*before, *(value if isinstance(value, list) else [value])]
    fields[name] = value


def _unquoted(token: str) -> str:
    try:
        # People paste models with line breaks, which the format wants as \\n.
        return str(ast.literal_eval(token.replace("\n", "\\n")))
    except (SyntaxError, ValueError):
        raise GzError(f"{token} has an escape that is none") from None


def _number(token: str) -> int | float:
    if "x" in token.lower():
        return int(token, 16)
    bare = token.rstrip("fF")
    return int(bare) if bare.lstrip("+-").isdigit() else float(bare)


def _lines(name: str, value: Any, depth: int) -> Iterable[str]:
    space = _INDENT * depth
    if isinstance(value, Mapping):
        return (f"{space}{name} {{\n", protobuf_text(value, depth + 1), f"{space}}}\n")
    return (f"{space}{name}: {_scalar(name, value)}\n",)


def _scalar(name: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return number_text(value)
    if isinstance(value, str):
        # Enumerations stand without quotes; the fields of that kind are called so.
        if name == "type":
            return value
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{escaped}"'
    return str(value)
