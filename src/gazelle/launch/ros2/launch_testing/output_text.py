"""launch_testing.tools.text: finding texts in output."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

__all__ = [
    "build_line_match",
    "build_text_match",
    "normalize_lineseps",
    "remove_ansi_escape_sequences",
]

_Span = tuple[int, int]
_Match = Callable[..., "_Span | None"]
_ANSI = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]|\x1b[@-Z\\-_]")


def remove_ansi_escape_sequences(text: str) -> str:
    """Return a text without colours and the like."""
    return _ANSI.sub("", text)


def normalize_lineseps(lines: str) -> str:
    """Return a text with line feeds only."""
    return lines.replace("\r\n", "\n")


def build_text_match(expected_text: Any, *, strict: bool = False) -> _Match:
    """Return a function that finds something in a text, from a place on.

    It returns begin and end of what it found, or None.

    Args:
        expected_text: a text, a regular expression, or several that follow each other.
        strict: it has to stand at the place, and a text has to be all there is.

    Raises:
        ValueError: it is something else.
    """
    if isinstance(expected_text, str):
        return _text_finder(expected_text, strict)
    if isinstance(expected_text, re.Pattern):
        return _pattern_finder(expected_text, strict)
    if isinstance(expected_text, Iterable):
        return _sequence([build_text_match(one) for one in expected_text], strict)
    raise ValueError("Unknown format for expected text")


def _text_finder(wanted: str, strict: bool) -> _Match:
    def find(actual_text: str, start: int = 0) -> _Span | None:
        text = normalize_lineseps(actual_text)
        if strict:
            return (start, start + len(wanted)) if text[start:] == wanted else None
        at = text.find(wanted, start)
        return None if at < 0 else (at, at + len(wanted))

    return find


def _pattern_finder(wanted: re.Pattern[str], strict: bool) -> _Match:
    def find(actual_text: str, start: int = 0) -> _Span | None:
        look = wanted.match if strict else wanted.search
        found = look(normalize_lineseps(actual_text), start)
        return None if found is None else found.span()

    return find


def build_line_match(expected_lines: Any, *, strict: bool = False) -> _Match:
    """Return a function that finds something in lines, from a line on.

    It returns the first line and the one behind the last, or None.

    Args:
        expected_lines: a part of a line, a regular expression, or several in order.
        strict: all lines have to be it, and several have to follow each other at once.

    Raises:
        ValueError: it is something else.
    """
    if isinstance(expected_lines, str):
        wanted = expected_lines
        return _line_finder(
            (lambda line: line == wanted) if strict else (lambda line: wanted in line), strict
        )
    if isinstance(expected_lines, re.Pattern):
        pattern = expected_lines
        return _line_finder(lambda line: pattern.match(line) is not None, strict)
    if isinstance(expected_lines, Iterable):
        return _sequence([build_line_match(one) for one in expected_lines], strict)
    raise ValueError("Unknown format for expected lines")


def _line_finder(is_it: Callable[[str], bool], strict: bool) -> _Match:
    def find(actual_lines: Sequence[str], start: int = 0) -> _Span | None:
        if strict:
            fits = all(is_it(line) for line in actual_lines[start:])
            return (start, len(actual_lines)) if fits else None
        numbers = range(start, len(actual_lines))
        return next(((at, at + 1) for at in numbers if is_it(actual_lines[at])), None)

    return find


def _sequence(finders: list[_Match], strict: bool) -> _Match:
    def find(actual: Any, start: int = 0) -> _Span | None:
        begin, end = -1, start
        for finder in finders:
            found = finder(actual, end)
            if found is None or (strict and found[0] != end):
                return None
            begin = found[0] if begin < 0 else begin
            end = found[1]
        return begin, end

    return find
