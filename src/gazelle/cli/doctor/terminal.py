"""A report on a terminal: findings with their source lines by file, tables, a verdict."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, grouped, render

if TYPE_CHECKING:
    from rich.console import Console

    from gazelle.doctor import Report, Section

__all__ = ["print_report", "verdict"]

_WIDEST = 120
_NARROWEST = 60
_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def print_report(
    report: Report,
    *,
    least: Severity = Severity.INFO,
    seconds: float = 0.0,
    tables: bool = True,
    stream: TextIO | None = None,
) -> None:
    """Print a report.

    Args:
        report: what was found.
        least: findings below it are left out; the verdict counts all.
        seconds: how long the examination took.
        tables: print the tables too.
        stream: standard output when None.
    """
    from rich.console import Console
    from rich.text import Text

    out = stream or sys.stdout
    console = Console(file=out, highlight=False, soft_wrap=False)
    console.width = max(_NARROWEST, min(_WIDEST, console.width))
    sources = dict(report.sources)
    for file, items in _by_file(report.findings, least).items():
        console.print(Text(f"── {file or 'in general'}", style="bold"), soft_wrap=True)
        render(items, stream=out, sources=sources)
        console.print()
    if tables:
        for section in report.sections:
            _print_section(section, console)
    console.print(verdict(report, seconds), style="bold", soft_wrap=True)


def verdict(report: Report, seconds: float) -> str:
    """Return the last line: ``2 errors, 3 warnings, 5 notices in 0.8 s``."""
    counts = [(report.count(item), _WORDS[item]) for item in sorted(Severity, reverse=True)]
    told = [f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count]
    text = ", ".join(told) or "nothing to complain about"
    return f"{report.kind} {report.target}: {text} in {seconds:.1f} s"


def _by_file(findings: Iterable[Diagnostic], least: Severity) -> dict[str, tuple[Diagnostic, ...]]:
    """Return findings by file, files with the worst findings last, next to the verdict."""
    shown: dict[str, list[Diagnostic]] = {}
    for item in findings:
        if item.severity >= least:
            placed = _shortened(item)
            shown.setdefault(placed.span.file if placed.span else "", []).append(placed)
    order = sorted(shown, key=lambda file: max(item.severity for item in shown[file]))
    return {file: grouped(sorted(shown[file], key=lambda item: item.severity)) for file in order}


def _shortened(item: Diagnostic) -> Diagnostic:
    """Name files below the current folder relative to it."""
    if item.span is None:
        return item
    return replace(item, span=_relative(item.span))


def _relative(span: SourceSpan) -> SourceSpan:
    file = span.file
    try:
        file = str(Path(file).relative_to(Path.cwd()))
    except ValueError:
        file = span.file
    return replace(span, file=file, via=tuple(_relative(place) for place in span.via))


def _print_section(section: Section, console: Console) -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    title = f"{section.title} of {section.subject}" if section.subject else section.title
    table = Table(
        title=Text(title, style="bold"),
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        show_edge=False,
    )
    for name in section.columns:
        table.add_column(name, overflow="fold")
    for row in section.rows:
        # Cells are texts of users' files, not markup.
        table.add_row(*(Text(cell) for cell in row))
    console.print(table)
    console.print()
