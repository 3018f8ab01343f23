"""One finding about a user's file."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from gazelle.diagnostics.span import SourceSpan

__all__ = ["Diagnostic", "Severity"]


class Severity(enum.IntEnum):
    """How bad a finding is; ordered, so that the worst one can be asked for."""

    INFO = 10
    WARNING = 20
    ERROR = 30

    def __str__(self) -> str:
        return self.name.lower()


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
