"""Diagnostics on a terminal: the message, the source line and a caret under the place."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from gazelle.diagnostics.collection import grouped
from gazelle.diagnostics.diagnostic import Diagnostic, Severity

if TYPE_CHECKING:
    from rich.text import Text

    from gazelle.diagnostics.diagnostic import SourceSpan

__all__ = ["render", "render_text"]

_COLOURS = {Severity.INFO: "cyan", Severity.WARNING: "yellow", Severity.ERROR: "red"}
_MAX_WIDTH = 160
_BEFORE = 80
_MAX_LENGTH = 2000
_MORE = "…"


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
        stream: where to; standard error when None.
        sources: texts of spans that are no files, by `SourceSpan.file`.
    """
    found = grouped(diagnostics)
    if not found:
        # Most launches and commands have nothing to tell, and rich takes long to import.
        return
    from rich.console import Console

    console = Console(file=stream or sys.stderr, soft_wrap=True, highlight=False)
    for item in found:
        console.print(_rich_text(item, sources or {}))


def render_text(diagnostic: Diagnostic, sources: Mapping[str, str] | None = None) -> str:
    """Return one finding as plain text: message, source line with caret, way there, fix."""
    return _rich_text(diagnostic, sources or {}).plain


def _rich_text(item: Diagnostic, sources: Mapping[str, str]) -> Text:
    from rich.text import Text

    colour = _COLOURS[item.severity]
    text = Text()
    if item.span:
        text.append(f"{item.span}: ", style="bold")
    text.append(str(item.severity), style=f"bold {colour}")
    text.append(f": {_short(item.message)} ")
    text.append(f"[{item.code}]", style="dim")
    if item.span:
        _append_source(text, item.span, sources, colour)
        for place in item.span.via:
            text.append(f"\n  from {place}", style="dim")
    if item.fix:
        text.append("\n  fix: ", style="green")
        text.append(_short(item.fix))
    if item.phrase:
        text.append(f"\n  ROS/Gazebo says: {item.phrase}", style="dim")
    return text


def _append_source(text: Text, span: SourceSpan, sources: Mapping[str, str], colour: str) -> None:
    line = _source_line(span, sources)
    if line is None:
        return
    shown, column = _window(line.replace("\t", " "), span.column)
    text.append(f"\n  {span.line:>5} | {shown}")
    if column:
        width = max(1, min(span.length or 1, len(shown) - column + 1))
        text.append(f"\n  {'':>5} | {'':>{column - 1}}")
        text.append("^" * width, style=f"bold {colour}")


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


def _source_line(span: SourceSpan, sources: Mapping[str, str]) -> str | None:
    if not span.line:
        return None
    try:
        source = sources.get(span.file)
        if source is None and not Path(span.file).is_file():
            # A pipe has been read, and a device has no lines.
            return None
        if source is None:
            source = Path(span.file).read_text(encoding="utf-8", errors="replace")
    except (OSError, ValueError):
        return None
    lines = source.splitlines()
    return lines[span.line - 1] if span.line <= len(lines) else None
