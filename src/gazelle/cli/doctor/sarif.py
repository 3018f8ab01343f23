"""A report as SARIF 2.1.0, the form that code scanning and editors take findings in.

A result is a finding that stands for itself. What follows from others goes with them and is left
out: it would be annotated at places where nothing is wrong.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from gazelle._version import __version__
from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.catalogue import Entry, entry_for
from gazelle.diagnostics.documentation import entry_address, pages_address

if TYPE_CHECKING:
    from gazelle.doctor import Report

__all__ = ["sarif_text"]

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_VERSION = "2.1.0"
_ROOT = "SRCROOT"
# Code scanning takes no result without a file: what is about none is about the folder.
_NO_FILE = "."
_LEVELS = {Severity.INFO: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}


def sarif_text(report: Report, least: Severity = Severity.INFO) -> str:
    """Return a report as SARIF; files below the current folder are named relative to it.

    Args:
        report: what was found.
        least: findings below it are left out.
    """
    here = Path.cwd()
    findings = [item for item in report.findings if item.severity >= least]
    codes = sorted({item.code for item in findings})
    run = {
        "tool": {"driver": _driver(codes)},
        "automationDetails": {"id": f"gazelle doctor {report.target}/"},
        "invocations": [{"executionSuccessful": True, "exitCode": report.exit_code}],
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {_ROOT: {"uri": f"{here.as_uri().rstrip('/')}/"}},
        "results": [_result(item, codes.index(item.code), here) for item in findings],
    }
    log = {"$schema": _SCHEMA, "version": _VERSION, "runs": [run]}
    return json.dumps(log, indent=2, ensure_ascii=False)


def _driver(codes: Sequence[str]) -> dict[str, Any]:
    pages = pages_address()
    return {
        "name": "gazelle doctor",
        "semanticVersion": __version__,
        **({"informationUri": f"{pages}/howto/doctor/"} if pages else {}),
        "rules": [_rule(entry_for(code), pages) for code in codes],
    }


def _rule(entry: Entry, pages: str) -> dict[str, Any]:
    said = f"ROS/Gazebo says: `{entry.phrase}`" if entry.phrase else ""
    markdown = "\n\n".join(text for text in (entry.why, f"Fix: {entry.fix}.", said) if text)
    return {
        "id": entry.code,
        "shortDescription": {"text": f"{entry.title}."},
        "fullDescription": {"text": entry.why},
        "help": {"text": markdown.replace("`", ""), "markdown": markdown},
        **({"helpUri": entry_address(entry, pages)} if pages else {}),
        "defaultConfiguration": {"level": _LEVELS[Severity[entry.severity.upper()]]},
    }


def _result(item: Diagnostic, rule: int, here: Path) -> dict[str, Any]:
    fix = f"\nfix: {item.fix}" if item.fix else ""
    via = item.span.via if item.span else ()
    related = [
        {"id": at, "message": {"text": "from here"}, **_location(span, here)}
        for at, span in enumerate(via, 1)
    ]
    return {
        "ruleId": item.code,
        "ruleIndex": rule,
        "level": _LEVELS[item.severity],
        "message": {"text": f"{item.message}{fix}"},
        "locations": [_location(item.span, here)],
        **({"relatedLocations": related} if related else {}),
        **({"properties": {"phrase": item.phrase}} if item.phrase else {}),
    }


def _location(span: SourceSpan | None, here: Path) -> dict[str, Any]:
    if span is None or not _is_file_name(span.file):
        named = {"logicalLocations": [{"fullyQualifiedName": span.file}]} if span else {}
        return {"physicalLocation": {"artifactLocation": _below_root(_NO_FILE)}, **named}
    place: dict[str, Any] = {"artifactLocation": _artifact(Path(span.file), here)}
    if span.line:
        place["region"] = _region(span)
    return {"physicalLocation": place}


def _region(span: SourceSpan) -> dict[str, int]:
    region = {"startLine": span.line}
    if span.column:
        region["startColumn"] = span.column
        if span.length:
            region["endColumn"] = span.column + span.length
    return region


def _artifact(file: Path, here: Path) -> dict[str, str]:
    path = here / file
    if path.is_relative_to(here):
        return _below_root(quote(path.relative_to(here).as_posix()))
    return {"uri": path.as_uri()}


def _below_root(uri: str) -> dict[str, str]:
    return {"uri": uri, "uriBaseId": _ROOT}


def _is_file_name(name: str) -> bool:
    """Tell a file from the name of a text that has none, such as ``<robot_description>``."""
    return bool(name) and not name.startswith("<")
