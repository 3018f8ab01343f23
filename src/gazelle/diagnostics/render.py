"""Diagnostics on a terminal: the message, the source line and a caret under the place."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, TextIO

from gazelle.diagnostics.collection import grouped
from gazelle.diagnostics.diagnostic import Diagnostic, Severity
from gazelle.diagnostics.launch_journal import keep
from gazelle.diagnostics.source_lines import SourceLines, excerpt

if TYPE_CHECKING:
    from rich.text import Text

    from gazelle.diagnostics.diagnostic import SourceSpan

__all__ = ["render", "render_text", "styled"]

_COLOURS = {Severity.INFO: "cyan", Severity.WARNING: "yellow", Severity.ERROR: "red"}
_MAX_LENGTH = 2000
_MORE = "…"
# A remedy that only points at the message has said nothing.
_NO_FIX = "see the message"


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


def _append_source(text: Text, span: SourceSpan, lines: SourceLines, colour: str) -> None:
    shown = excerpt(span, lines)
    if shown is None:
        return
    text.append(f"\n  {shown.line:>5} | {shown.text}")
    if shown.column:
        text.append(f"\n  {'':>5} | {'':>{shown.column - 1}}")
        text.append("^" * shown.width, style=f"bold {colour}")


def _short(text: str) -> str:
    """Return a text without its middle where it quotes something endless."""
    if len(text) <= _MAX_LENGTH:
        return text
    half = _MAX_LENGTH // 2
    return f"{text[:half]} {_MORE} ({len(text)} characters) {_MORE} {text[-half:]}"
