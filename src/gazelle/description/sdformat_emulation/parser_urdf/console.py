"""What sdformat writes to standard error while it converts a robot description."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.release import Release

__all__ = ["Console"]

_COLOURS = {"Warning": 33, "Error": 31}

# Message → line of parser_urdf.cc in sdformat 9.3.0 and 12.3.0 (the last two in 14): people search
# for them.
_LINES = {
    "no vector": (283, 288),
    "collision twice": (357, 362),
    "visual twice": (390, 395),
    "overwritten": (1137, 1139),
    "no text": (0, 1189),
    "cfmDamping": (1472, 1480),
    "no filename": (2348, 2364),
    "limits swapped": (3037, 3023),
    "sensor without pose": (0, 3398),
    "bad sensor pose": (0, 3413),
    "projector without pose": (0, 3497),
    "bad projector pose": (0, 3512),
    "no slash": (3579, 3719),
    "massless": (0, 2774),
    "left out": (0, 2777),
}


@dataclass(slots=True)
class Console:
    """Collects the remarks of one conversion.

    Attributes:
        release: whose line numbers are printed.
        remarks: what the program prints, without line breaks at their ends.
    """

    release: Release
    remarks: list[str] = field(default_factory=list)

    def warning(self, what: str, message: str) -> None:
        """Add a warning; `what` names the place in the library's source."""
        self._add("Warning", what, message)

    def error(self, what: str, message: str) -> None:
        """Add an error."""
        self._add("Error", what, message)

    def _add(self, level: str, what: str, message: str) -> None:
        line = _LINES[what][self.release.is_new]
        prefix = f"\033[1;{_COLOURS[level]}m{level} [parser_urdf.cc:{line}]\033[0m"
        self.remarks.append(f"{prefix} {message}")
