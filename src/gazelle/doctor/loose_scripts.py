"""Scripts of a package that no launch file of it starts: people run them beside the launches."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor.file_kinds import looks_like
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.script_topics import TopicEnd, read_script
from gazelle.doctor.topic_checks import check_topic_names, check_topic_types
from gazelle.graph.names import resolve
from gazelle.workspace import Package
from gazelle.workspace.entry_points import console_scripts

__all__ = ["check_loose_scripts"]


def check_loose_scripts(
    package: Package, launched: Sequence[TopicEnd], diagnostics: Diagnostics
) -> None:
    """Compare topics of scripts that are run by hand with those of a package's launches.

    Args:
        package: whose scripts.
        launched: topics of the launches that were examined.
        diagnostics: receives the findings.
    """
    source = SourcePackage(package)
    files = _loose(source)
    own = [end for file in files for end in _ends(file)]
    if not own:
        return
    found = Diagnostics()
    ros_version = 2 if source.is_ros2 else 1
    ends = [*launched, *own]
    if launched:
        for end in own:
            check_topic_types([*launched, end], found, ros_version=ros_version)
    check_topic_names(ends, found, is_whole=False, where="here")
    names = {str(file) for file in files}
    for item in found:
        if item.span is not None and item.span.file in names:
            # Who runs it, and beside what, is up to a person.
            diagnostics.add(replace(item, severity=Severity.WARNING))


def _loose(source: SourcePackage) -> list[Path]:
    """Return the Python files that no launch file names, by file or by console script."""
    launches = [name for name in source.files if "launch" in name and looks_like(Path(name))]
    text = "\n".join(source.text(name) for name in launches)
    started = set(re.findall(r"\w+", text))
    scripts = {
        target.partition(":")[0].strip().rpartition(".")[2]: name
        for name, target in console_scripts(source.folder).items()
    }
    return [
        source.folder / name
        for name in source.files
        if name.endswith(".py")
        and not source.is_test(name)
        and not looks_like(Path(name))
        and not {Path(name).stem, scripts.get(Path(name).stem, "")} & started
    ]


def _ends(file: Path) -> list[TopicEnd]:
    return [
        TopicEnd(file.name, resolve(use.name, "/"), use.type, use.publishes, use)
        for use in read_script(file).uses
        if not use.name.startswith("~")
    ]
