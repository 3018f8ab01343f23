"""What an examination found."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.diagnostics import Diagnostic, Severity

__all__ = ["Report", "Section"]

_EXIT_CODES = {None: 0, Severity.INFO: 0, Severity.WARNING: 1, Severity.ERROR: 2}


@dataclass(frozen=True, slots=True)
class Section:
    """A table of a report, such as what is done with each plug-in.

    Attributes:
        name: stable name of the kind of table, in ``--json`` too.
        title: headline.
        columns: names of the columns.
        rows: cells, one text per column.
        subject: the file, launch or package the table is about; empty for the whole target.
    """

    name: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    subject: str = ""


@dataclass(frozen=True, slots=True)
class Report:
    """Everything said about a target.

    Attributes:
        target: what was examined, as the user named it.
        kind: ``launch``, ``package``, ``workspace``, ``robot``, ``world``, ``parameters`` or
            ``semantics`` (SRDF).
        findings: in the order found, each once.
        sections: tables, empty ones left out.
        sources: texts of findings' places that are no files, by name.
    """

    target: str
    kind: str
    findings: tuple[Diagnostic, ...]
    sections: tuple[Section, ...] = ()
    sources: tuple[tuple[str, str], ...] = ()

    @property
    def worst(self) -> Severity | None:
        """The highest severity, None when nothing was found."""
        return max((item.severity for item in self.findings), default=None)

    @property
    def exit_code(self) -> int:
        """0 when nothing is worse than a notice, 1 with warnings, 2 with errors."""
        return _EXIT_CODES[self.worst]

    def count(self, severity: Severity) -> int:
        """Return how many findings have a severity."""
        return sum(item.severity is severity for item in self.findings)
