"""One finding about a user's file."""

from __future__ import annotations

import enum
from dataclasses import dataclass, replace

from gazelle.diagnostics.share_links import as_written
from gazelle.rich_display import shown_by

__all__ = ["Diagnostic", "Severity", "SourceSpan"]


@dataclass(frozen=True, slots=True, order=True)
class SourceSpan:
    """A place in a file.

    Attributes:
        file: path as the user knows it, or a name in angle brackets such as
            ``<robot_description>`` for a text that has no file.
        line: line number from 1; 0 when only the file is known.
        column: column from 1; 0 when only the line is known.
        length: characters to underline; 0 when unknown.
        via: how one got there: include and macro stack, innermost first.
    """

    file: str
    line: int = 0
    column: int = 0
    length: int = 0
    via: tuple[SourceSpan, ...] = ()

    def __str__(self) -> str:
        text = self.file
        if self.line:
            text += f":{self.line}"
            if self.column:
                text += f":{self.column}"
        return text

    def as_written(self) -> SourceSpan:
        """Return the place in the user's file where `file` is a link to it."""
        file, via = as_written(self.file), tuple(item.as_written() for item in self.via)
        if file == self.file and via == self.via:
            return self
        return replace(self, file=file, via=via)


class Severity(enum.IntEnum):
    """How bad a finding is; ordered, so that the worst one can be asked for."""

    INFO = 10
    WARNING = 20
    ERROR = 30

    def __str__(self) -> str:
        return self.name.lower()


@shown_by("findings:finding_bundle")
@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A finding: what, where, why and how to fix it.

    Attributes:
        code: stable code with an entry in `gazelle.diagnostics.catalogue`.
        severity: how bad it is.
        message: what is wrong and what Gazelle does about it, one or two sentences.
        span: where, or None when no file is to blame.
        fix: what to write instead, or an empty string.
        phrase: the words ROS or Gazebo would have printed, for people who search for them.
    """

    code: str
    severity: Severity
    message: str
    span: SourceSpan | None = None
    fix: str = ""
    phrase: str = ""

    def __str__(self) -> str:
        place = f"{self.span}: " if self.span else ""
        text = f"{place}{self.severity}: {self.message} [{self.code}]"
        if self.fix:
            text += f"\n  fix: {self.fix}"
        if self.phrase:
            text += f"\n  ROS/Gazebo says: {self.phrase}"
        return text
