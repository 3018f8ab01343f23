"""Tables about a world that has come up."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.diagnostics import Diagnostic
from gazelle.doctor.coverage import plugins_section, tags_section
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.report import Section

__all__ = ["simulation_sections"]


def simulation_sections(
    start: DryStart, findings: Iterable[Diagnostic], *, subject: str
) -> tuple[Section, ...]:
    """Return the tables of plug-ins, tags without effect and controllers.

    Args:
        start: the world.
        findings: of bringing it up.
        subject: what the tables are about.
    """
    found = tuple(findings)
    return (
        plugins_section(start.world, found, subject=subject),
        tags_section(found, subject=subject),
        _controllers(start, subject),
    )


def _controllers(start: DryStart, subject: str) -> Section:
    rows = tuple(
        (manager.namespace, name, kind, state or "not started", ", ".join(joints))
        for manager in start.managers
        for name, kind, state, joints in manager.rows
    )
    columns = ("namespace", "controller", "type", "state", "joints")
    return Section("controllers", "controllers", columns, rows, subject)
