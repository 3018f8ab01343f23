"""What sdformat writes to the terminal while it works: coloured lines and errors with codes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description.sdformat_emulation.release import Release

__all__ = ["Code", "Console", "SdfError", "error_line"]

# Lines of sdformat 9.3 and 12.3 that a message comes from: both print them.
_SOURCE_LINES: dict[str, tuple[str, int, int]] = {
    "find-file": ("parser.cc", 386, 701),
    "no-file": ("parser.cc", 397, 712),
    "parse-xml": ("parser.cc", 403, 719),
    "parse-old": ("parser.cc", 425, 741),
    "callback": ("SDF.cc", 165, 160),
    "unknown-attribute": ("parser.cc", 866, 0),
    "policy-bare": ("Utils.cc", 0, 112),
    "policy-path": ("Utils.cc", 0, 116),
    "policy-line": ("Utils.cc", 0, 129),
    "newer-model": ("parser.cc", 702, 1143),
    "no-sdf-tag": ("parser.cc", 714, 1155),
    "no-config-version": ("parser.cc", 723, 1164),
    "no-config": ("parser.cc", 749, 1190),
    "manifest": ("parser.cc", 755, 1197),
    "parse-config": ("parser.cc", 764, 1206),
    "no-config-model": ("parser.cc", 774, 1216),
    "convert": ("Converter.cc", 113, 156),
    "deprecated": ("Converter.cc", 761, 1100),
    "bool": ("Param.cc", 319, 673),
    "stream": ("Param.cc", 0, 399),
    "color-word": ("Param.cc", 0, 434),
    "color": ("Param.cc", 0, 467),
    "degrees-of-quaternion": ("Param.cc", 0, 534),
    "rotation-format": ("Param.cc", 0, 524),
    "pose-word": ("Param.cc", 0, 560),
    "pose-infinite": ("Param.cc", 0, 576),
    "pose-many": ("Param.cc", 0, 583),
    "pose-few": ("Param.cc", 0, 598),
    "invalid": ("Param.cc", 430, 771),
    "range": ("Param.cc", 438, 779),
    "empty": ("Param.cc", 454, 925),
    "least": ("Param.cc", 0, 1102),
    "most": ("Param.cc", 0, 1113),
    "model-names": ("Model.cc", 0, 174),
    "link-collision": ("Model.cc", 0, 239),
    "link-renamed": ("Model.cc", 0, 231),
    "joint-collision": ("Model.cc", 0, 286),
    "joint-renamed": ("Model.cc", 0, 278),
    "frame-collision": ("Model.cc", 0, 323),
    "frame-renamed": ("Model.cc", 0, 315),
    "world-names": ("World.cc", 0, 206),
    "world-names-again": ("World.cc", 0, 217),
    "world-frame-renamed": ("World.cc", 0, 288),
    "no-spec": ("SDF.cc", 461, 443),
    "no-spec-element": ("parser.cc", 159, 437),
}
# So many lines further down stand those of Utils.cc in sdformat 14.
_UTILS_MOVED = 3


class Code:
    """Numbers of errors, as printed behind ``Error Code``."""

    FILE_READ = 1
    DUPLICATE_NAME = 2
    RESERVED_NAME = 3
    ATTRIBUTE_MISSING = 4
    ATTRIBUTE_INVALID = 5
    ATTRIBUTE_INCORRECT_TYPE = 7
    ELEMENT_MISSING = 8
    ELEMENT_INVALID = 9
    ELEMENT_DEPRECATED = 10
    ELEMENT_INCORRECT_TYPE = 11
    URI_INVALID = 12
    URI_LOOKUP = 13
    DIRECTORY_NONEXISTENT = 14
    MODEL_CANONICAL_LINK_INVALID = 15
    MODEL_WITHOUT_LINK = 16
    LINK_INERTIA_INVALID = 18
    JOINT_CHILD_LINK_INVALID = 19
    JOINT_PARENT_LINK_INVALID = 20
    JOINT_PARENT_SAME_AS_CHILD = 21
    FRAME_ATTACHED_TO_INVALID = 22
    FRAME_ATTACHED_TO_CYCLE = 23
    FRAME_ATTACHED_TO_GRAPH_ERROR = 24
    POSE_RELATIVE_TO_INVALID = 25
    POSE_RELATIVE_TO_CYCLE = 26
    POSE_RELATIVE_TO_GRAPH_ERROR = 27
    MODEL_PLACEMENT_FRAME_INVALID = 29
    MERGE_INCLUDE_UNSUPPORTED = 31


# Codes of release 12 whose number sdformat 14 gives to an error of its own.
_NEW_IN_14 = (Code.URI_INVALID, 28)


class SdfError(NamedTuple):
    """An error with its number and, where sdformat knows it, its place.

    Attributes:
        code: one of `Code`.
        message: may end with a line break, as some of sdformat's do.
        xml_path: such as ``/sdf/model[@name="m"]``.
        file: path of the file.
        line: counted from 1; 0 when it is not known.
    """

    code: int
    message: str
    xml_path: str = ""
    file: str = ""
    line: int = 0

    def __str__(self) -> str:
        location = self.xml_path
        location += f":{self.file}" if self.file else ""
        location += f":L{self.line}" if self.line else ""
        return (
            f"Error Code {self.code}: "
            + (f"[{location}]: " if location else "")
            + (f"Msg: {self.message}")
        )


@dataclass(slots=True)
class Console:
    """The terminal of one run.

    Attributes:
        release: decides about the places behind labels.
        lines: everything written so far, in order, with escape sequences for colours.
    """

    release: Release
    lines: list[str] = field(default_factory=list)

    def error(self, location: str, text: str) -> None:
        """Write a red line."""
        self._write("31mError", location, text)

    def warn(self, location: str, text: str) -> None:
        """Write a yellow line."""
        self._write("33mWarning", location, text)

    def plain(self, text: str) -> None:
        """Write a line without colour."""
        self.lines.append(text)

    def _write(self, label: str, location: str, text: str) -> None:
        file, old, new = _SOURCE_LINES[location]
        line = old if self.release is Release.V9 else new
        if self.release is Release.V14 and file == "Utils.cc":
            line += _UTILS_MOVED
        self.lines.append(f"\033[1;{label} [{file}:{line}]\033[0m {text}")


def error_line(error: SdfError, release: Release) -> str:
    """Return the line that a release prints for an error.

    Release 9 prints no places, and its numbers have no `Code.ATTRIBUTE_INCORRECT_TYPE`; 14 has two
    more in between.
    """
    if release is Release.V14:
        more = sum(error.code >= first for first in _NEW_IN_14)
        return str(error._replace(code=error.code + more))
    if release.is_new:
        return str(error)
    number = error.code - (error.code > Code.ATTRIBUTE_INCORRECT_TYPE)
    return f"Error Code {number} Msg: {error.message}"
