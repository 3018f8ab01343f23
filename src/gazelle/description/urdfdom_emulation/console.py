"""What urdfdom writes to standard error while it reads a file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

__all__ = ["Console", "Rejected", "Remark"]

_FOLDER = "./urdf_parser/src/"


class Rejected(Exception):  # noqa: N818 - no error of ours: urdfdom's way of giving up on a part
    """A part of the file was refused; the reason is on the console already."""


class Remark(NamedTuple):
    """One message with the line of urdfdom 3.0.1's source it comes from.

    People search for both, so both are printed.
    """

    level: str
    message: str
    source: str
    line: int

    def __str__(self) -> str:
        return f"{self.level + ':':<9}{self.message}\n         at line {self.line} in {self.source}"


@dataclass(slots=True)
class Console:
    """Collects the remarks of one run."""

    remarks: list[Remark] = field(default_factory=list)

    def error(self, source_line: tuple[str, int], message: str) -> None:
        """Add an error; `source_line` is the source file's name and the line."""
        self.remarks.append(
            Remark("Error", message, f"{_FOLDER}{source_line[0]}.cpp", source_line[1])
        )

    def warning(self, source_line: tuple[str, int], message: str) -> None:
        """Add a warning."""
        self.remarks.append(
            Remark("Warning", message, f"{_FOLDER}{source_line[0]}.cpp", source_line[1])
        )

    def reject(self, source_line: tuple[str, int], message: str) -> Rejected:
        """Add an error and return what is to be raised."""
        self.error(source_line, message)
        return Rejected(message)
