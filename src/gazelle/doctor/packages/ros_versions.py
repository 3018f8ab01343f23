"""Which ROS each part of a package was written for, and why one thinks so."""

from __future__ import annotations

import re
from pathlib import PurePosixPath
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.packages.signs import SIGNS, Sign
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.report import Section

__all__ = ["VersionSign", "check_ros_versions", "ros_versions_section", "version_signs"]

_COLUMNS = ("part", "written for", "why", "what Gazelle does")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_FORMATS = {
    0: ("Fuerte and before", "manifest.xml is rosbuild's", "found by rospack's rules"),
    1: ("Groovy and later", "package.xml of format 1 is catkin's", "read"),
    2: ("Indigo and later", "package.xml of format 2", "read"),
    3: ("Melodic and later", "package.xml of format 3", "read"),
}


class VersionSign(NamedTuple):
    """A part of a package and its ROS.

    Attributes:
        part: ``package``, ``launch``, ``description``, ``code`` or ``parameters``.
        written_for: distributions, in words.
        ros_version: 1, 2, or 0 when it tells nothing about it.
        why: the sign, in words.
        here: what Gazelle does with it.
        spans: where the sign stands, once per file.
        is_strict: the other generation cannot use such a file.
    """

    part: str
    written_for: str
    ros_version: int
    why: str
    here: str
    spans: tuple[SourceSpan, ...]
    is_strict: bool


def version_signs(source: SourcePackage) -> tuple[VersionSign, ...]:
    """Return every sign found, the manifest's first; each with all its places."""
    found: dict[Sign, list[SourceSpan]] = {}
    for name in source.files:
        if "test" in PurePosixPath(name).parts or name == "package.xml":
            continue
        signs = [sign for sign in SIGNS if name.endswith(sign.endings)]
        text = _COMMENT.sub(_blanked, source.text(name)) if signs else ""
        for sign in signs:
            place = sign.pattern.search(text)
            if place is not None:
                found.setdefault(sign, []).append(_span(source, name, text, place))
    rows = (
        VersionSign(
            sign.part,
            sign.written_for,
            sign.ros_version,
            sign.why,
            sign.here,
            tuple(spans),
            sign.is_strict,
        )
        for sign, spans in found.items()
    )
    order = ("launch", "description", "code", "parameters")
    return (_of_manifest(source), *sorted(rows, key=lambda row: order.index(row.part)))


def ros_versions_section(source: SourcePackage) -> Section:
    """Return the table of a package's generations."""
    rows = tuple(
        (row.part, row.written_for, f"{row.why} ({_places(source, row.spans)})", row.here)
        for row in version_signs(source)
    )
    return Section("generations", f"{source.package.name}: written for", _COLUMNS, rows)


def check_ros_versions(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report files of one generation in a package that is built for the other."""
    if _serves_both(source):
        return
    own = 2 if source.is_ros2 else 1
    seen: set[str] = set()
    for row in version_signs(source)[1:]:
        if not row.is_strict or row.ros_version in {0, own}:
            continue
        for span in row.spans:
            if span.file in seen:
                continue
            seen.add(span.file)
            _report_mixed(source, row, span, diagnostics)


def _report_mixed(
    source: SourcePackage, row: VersionSign, span: SourceSpan, diagnostics: Diagnostics
) -> None:
    name = span.file.removeprefix(f"{source.folder}/")
    other = "ROS 1" if row.ros_version == 1 else "ROS 2"
    own = "ROS 2" if row.ros_version == 1 else "ROS 1"
    text = f"'{name}' is written for {other} ({row.why}), the package is built for {own} "
    text += f"({source.build_type}); a real {own} cannot use the file"
    diagnostics.report("package.generations-mixed", text, span)


def _serves_both(source: SourcePackage) -> bool:
    """Tell a package that is written for both, by conditions in its manifest."""
    root = source.manifest
    if root is None:
        return source.package.format == 0
    if any("condition" in tag.attributes for tag in root.walk()):
        return True
    return source.build_type not in {"ament_cmake", "ament_python", "catkin"}


def _of_manifest(source: SourcePackage) -> VersionSign:
    package = source.package
    written_for, why, here = _FORMATS.get(package.format, _FORMATS[1])
    ros_version = 2 if source.is_ros2 else 1
    if source.is_ros2:
        written_for, why = "ROS 2", f"{why}, build type {source.build_type}"
    elif package.format:
        written_for, why = f"ROS 1 {written_for}", f"{why}, build type {source.build_type}"
    return VersionSign(
        "package", written_for, ros_version, why, here, (source.manifest_span,), True
    )


def _span(source: SourcePackage, name: str, text: str, place: re.Match[str]) -> SourceSpan:
    start = place.start() + len(place.group()) - len(place.group().lstrip())
    line = text.count("\n", 0, start) + 1
    column = start - text.rfind("\n", 0, start)
    length = len(place.group().strip().partition("\n")[0])
    return source.span(name, line, column, length)


def _places(source: SourcePackage, spans: tuple[SourceSpan, ...]) -> str:
    first = spans[0]
    name = first.file.removeprefix(f"{source.folder}/")
    shown = f"{name}:{first.line}" if first.line else name
    return f"{shown} and {len(spans) - 1} more" if len(spans) > 1 else shown


def _blanked(found: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", found[0])
