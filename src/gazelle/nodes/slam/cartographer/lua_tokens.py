"""Words of Lua 5.2, with their places."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal, NamedTuple

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import UserFileError

__all__ = ["KEYWORDS", "Place", "Token", "failure", "tokens_of"]

Kind = Literal["name", "keyword", "number", "string", "symbol", "end"]

KEYWORDS = frozenset(
    {
        *("and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if"),
        *("in", "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while"),
    }
)
_TOKEN = re.compile(
    r"""
    (?P<space>\s+)
  | (?P<comment>--(?:\[(?P<comment_level>=*)\[.*?\](?P=comment_level)\]|[^\n]*))
  | (?P<long>\[(?P<level>=*)\[.*?\](?P=level)\])
  | (?P<string>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
  | (?P<number>0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<symbol>\.\.\.|\.\.|==|~=|<=|>=|::|[-+*/%^\#<>=(){}\[\];:,.])
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}


class Place(NamedTuple):
    """Where something stands; line and column from 1."""

    file: str
    line: int
    column: int
    length: int = 1

    @property
    def span(self) -> SourceSpan:
        """The same for diagnostics."""
        return SourceSpan(self.file, self.line, self.column, self.length)


class Token(NamedTuple):
    """A word: its kind, its text (of a string its value), and its place."""

    kind: Kind
    text: str
    place: Place


def failure(text: str, place: Place | None, fix: str = "") -> UserFileError:
    """Return what refuses a file."""
    found = Diagnostics()
    found.report("mapping.lua", text, place.span if place else None, fix=fix)
    return UserFileError(tuple(found))


def tokens_of(text: str, file: str) -> Iterator[Token]:
    """Yield the words of a file, and ``end``.

    Raises:
        UserFileError: a character begins no word.
    """
    at, line, line_start = 0, 1, 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        place = Place(file, line, at - line_start + 1, len(found[0]) if found else 1)
        if found is None:
            raise _unknown(text[at], place)
        kind, word = found.lastgroup, found[0]
        token = _token(kind or "", word, found, place)
        if token is not None:
            yield token
        at = found.end()
        breaks = word.count("\n")
        if breaks:
            line, line_start = line + breaks, at - len(word) + word.rindex("\n") + 1
    yield Token("end", "<eof>", Place(file, line, at - line_start + 1))


def _unknown(character: str, place: Place) -> UserFileError:
    if character in "\"'":
        return failure("unfinished string", place, f"close it with {character} in the same line")
    return failure(
        f"unexpected symbol near '{character}'", place, "take it away, or put it into a string"
    )


def _token(kind: str, word: str, found: re.Match[str], place: Place) -> Token | None:
    if found["string"] is not None:
        return Token("string", _unescaped(word[1:-1]), place)
    if found["long"] is not None:
        skip = len(found["level"]) + 2
        return Token("string", word[skip:-skip].removeprefix("\n"), place)
    if found["number"] is not None:
        return Token("number", word, place)
    if found["name"] is not None:
        return Token("keyword" if word in KEYWORDS else "name", word, place)
    return Token("symbol", word, place) if kind == "symbol" else None


def _unescaped(text: str) -> str:
    def value(found: re.Match[str]) -> str:
        word = found[1]
        if word.isdigit():
            return chr(int(word))
        return _ESCAPES.get(word, word)

    return re.sub(r"\\(\d{1,3}|.)", value, text, flags=re.DOTALL)
