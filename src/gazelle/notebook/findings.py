"""Findings about files, with the line of the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape
from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.diagnostics.collection import grouped
from gazelle.diagnostics.source_lines import SourceLines
from gazelle.notebook.html_parts import figure, short_text
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.doctor.report import Report

__all__ = ["finding_bundle", "findings_bundle", "report_bundle"]

_COLOURS = {Severity.INFO: "#06b6d4", Severity.WARNING: "#d4a106", Severity.ERROR: "#ef4444"}
_MAX_SHOWN = 60
_MAX_LINE = 160
_CODE = (
    "font:12px/1.5 ui-monospace,monospace;white-space:pre-wrap;word-break:break-word;"
    "background:rgba(128,128,128,.14);border-radius:4px;padding:2px 8px;margin:3px 0"
)
_NO_FIX = "see the message"


def finding_bundle(finding: Diagnostic) -> Bundle:
    """Return one finding."""
    return {"text/html": figure(_finding(finding, SourceLines()))}


def findings_bundle(findings: Diagnostics) -> Bundle:
    """Return findings, the worst first."""
    return {"text/html": figure(_findings(findings, {}))}


def report_bundle(report: Report) -> Bundle:
    """Return what the doctor says of a target."""
    return {"text/html": figure(_findings(report.findings, dict(report.sources)), report.target)}


def _findings(findings: Iterable[Diagnostic], sources: Mapping[str, str]) -> str:
    found = sorted(grouped(findings), key=lambda one: -one.severity)
    if not found:
        return "nothing to complain about"
    counts = {severity: sum(one.severity is severity for one in found) for severity in Severity}
    head = ", ".join(
        f'<span style="color:{_COLOURS[one]};font-weight:600">'
        f"{counts[one]} {one}{'s' if counts[one] > 1 else ''}</span>"
        for one in sorted(Severity, reverse=True)
        if counts[one]
    )
    lines = SourceLines(sources)
    shown = "".join(_finding(one, lines) for one in found[:_MAX_SHOWN])
    left = len(found) - _MAX_SHOWN
    return f"<div>{head}</div>{shown}" + (f"<div>… and {left} more</div>" if left > 0 else "")


def _finding(item: Diagnostic, lines: SourceLines) -> str:
    colour = _COLOURS[item.severity]
    place = f'<span style="opacity:.7">{escape(str(item.span))}</span><br>' if item.span else ""
    parts = [
        f'{place}<b style="color:{colour}">{item.severity}</b>: {escape(short_text(item.message))} '
        f'<span style="opacity:.6">[{escape(item.code)}]</span>'
    ]
    line = lines.line(item.span) if item.span else None
    if item.span is not None and line is not None:
        parts.append(f'<div style="{_CODE}">{_marked(line, item)}</div>')
    if item.fix and item.fix != _NO_FIX:
        fix = escape(short_text(item.fix))
        parts.append(f'<div><span style="color:#10b981">fix:</span> {fix}</div>')
    if item.phrase:
        words = escape(short_text(item.phrase))
        parts.append(f'<div style="opacity:.65">ROS/Gazebo says: {words}</div>')
    style = f"border-left:3px solid {colour};padding-left:10px;margin:8px 0"
    return f'<div style="{style}">{"".join(parts)}</div>'


def _marked(line: str, item: Diagnostic) -> str:
    """Return a line of a file with the place underlined."""
    assert item.span is not None
    column, length = item.span.column, max(1, item.span.length)
    first = max(0, column - 1 - _MAX_LINE // 2) if len(line) > _MAX_LINE else 0
    shown = line[first : first + _MAX_LINE]
    before, rest = f"{item.span.line} | ", shown
    if not column:
        return escape(before + rest)
    at = column - 1 - first
    mark = shown[at : at + length]
    colour = _COLOURS[item.severity]
    return (
        f"{escape(before + shown[:at])}"
        f'<span style="text-decoration:underline wavy {colour}">{escape(mark)}</span>'
        f"{escape(shown[at + length :])}"
    )
