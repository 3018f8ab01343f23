"""Diagnostics on a terminal: the message, the source line and a caret under the place."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TextIO

from gazelle.diagnostics.collection import grouped
from gazelle.diagnostics.diagnostic import Diagnostic, Severity

if TYPE_CHECKING:
    from rich.text import Text

    from gazelle.diagnostics.diagnostic import SourceSpan

__all__ = ["Excerpt", "SourceLines", "excerpt", "render", "render_text", "styled"]

_COLOURS = {Severity.INFO: "cyan", Severity.WARNING: "yellow", Severity.ERROR: "red"}
_MAX_WIDTH = 160
_BEFORE = 80
_MAX_LENGTH = 2000
_MORE = "…"
# A remedy that only points at the message has said nothing.
_NO_FIX = "see the message"


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


def render(
    diagnostics: Iterable[Diagnostic],
    *,
    stream: TextIO | None = None,
    sources: Mapping[str, str] | None = None,
) -> None:
    """Print findings with their source lines, in colour where the stream is a terminal.

    Findings that say the same of many places are printed once, see `grouped`.

    Args:
        diagnostics: what to print, in this order.
        stream: where to; standard error when None, and then the journal of the launch that this
            process belongs to has them, too.
        sources: texts of spans that are no files, by `SourceSpan.file`.
    """
    found = grouped(diagnostics)
    if not found:
        # Most launches and commands have nothing to tell, and rich takes long to import.
        return
    lines = SourceLines(sources)
    if stream is None:
        # Imported late: it takes the excerpts of this module.
        from gazelle.diagnostics.launch_journal import keep

        keep(found, lines)
    from rich.console import Console

    console = Console(file=stream or sys.stderr, soft_wrap=True, highlight=False)
    for item in found:
        console.print(styled(item, lines))


def render_text(diagnostic: Diagnostic, sources: Mapping[str, str] | None = None) -> str:
    """Return one finding as plain text: message, source line with caret, way there, fix."""
    return styled(diagnostic, SourceLines(sources)).plain


def styled(item: Diagnostic, lines: SourceLines, *, with_phrase: bool = True) -> Text:
    """Return one finding with its source line, in colours.

    Args:
        item: the finding.
        lines: where source lines come from.
        with_phrase: say what ROS or Gazebo prints in this case, too.
    """
    from rich.text import Text

    colour = _COLOURS[item.severity]
    text = Text()
    if item.span:
        text.append(f"{item.span}: ", style="bold")
    text.append(str(item.severity), style=f"bold {colour}")
    text.append(f": {_short(item.message)} ")
    text.append(f"[{item.code}]", style="dim")
    if item.span:
        _append_source(text, item.span, lines, colour)
        for place in item.span.via:
            text.append(f"\n  from {place}", style="dim")
    if item.fix and item.fix != _NO_FIX:
        text.append("\n  fix: ", style="green")
        text.append(_short(item.fix))
    if item.phrase and with_phrase:
        text.append(f"\n  ROS/Gazebo says: {item.phrase}", style="dim")
    return text


def excerpt(span: SourceSpan, lines: SourceLines) -> Excerpt | None:
    """Return what is shown of the line that a span is in; None where that cannot be read."""
    line = lines.line(span)
    if line is None:
        return None
    shown, column = _window(line.replace("\t", " "), span.column)
    width = max(1, min(span.length or 1, len(shown) - column + 1)) if column else 0
    return Excerpt(span.line, shown, column, width)


def _append_source(text: Text, span: SourceSpan, lines: SourceLines, colour: str) -> None:
    shown = excerpt(span, lines)
    if shown is None:
        return
    text.append(f"\n  {shown.line:>5} | {shown.text}")
    if shown.column:
        text.append(f"\n  {'':>5} | {'':>{shown.column - 1}}")
        text.append("^" * shown.width, style=f"bold {colour}")


def _window(line: str, column: int) -> tuple[str, int]:
    """Return what of a line is shown, and the column in that: files of one line can be long."""
    start = max(0, column - _BEFORE) if len(line) > _MAX_WIDTH else 0
    shown = line[start : start + _MAX_WIDTH]
    # What a file holds must not steer the terminal.
    shown = "".join(one if one.isprintable() else "·" for one in shown)
    left = _MORE if start else ""
    right = _MORE if start + _MAX_WIDTH < len(line) else ""
    return f"{left}{shown}{right}", column - start + len(left) if column else 0


def _short(text: str) -> str:
    """Return a text without its middle where it quotes something endless."""
    if len(text) <= _MAX_LENGTH:
        return text
    half = _MAX_LENGTH // 2
    return f"{text[:half]} {_MORE} ({len(text)} characters) {_MORE} {text[-half:]}"
