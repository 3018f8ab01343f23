"""``gazelle inertia --check FILE``: findings, a table of all links, a patch."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

from gazelle.description.checks.inertia import (
    SUPERSEDED_CODES,
    InertiaFinding,
    check_inertia,
    check_mass_ratios,
)
from gazelle.description.checks.inertia_patch import Patch, make_patch
from gazelle.description.checks.inertia_units import box_fit
from gazelle.description.checks.source_elements import read_checked_source
from gazelle.description.checks.written_inertials import LinkRecord, joint_records_of, records_of
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan, render
from gazelle.geometry import is_legal_inertia
from gazelle.workspace import Workspace

__all__ = [
    "check",
]

_HEADS = {
    "link": "link",
    "mass_kg": "mass kg",
    "density_kg_m3": "kg/m³",
    "equivalent_box_m": "equivalent box m",
    "bounding_box_m": "shapes along its axes m",
    "verdict": "verdict",
}
_GAP = "  "
_EXIT_CODES = {None: 0, Severity.INFO: 0, Severity.WARNING: 1, Severity.ERROR: 2}


def _link_rows(
    records: Iterable[LinkRecord], findings: Iterable[InertiaFinding]
) -> list[dict[str, Any]]:
    """Return one row per link; None stands for what cannot be told."""
    codes: dict[int, list[str]] = {}
    for finding in findings:
        short = finding.diagnostic.code.removeprefix("inertia.")
        codes.setdefault(id(finding.record), []).append(short)
    return [_row(record, codes.get(id(record), [])) for record in records]


def _table(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return the rows as text, columns aligned."""
    shown = [list(_HEADS.values()), *([_text(row[key]) for key in _HEADS] for row in rows)]
    widths = [max(len(line[column]) for line in shown) for column in range(len(_HEADS))]
    lines = (
        _GAP.join(word.ljust(width) for word, width in zip(line, widths, strict=True)).rstrip()
        for line in shown
    )
    return "\n".join(lines)


def check(options: argparse.Namespace, mappings: Mapping[str, str]) -> int:
    """Judge every link of a file.

    Returns:
        0 when nothing is wrong, 1 after warnings, 2 after errors.
    """
    read, all_findings = Diagnostics(), Diagnostics()
    records: tuple[LinkRecord, ...] = ()
    findings: tuple[InertiaFinding, ...] = ()
    workspace = Workspace.discover()
    path = _located(options.check, workspace, read)
    if path is not None:
        source = read_checked_source(path, workspace=workspace, diagnostics=read, mappings=mappings)
        records = records_of(source.models, source.find_tag, read)
        findings = check_inertia(records, density_kg_m3=options.density)
        ratios = check_mass_ratios(joint_records_of(source.models, source.find_tag))
    for item in read:
        if _concerns_us(item):
            all_findings.add(item)
    for finding in findings:
        all_findings.add(finding.diagnostic)
    if path is not None:
        all_findings.extend(ratios)
    patch = make_patch(findings) if options.fix or options.output else None
    _show(options, records, findings, all_findings, patch)
    return _EXIT_CODES[all_findings.worst]


def _row(record: LinkRecord, codes: Sequence[str]) -> dict[str, Any]:
    written = record.written
    mass = None if written is None or not math.isfinite(written.mass_kg) else written.mass_kg
    row: dict[str, Any] = dict.fromkeys(_HEADS)
    row |= {"link": record.name, "mass_kg": mass, "verdict": ", ".join(codes) or _quiet(record)}
    if mass is None or mass <= 0.0 or written is None:
        return row
    if record.volumes_m3:
        row["density_kg_m3"] = mass / record.volumes_m3[0]
    points = record.points_m if record.extent_m > 0.0 else None
    if points is not None and is_legal_inertia(written.inertia_kg_m2):
        fit = box_fit(written.body, points)
        row |= {"equivalent_box_m": fit.equivalent_m, "bounding_box_m": fit.bounding_m}
    return row


def _quiet(record: LinkRecord) -> str:
    if record.is_computed:
        return "ok (computed from its collisions)"
    if record.has_unreadable:
        return "unreadable"
    if record.written is None:
        return "ok (a frame without mass)"
    return "ok" if record.extent_m > 0.0 else "ok (no shapes to compare with)"


def _text(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, tuple):
        return " × ".join(f"{item:.3g}" for item in value)
    return value if isinstance(value, str) else f"{value:.4g}"


def _located(name: str, workspace: Workspace, diagnostics: Diagnostics) -> Path | None:
    path = Path(name)
    if path.exists():
        return path
    found = workspace.resolve(name)
    if found.path is None:
        message = f"robot or model {found.explain(name)}"
        diagnostics.report("load.not-found", message, SourceSpan(name))
    return found.path


def _concerns_us(item: Diagnostic) -> bool:
    """Keep what stops the checks: errors, and shapes that could not be read."""
    about_shapes = item.code.startswith("mesh.") or "mesh-missing" in item.code
    about_shapes = about_shapes or item.code == "sdf.missing-file"
    serious = item.severity is Severity.ERROR or about_shapes
    return serious and item.code not in SUPERSEDED_CODES


def _show(
    options: argparse.Namespace,
    records: Sequence[LinkRecord],
    findings: Sequence[InertiaFinding],
    diagnostics: Diagnostics,
    patch: Patch | None,
) -> None:
    # The patch owns standard output unless it goes to a file.
    stream: TextIO = sys.stderr if patch is not None and not options.output else sys.stdout
    if options.json:
        print(_json(records, findings, diagnostics), file=stream)
    else:
        render(diagnostics, stream=stream)
        if records:
            print(_table(_link_rows(records, findings)), file=stream)
        print(_verdict(diagnostics, len(records)), file=stream)
    if patch is not None:
        _write(patch, options.output)


def _verdict(diagnostics: Diagnostics, links: int) -> str:
    errors = len(diagnostics.errors)
    warnings = sum(item.severity is Severity.WARNING for item in diagnostics)
    counts = f"{links} link{'s' * (links != 1)}: "
    if not errors and not warnings:
        return counts + "nothing is wrong"
    return f"{counts}{errors} error{'s' * (errors != 1)}, {warnings} warning{'s' * (warnings != 1)}"


def _write(patch: Patch, output: str | None) -> None:
    for note in patch.notes:
        print(note, file=sys.stderr)
    # Bytes: line ends and foreign encodings of the files stay as they are.
    data = patch.text.encode("utf-8", "surrogateescape")
    if output:
        Path(output).write_bytes(data)
    else:
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
    if not patch.text:
        print("there is nothing to patch", file=sys.stderr)
        return
    option = "" if patch.folder == Path().resolve() else f" -d {patch.folder}"
    command = f"patch -p0{option} < {output or 'THE_PATCH'}"
    print(f"changes {', '.join(patch.links)}; apply with: {command}", file=sys.stderr)


def _json(
    records: Sequence[LinkRecord], findings: Sequence[InertiaFinding], diagnostics: Diagnostics
) -> str:
    return json.dumps(
        {
            "links": _link_rows(records, findings),
            "findings": [
                {
                    "code": item.code,
                    "severity": str(item.severity),
                    "message": item.message,
                    "file": item.span.file if item.span else None,
                    "line": item.span.line if item.span else None,
                    "column": item.span.column if item.span else None,
                    "fix": item.fix,
                    "phrase": item.phrase,
                }
                for item in diagnostics
            ],
        },
        indent=2,
    )
