"""What an examination is asked for, carries from check to check, and reports."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor.script_topics import TopicEnd
from gazelle.rich_display import shown_by
from gazelle.workspace import Workspace

__all__ = ["Examination", "Options", "Report", "Section"]

_EXIT_CODES = {None: 0, Severity.INFO: 0, Severity.WARNING: 1, Severity.ERROR: 2}


@dataclass(frozen=True, slots=True)
class Options:
    """Choices of one examination.

    Attributes:
        arguments: ``name:=value`` words: arguments of a launch file or of a xacro file.
        probe: let short simulations run as well.
        world: world that a robot on its own is put into for the dry start and the probes.
        environ: environment that launch files and the search for a ROS see.
    """

    arguments: Mapping[str, str] = field(default_factory=dict)
    probe: bool = False
    world: str = "empty"
    environ: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))


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


@shown_by("findings:report_bundle")
@dataclass(frozen=True, slots=True)
class Report:
    """Everything said about a target.

    Attributes:
        target: what was examined, as the user named it.
        kind: ``launch``, ``package``, ``workspace``, ``robot``, ``world``, ``parameters`` or
            ``semantics`` (SRDF).
        findings: in the order found, each once.
        consequences: what follows from findings and goes with them.
        sections: tables, empty ones left out.
        sources: texts of findings' places that are no files, by name.
    """

    target: str
    kind: str
    findings: tuple[Diagnostic, ...]
    sections: tuple[Section, ...] = ()
    sources: tuple[tuple[str, str], ...] = ()
    consequences: tuple[Diagnostic, ...] = ()

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


def _say_nothing(_text: str) -> None:
    """Nobody wants to hear of the progress."""


@dataclass(slots=True)
class Examination:
    """One examination: where things are found, what has been found.

    Attributes:
        workspace: finds packages, models and worlds.
        options: what the caller chose.
        diagnostics: receives every finding.
        sections: tables of the report, in the order made.
        seen: files that have been examined, alone or as part of something else.
        launch_topics: what is known of the topics of all launches.
        simulated: topics of the simulator with a robot or world, by file and its arguments.
        is_wide: a whole package is looked at, and nobody has given arguments for its files.
        say: told what is being looked at, for a person who waits.
    """

    workspace: Workspace
    options: Options = field(default_factory=Options)
    diagnostics: Diagnostics = field(default_factory=Diagnostics)
    sections: list[Section] = field(default_factory=list)
    seen: set[Path] = field(default_factory=set)
    launch_topics: list[TopicEnd] = field(default_factory=list)
    simulated: dict[tuple[Path, frozenset[tuple[str, str]]], tuple[TopicEnd, ...]] = field(
        default_factory=dict
    )
    is_wide: bool = False
    say: Callable[[str], None] = _say_nothing

    def see(self, path: Path) -> bool:
        """Note that a file is examined; False when it has been before."""
        place = path.resolve()
        is_new = place not in self.seen
        self.seen.add(place)
        return is_new

    def add(self, *sections: Section) -> None:
        """Keep the tables that have rows."""
        self.sections += [section for section in sections if section.rows]
