"""The table of all links that were checked."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from gazelle.description.checks.inertia import InertiaFinding
from gazelle.description.checks.inertia_units import box_fit
from gazelle.description.checks.written_inertials import LinkRecord
from gazelle.geometry import is_legal_inertia

__all__ = ["link_rows", "table"]

_HEADS = {
    "link": "link",
    "mass_kg": "mass kg",
    "density_kg_m3": "kg/m³",
    "equivalent_box_m": "equivalent box m",
    "bounding_box_m": "shapes along its axes m",
    "verdict": "verdict",
}
_GAP = "  "


def link_rows(
    records: Iterable[LinkRecord], findings: Iterable[InertiaFinding]
) -> list[dict[str, Any]]:
    """Return one row per link; None stands for what cannot be told."""
    codes: dict[int, list[str]] = {}
    for finding in findings:
        short = finding.diagnostic.code.removeprefix("inertia.")
        codes.setdefault(id(finding.record), []).append(short)
    return [_row(record, codes.get(id(record), [])) for record in records]


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


def table(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return the rows as text, columns aligned."""
    shown = [list(_HEADS.values()), *([_text(row[key]) for key in _HEADS] for row in rows)]
    widths = [max(len(line[column]) for line in shown) for column in range(len(_HEADS))]
    lines = (
        _GAP.join(word.ljust(width) for word, width in zip(line, widths, strict=True)).rstrip()
        for line in shown
    )
    return "\n".join(lines)


def _text(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, tuple):
        return " × ".join(f"{item:.3g}" for item in value)
    return value if isinstance(value, str) else f"{value:.4g}"
