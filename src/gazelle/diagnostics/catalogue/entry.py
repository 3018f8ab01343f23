"""What the catalogue knows about one diagnostic code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["Entry"]


@dataclass(frozen=True, slots=True)
class Entry:
    """One code of the catalogue.

    Attributes:
        code: ``<area>.<what-is-wrong>``, stable for ever.
        severity: default severity.
        title: one line for the docs' headline.
        why: why it matters and what Gazelle does about it.
        fix: the general remedy.
        phrase: the words ROS or Gazebo print in this case, empty when they are silent.
        idle: it says of a setting that it is known and has no effect here; at a start such findings
            are summed, see `gazelle.diagnostics.brief`.
        quiet: it says of something that it is done, or that nothing is to be done about it; at a
            start it goes to the log file alone.
    """

    code: str
    severity: Literal["info", "warning", "error"]
    title: str
    why: str
    fix: str
    phrase: str = ""
    idle: bool = False
    quiet: bool = False
