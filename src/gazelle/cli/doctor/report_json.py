"""A report as JSON, whose shape programs may rely on (docs/howto/doctor.md)."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostic, Severity

if TYPE_CHECKING:
    from gazelle.doctor import Report

__all__ = ["SCHEMA", "json_text"]

SCHEMA = 1
"""Counts up when a key changes its meaning or goes; new keys may come at any time."""


def json_text(report: Report, least: Severity = Severity.INFO) -> str:
    """Return a report as JSON.

    Args:
        report: what was found.
        least: findings below it are left out; counts and exit code are those of all.
    """
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
