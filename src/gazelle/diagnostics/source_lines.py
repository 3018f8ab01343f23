"""The lines of users' files that findings are about, and what is shown of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics.diagnostic import SourceSpan

__all__ = ["Excerpt", "SourceLines", "excerpt"]

_MAX_WIDTH = 160
_BEFORE = 80
_MORE = "…"


class Excerpt(NamedTuple):
    """What is shown of a source line.

    Attributes:
        line: its number.
        text: the line, or the piece of a long one around the place.
        column: where the caret stands in the text, from 1; 0 when only the line is known.
        width: characters under which there are carets.
    """

    line: int
    text: str
    column: int
    width: int


class SourceLines:
    """The lines of the files that findings are about; each file is read once."""

    def __init__(self, texts: Mapping[str, str] | None = None) -> None:
        """Prepare.

        Args:
            texts: texts of spans that are no files, by `SourceSpan.file`.
        """
        self._texts = texts or {}
        self._lines: dict[str, list[str]] = {}

    def line(self, span: SourceSpan) -> str | None:
        """Return the line that a span is in; None where that cannot be read."""
        if not span.line:
            return None
        if span.file not in self._lines:
            self._lines[span.file] = (self._text(span.file) or "").splitlines()
        lines = self._lines[span.file]
        return lines[span.line - 1] if span.line <= len(lines) else None

    def _text(self, file: str) -> str | None:
        if file in self._texts:
            return self._texts[file]
        try:
            # A pipe has been read, and a device has no lines.
            is_file = Path(file).is_file()
            return Path(file).read_text(encoding="utf-8", errors="replace") if is_file else None
        except (OSError, ValueError):
            return None


def excerpt(span: SourceSpan, lines: SourceLines) -> Excerpt | None:
    """Return what is shown of the line that a span is in; None where that cannot be read."""
    line = lines.line(span)
    if line is None:
        return None
    shown, column = _window(line.replace("\t", " "), span.column)
    width = max(1, min(span.length or 1, len(shown) - column + 1)) if column else 0
    return Excerpt(span.line, shown, column, width)


def _window(line: str, column: int) -> tuple[str, int]:
    """Return what of a line is shown, and the column in that: files of one line can be long."""
    start = max(0, column - _BEFORE) if len(line) > _MAX_WIDTH else 0
    shown = line[start : start + _MAX_WIDTH]
    # What a file holds must not steer the terminal.
    shown = "".join(one if one.isprintable() else "·" for one in shown)
    left = _MORE if start else ""
    right = _MORE if start + _MAX_WIDTH < len(line) else ""
    return f"{left}{shown}{right}", column - start + len(left) if column else 0
