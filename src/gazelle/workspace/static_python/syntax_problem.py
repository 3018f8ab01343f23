"""Where a text stops being Python, nearer to the mistake than the parser says."""

from __future__ import annotations

import ast
from typing import NamedTuple

__all__ = ["SyntaxProblem", "syntax_problem"]

_COMMA = "forgot a comma"
# Each line of an expression is tried; a file of data is not worth it.
_MAX_LINES = 300
_MAX_TEXT = 200_000


class SyntaxProblem(NamedTuple):
    """What is wrong with a text.

    Attributes:
        message: the parser's words.
        line, column: from 1; 0 where nothing is known.
        fix: what to write, or an empty string.
    """

    message: str
    line: int
    column: int
    fix: str = ""


def syntax_problem(text: str, error: Exception) -> SyntaxProblem:
    """Return where a text is wrong.

    Where a comma is missing the parser shows the whole expression; the place is found by trying.

    Args:
        text: what was parsed.
        error: of `ast.parse`, or of reading the text.
    """
    message = str(getattr(error, "msg", "") or error)
    line, column = getattr(error, "lineno", 0) or 0, getattr(error, "offset", 0) or 0
    end = getattr(error, "end_lineno", 0) or line
    if _COMMA in message and 0 < end - line < _MAX_LINES and len(text) < _MAX_TEXT:
        found = _line_without_comma(text, line, end)
        if found:
            width = len(text.split("\n")[found - 1].rstrip())
            return SyntaxProblem(message, found, width, f"write a comma at the end of line {found}")
    if "inconsistent use of tabs" in message:
        return SyntaxProblem(message, line, 1, "indent with spaces")
    if message == "unexpected indent" and line > 1:
        # The block has the depth of its other lines: the one above may be the odd one.
        odd = _odd_line(text.split("\n"), line)
        if odd:
            depth = len(text.split("\n")[odd - 1]) - len(text.split("\n")[odd - 1].lstrip())
            return SyntaxProblem(message, odd, depth + 1)
    return SyntaxProblem(message, line, column)


def _odd_line(lines: list[str], line: int) -> int:
    """Return the first line of the lines above that would not be a surprise as deep as this one."""
    depth = len(lines[line - 1]) - len(lines[line - 1].lstrip())
    for number in range(line - 1, 0, -1):
        above = lines[number - 1]
        if not above.strip():
            continue
        tried = [*lines[: number - 1], " " * depth + above.lstrip(), *lines[number:]]
        is_near = 0 < abs(depth - (len(above) - len(above.lstrip()))) < 4
        return number if is_near and _goes_further(tried, line) else 0
    return 0


def _goes_further(lines: list[str], line: int) -> bool:
    try:
        ast.parse("\n".join(lines))
    except SyntaxError as error:
        return (error.lineno or 0) > line
    except (ValueError, MemoryError, RecursionError):
        return False
    return True


def _line_without_comma(text: str, first: int, last: int) -> int:
    lines = text.split("\n")
    for number in range(first, last):
        line = lines[number - 1].rstrip()
        if not line or line.endswith((",", "(", "[", "{")):
            continue
        tried = [*lines[: number - 1], f"{line},", *lines[number:]]
        try:
            ast.parse("\n".join(tried))
        except (SyntaxError, ValueError, MemoryError, RecursionError):
            continue
        return number
    return 0
