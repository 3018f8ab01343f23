"""A report on a terminal: notices in a line each, findings with their source, tables, a verdict."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, grouped, render

if TYPE_CHECKING:
    from rich.console import Console

    from gazelle.doctor import Report, Section

__all__ = ["Tables", "print_report", "verdict"]

_MAX_WIDTH = 120
_NARROWEST = 60
# What is about a whole package; the others are about one launch, robot or world each.
_OF_PACKAGES = frozenset({"generations", "names"})
_WIDE = frozenset({"folder", "package", "workspace"})
# Their rows are findings too.
_TOLD = frozenset({"tags"})
_NOTHING = "nothing to do"
_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


class Tables(Enum):
    """Which tables are printed: none, those that fit the target, or all."""

    NONE = "none"
    FITTING = "fitting"
    ALL = "all"


def print_report(
    report: Report,
    *,
    least: Severity = Severity.INFO,
    seconds: float = 0.0,
    tables: Tables = Tables.FITTING,
    stream: TextIO | None = None,
) -> None:
    """Print a report.

    Args:
        report: what was found.
        least: findings below it are left out; the verdict counts all.
        seconds: how long the examination took.
        tables: which tables are printed.
        stream: standard output when None.
    """
    from rich.console import Console
    from rich.text import Text

    out = stream or sys.stdout
    console = Console(file=out, highlight=False, soft_wrap=False)
    console.width = max(_NARROWEST, min(_MAX_WIDTH, console.width))
    sources = dict(report.sources)
    _print_notices([item for item in report.findings if least <= item.severity], console)
    for file, items in _by_file(report.findings, max(least, Severity.WARNING)).items():
        console.print(Text(f"── {file or 'in general'}", style="bold"), soft_wrap=True)
        render(items, stream=out, sources=sources)
        console.print()
    _print_tables(report, tables, console)
    console.print(verdict(report, seconds), style="bold", soft_wrap=True)


def _print_notices(findings: Iterable[Diagnostic], console: Console) -> None:
    """Print what is no mistake, or seldom one, in a line or two each."""
    from rich.text import Text

    notices = [_shortened(item) for item in findings if item.severity is Severity.INFO]
    if not notices:
        return
    console.print(Text("── notices", style="bold"))
    for item in grouped(sorted(notices, key=lambda item: item.code)):
        text = Text(f"{item.span}: " if item.span else "", style="bold")
        text.append(item.message, style="not bold")
        text.append(f" [{item.code}]", style="not bold dim")
        fix = item.fix.partition("\n")[0]
        if fix and not fix.startswith(_NOTHING):
            text.append(f"\n  fix: {fix}{' …' if fix != item.fix else ''}", style="not bold green")
        console.print(text, soft_wrap=True)
    console.print()


def _print_tables(report: Report, tables: Tables, console: Console) -> None:
    """Print tables; of a package only its own, for each of its launches has five."""
    if tables is Tables.NONE:
        return
    is_short = tables is Tables.FITTING
    of_package = is_short and report.kind in _WIDE
    shown = [
        section
        for section in report.sections
        if not (is_short and section.name in _TOLD)
        and (not of_package or section.name in _OF_PACKAGES or section.name.startswith("probe_"))
    ]
    for section in shown:
        _print_section(section, console)
    if of_package and len(shown) < len(report.sections):
        console.print("tables of nodes, frames and plug-ins: examine one file, or add --tables")


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
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for name in section.columns:
        table.add_column(name, overflow="fold")
    for row in section.rows:
        # Cells are texts of users' files, not markup.
        table.add_row(*(Text(cell) for cell in row))
    # A title of the table's own would be broken to the width of the cells.
    console.print(Text(title, style="bold"), soft_wrap=True)
    console.print(table)
    console.print()
