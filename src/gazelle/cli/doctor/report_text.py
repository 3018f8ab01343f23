"""A report on a terminal, in three levels that a person reads to the end.

A terminal shows the end of what is printed, so a report is read from there: the last line is the
verdict, above it stand the errors, above them the warnings, the notices and the tables. What
follows from other findings stands above its causes, or is only counted.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from gazelle.cli.doctor.report_tables import table_lines, table_title
from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.collection import grouped, groups
from gazelle.diagnostics.render import styled
from gazelle.diagnostics.source_lines import SourceLines

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

    from gazelle.doctor import Report, Section

__all__ = ["Level", "print_report", "verdict"]

_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}
# What is about a whole package; the others are about one launch, robot or world each.
_OF_PACKAGES = frozenset({"generations", "names"})
_WIDE = frozenset({"folder", "package", "workspace"})
# Their rows are findings too.
_TOLD = frozenset({"tags"})
_PROBE = "probe_"
_NAMES = "names"
_NOTHING = "nothing to do"
_LONGEST = 160
_MORE = "…"
_EVERYTHING = sys.maxsize


class Level(IntEnum):
    """How much is printed.

    Attributes:
        BRIEF: warnings and errors, a line each.
        NORMAL: warnings and errors whole, of each kind of notice the first, and what was asked for.
        FULL: everything that was found, and the tables that fit the target.
    """

    BRIEF = 0
    NORMAL = 1
    FULL = 2


def print_report(
    report: Report,
    *,
    level: Level = Level.NORMAL,
    tables: bool = False,
    least: Severity = Severity.INFO,
    seconds: float = 0.0,
    stream: TextIO | None = None,
) -> None:
    """Print a report.

    Args:
        report: what was found.
        level: how much of it is printed.
        tables: print all tables.
        least: findings below it are left out; the verdict counts all.
        seconds: how long the examination took.
        stream: standard output when None.
    """
    from rich.console import Console
    from rich.text import Text

    out = stream or sys.stdout
    console = Console(file=out, highlight=False, soft_wrap=True)
    for section, rows in _tables(report, level, tables):
        _print_table(section, rows, console, console.width if out.isatty() else None)
    found = _sorted(item for item in report.findings if item.severity >= least)
    late = _sorted(report.consequences)
    serious = [item for item in found if item.severity > Severity.INFO]
    if level is Level.BRIEF:
        _print_lines(serious, console)
    else:
        _print_notices([item for item in found if item.severity is Severity.INFO], level, console)
        if level is Level.FULL:
            _print_consequences([item for item in late if item.severity >= least], console)
        _print_whole(serious, SourceLines(dict(report.sources)), level, console)
    if late and level is not Level.FULL:
        verb = "follows" if len(late) == 1 else "follow"
        text = f"{len(late)} finding{'s' * (len(late) != 1)} more {verb} from these; -v shows them"
        console.print(Text(text))
    console.print(Text(verdict(report, seconds), style="bold"))


def verdict(report: Report, seconds: float) -> str:
    """Return the last line: ``2 errors, 3 warnings, 5 notices in 0.8 s``."""
    counts = [(report.count(item), _WORDS[item]) for item in sorted(Severity, reverse=True)]
    told = [f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count]
    text = ", ".join(told) or "nothing to complain about"
    return f"{report.kind} {report.target}: {text} in {seconds:.1f} s"


def _sorted(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Order findings: the worst last, of one severity file by file, each from top to bottom."""
    items = [_shortened(item) for item in findings]
    order = {file: at for at, file in enumerate(dict.fromkeys(map(_file, items)))}

    def key(item: Diagnostic) -> tuple[int, int, int, int]:
        line, column = (item.span.line, item.span.column) if item.span else (0, 0)
        return item.severity, order[_file(item)], line, column

    return sorted(items, key=key)


def _file(item: Diagnostic) -> str:
    return item.span.file if item.span else ""


def _shortened(item: Diagnostic) -> Diagnostic:
    """Name files below the current folder relative to it."""
    if item.span is None:
        return item
    return replace(item, span=_relative(item.span, f"{Path.cwd()}/"))


def _relative(span: SourceSpan, here: str) -> SourceSpan:
    via = tuple(_relative(outer, here) for outer in span.via)
    return replace(span, file=span.file.removeprefix(here), via=via)


def _print_lines(findings: Sequence[Diagnostic], console: Console) -> None:
    """Print a line each, as compilers do, which editors read."""
    from rich.text import Text

    for group in groups(findings):
        console.print(Text(_line(group, f"{group[0].severity}: ")))


def _line(group: Sequence[Diagnostic], word: str = "", longest: int = _EVERYTHING) -> str:
    first = group[0]
    place = f"{first.span}: " if first.span else ""
    text = first.message.partition("\n")[0]
    if len(text) > longest:
        text = f"{text[:longest].rpartition(' ')[0]} {_MORE}"
    more = f" and {len(group) - 1} more" if len(group) > 1 else ""
    return f"{place}{word}{text} [{first.code}]{more}"


def _print_notices(notices: Sequence[Diagnostic], level: Level, console: Console) -> None:
    """Print what is no mistake, or seldom one: of each kind the first, or all with what to do."""
    from rich.text import Text

    if not notices:
        return
    by_code: dict[str, list[Diagnostic]] = {}
    for item in sorted(notices, key=lambda item: item.code):
        by_code.setdefault(item.code, []).append(item)
    lines = [_line(group, longest=_LONGEST) for group in by_code.values()]
    head = "notices"
    if level is Level.FULL:
        lines = [line for group in by_code.values() for line in _whole_notices(group)]
    elif len(lines) < len(notices):
        head += ", the first of each kind (-v: all, and what to do)"
    else:
        head += " (-v: what to do)"
    console.print(Text(f"{head}:", style="bold"))
    for line in lines:
        console.print(Text(f"  {line}"))
    console.print()


def _whole_notices(group: Sequence[Diagnostic]) -> Iterator[str]:
    for item in grouped(group, most=_EVERYTHING):
        place = f"{item.span}: " if item.span else ""
        fix = f"\nfix: {item.fix}" if item.fix and not item.fix.startswith(_NOTHING) else ""
        yield f"{place}{item.message} [{item.code}]{fix}".replace("\n", "\n    ")


def _print_consequences(findings: Sequence[Diagnostic], console: Console) -> None:
    from rich.text import Text

    if not findings:
        return
    console.print(Text("follows from what stands below, and goes with it:", style="bold"))
    for group in groups(findings):
        console.print(Text(f"  {_line(group, f'{group[0].severity}: ')}"))
    console.print()


def _print_whole(
    findings: Sequence[Diagnostic], lines: SourceLines, level: Level, console: Console
) -> None:
    """Print findings with source line and remedy; what ROS says to all of a kind is said once."""
    said: set[tuple[str, str]] = set()
    merged = grouped(findings, most=_EVERYTHING) if level is Level.FULL else grouped(findings)
    for item in merged:
        phrase = (item.code, item.phrase)
        console.print(styled(item, lines, with_phrase=phrase not in said))
        console.print()
        said.add(phrase)


def _tables(
    report: Report, level: Level, wants_all: bool
) -> Iterator[tuple[Section, Sequence[Sequence[str]]]]:
    """Yield the tables to print with their rows: what was asked for, and names that disagree."""
    for section in report.sections:
        is_told = level is Level.BRIEF or section.name in _TOLD
        is_asked = section.name.startswith(_PROBE)
        if wants_all or (not is_told and (is_asked or _fits(section, level, report.kind))):
            yield section, section.rows
        elif level is Level.NORMAL and section.name == _NAMES:
            rows = _disagreeing(section)
            if rows:
                yield section, rows


def _fits(section: Section, level: Level, kind: str) -> bool:
    """Tell whether a table is about the target as a whole: each launch of a package has five."""
    return level is Level.FULL and (kind not in _WIDE or section.name in _OF_PACKAGES)


def _disagreeing(section: Section) -> list[tuple[str, ...]]:
    """Return the rows of joints that somebody names and the robot, or its hardware, has not."""
    has_hardware = any(hardware for _name, _urdf, hardware, *_ in section.rows)
    return [row for row in section.rows if not row[1] or (has_hardware and not row[2])]


def _print_table(
    section: Section, rows: Sequence[Sequence[str]], console: Console, width: int | None
) -> None:
    from rich.text import Text

    title = table_title(section)
    if len(rows) < len(section.rows):
        title += f", {len(rows)} of {len(section.rows)}: where they disagree"
    lines: list[Text] = [Text(title, style="bold"), *map(Text, table_lines(section, width, rows))]
    for line in lines:
        console.print(line)
    console.print()
