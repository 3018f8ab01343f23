"""``gazelle doctor``: finds what would go wrong before anything is started.

A report is shown on the terminal, or as JSON whose shape programs may rely on
(docs/howto/doctor.md).
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, grouped, render
from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console

    from gazelle.doctor import Report, Section

__all__ = ["SCHEMA", "Tables", "json_text", "main", "print_report", "verdict"]

_NOTHING_EXAMINED = 2
_EPILOG = """what TARGET may be:
  PACKAGE or FOLDER      everything in it: manifest, launch files, robots, worlds, parameters
  FILE                   a robot (URDF, xacro, SDF), a world, model.config, YAML, a launch file
  PACKAGE FILE.launch    a launch, as roslaunch takes it; name:=value are its arguments
  nothing                the package or the workspace of the current folder

exit code: 0 nothing worse than a notice, 1 warnings, 2 errors or no such target
"""
SCHEMA = 1
"""Counts up when a key changes its meaning or goes; new keys may come at any time."""
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


def main(argv: list[str]) -> int:
    """Examine a target and print the report."""
    parser = _parser()
    tokens = [word for word in argv if not _is_argument(word)]
    options = parser.parse_args(tokens)
    arguments = dict(word.split(":=", 1) for word in argv if _is_argument(word))
    from gazelle.doctor import Options, examine

    chosen = Options(arguments=arguments, probe=options.probe, world=options.world)
    start_s = time.perf_counter()
    try:
        with _progress() as say:
            report = examine(options.target, options=chosen, progress=say)
    except GazelleError as error:
        print(f"gazelle doctor: {error}", file=sys.stderr)
        return _NOTHING_EXAMINED
    _show(report, options, time.perf_counter() - start_s)
    return report.exit_code


def json_text(report: Report, least: Severity = Severity.INFO) -> str:
    """Return a report as JSON.

    Args:
        report: what was found.
        least: findings below it are left out; counts and exit code are those of all.
    """
    import json

    return json.dumps(
        {
            "schema": SCHEMA,
            "target": report.target,
            "kind": report.kind,
            "exit_code": report.exit_code,
            "counts": {str(severity): report.count(severity) for severity in Severity},
            "findings": [_finding(item) for item in report.findings if item.severity >= least],
            "consequences": [
                _finding(item) for item in report.consequences if item.severity >= least
            ],
            "sections": [
                {
                    "name": section.name,
                    "title": section.title,
                    "subject": section.subject,
                    "columns": list(section.columns),
                    "rows": [list(row) for row in section.rows],
                }
                for section in report.sections
            ],
        },
        indent=2,
        ensure_ascii=False,
    )


def print_report(
    report: Report,
    *,
    least: Severity = Severity.INFO,
    seconds: float = 0.0,
    tables: Tables = Tables.FITTING,
    verbose: bool = False,
    stream: TextIO | None = None,
) -> None:
    """Print a report.

    Args:
        report: what was found.
        least: findings below it are left out; the verdict counts all.
        seconds: how long the examination took.
        tables: which tables are printed.
        verbose: print what follows from findings, too.
        stream: standard output when None.
    """
    from rich.console import Console
    from rich.text import Text

    out = stream or sys.stdout
    console = Console(file=out, highlight=False, soft_wrap=False)
    console.width = max(_NARROWEST, min(_MAX_WIDTH, console.width))
    sources = dict(report.sources)
    findings = (*report.consequences, *report.findings) if verbose else report.findings
    _print_notices([item for item in findings if least <= item.severity], console)
    for file, items in _by_file(findings, max(least, Severity.WARNING)).items():
        console.print(Text(f"── {file or 'in general'}", style="bold"), soft_wrap=True)
        render(items, stream=out, sources=sources)
        console.print()
    _print_tables(report, tables, console)
    late = len(report.consequences)
    if late and not verbose:
        verb = "follows" if late == 1 else "follow"
        text = f"{late} finding{'s' * (late != 1)} more {verb} from these; -v shows them"
        console.print(text, soft_wrap=True)
    console.print(verdict(report, seconds), style="bold", soft_wrap=True)


def verdict(report: Report, seconds: float) -> str:
    """Return the last line: ``2 errors, 3 warnings, 5 notices in 0.8 s``."""
    counts = [(report.count(item), _WORDS[item]) for item in sorted(Severity, reverse=True)]
    told = [f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count]
    text = ", ".join(told) or "nothing to complain about"
    return f"{report.kind} {report.target}: {text} in {seconds:.1f} s"


def _show(report: Report, options: argparse.Namespace, seconds: float) -> None:
    least = Severity.WARNING if options.quiet else Severity[options.least.upper()]
    if options.json:
        print(json_text(report, least))
    else:
        tables = Tables.ALL if options.tables else Tables.FITTING
        tables = Tables.NONE if options.quiet else tables
        print_report(report, least=least, seconds=seconds, tables=tables, verbose=options.verbose)


def _is_argument(word: str) -> bool:
    return ":=" in word and not word.startswith("-")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle doctor",
        usage="gazelle doctor [options] [TARGET] [name:=value ...]",
        description="find what would go wrong before anything is started",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("target", nargs="*", metavar="TARGET", help="see below")
    add("--json", action="store_true", help="print the report as JSON, and nothing else")
    add("--probe", action="store_true", help="run short simulations too: drift, wheels, contacts")
    add("--world", default="empty", metavar="W", help="world for a robot on its own (empty)")
    add(
        "--least",
        choices=[str(item) for item in Severity],
        default=str(Severity.INFO),
        help="leave out findings below this severity",
    )
    add("--tables", action="store_true", help="all tables, for a package those of each launch too")
    add("-v", "--verbose", action="store_true", help="what follows from other findings, too")
    add("-q", "--quiet", action="store_true", help="warnings and errors only, no tables")
    return parser


@contextmanager
def _progress() -> Iterator[Callable[[str], None] | None]:
    """Show on the terminal what is being looked at; programs that read are left in peace."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console

    with Console(file=sys.stderr).status("examining") as status:
        yield status.update


def _finding(item: Diagnostic) -> dict[str, Any]:
    span = item.span
    return {
        "code": item.code,
        "severity": str(item.severity),
        "message": item.message,
        "file": span.file if span else None,
        "line": span.line if span else None,
        "column": span.column if span else None,
        "via": [
            {"file": outer.file, "line": outer.line, "column": outer.column}
            for outer in (span.via if span else ())
        ],
        "fix": item.fix,
        "phrase": item.phrase,
    }


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
    return replace(span, file=file, via=tuple(_relative(outer) for outer in span.via))


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
