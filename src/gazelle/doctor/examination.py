"""What one examination carries from check to check."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.options import Options
from gazelle.doctor.report import Section
from gazelle.workspace import Workspace

__all__ = ["Examination"]


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
        is_wide: a whole package is looked at, and nobody has given arguments for its files.
        say: told what is being looked at, for a person who waits.
    """

    workspace: Workspace
    options: Options = field(default_factory=Options)
    diagnostics: Diagnostics = field(default_factory=Diagnostics)
    sections: list[Section] = field(default_factory=list)
    seen: set[Path] = field(default_factory=set)
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
