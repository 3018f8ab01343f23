"""Examining a package or folder: every file in it, each once."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.examine_file import examine_file
from gazelle.doctor.file_kinds import Kind, kind_of, looks_like
from gazelle.doctor.included_files import included_names
from gazelle.doctor.packages import check_package
from gazelle.doctor.parameters import check_package_parameters
from gazelle.doctor.report import Examination
from gazelle.workspace import Package

__all__ = ["examine_folder", "examine_package"]

_ROBOTS = frozenset({".urdf", ".xacro"})
_PRUNED = frozenset({"__pycache__", "build", "devel", "install", "log", "node_modules"})
# Launches come first: what they use is examined as they use it, with their arguments. Parameter
# files and SRDFs are looked at together, beside the robots they are for.
_ORDER = (
    Kind.LAUNCH,
    Kind.LAUNCH_ROS2,
    Kind.ROBOT,
    Kind.WORLD,
    Kind.MODEL,
)


def examine_package(package: Package, examination: Examination) -> None:
    """Examine a package's manifest, launch files, robots, worlds, models and parameters."""
    workspace, diagnostics = examination.workspace, examination.diagnostics
    examination.say(f"package {package.name}")
    sections = check_package(package, workspace=workspace, diagnostics=diagnostics)
    examination.add(*sections)
    examine_folder(package.path, examination, needs_files=False)
    # After the launches: what they load has been seen.
    examination.say(f"parameters of {package.name}")
    names = check_package_parameters(package, workspace=workspace, diagnostics=diagnostics)
    examination.add(*names)


def examine_folder(folder: Path, examination: Examination, *, needs_files: bool = True) -> None:
    """Examine every file in a folder that is of a kind known, each once.

    Args:
        folder: with all below it.
        examination: takes findings and tables.
        needs_files: report a folder that holds nothing to examine.
    """
    examination.is_wide = True
    files = [(path, _kind(path, examination)) for path in _files_below(folder)]
    kinds = [item for item in files if item[1] is not None]
    if not kinds and needs_files:
        text = f"'{folder}' holds no launch file, robot, world, model or parameter file"
        examination.diagnostics.report("doctor.nothing", text, SourceSpan(str(folder)))
    # A file that is no XML includes its pieces all the same.
    pieces = included_names(
        path
        for path, kind in files
        if kind is Kind.ROBOT or (kind is None and path.suffix in _ROBOTS)
    )
    included = included_names(path for path, kind in kinds if kind is Kind.LAUNCH)
    # Files that others include are examined as those include them, with their arguments; a
    # model.config says which file is the model.
    kinds.sort(key=lambda item: (item[0].name in included, item[0].name != "model.config"))
    for wanted in _ORDER:
        for path, kind in kinds:
            if kind is not wanted or path.resolve() in examination.seen:
                continue
            if kind is not Kind.ROBOT:
                examine_file((path,), kind, examination)
            elif path.name not in pieces:
                _examine_robot(path, examination)


def _examine_robot(path: Path, examination: Examination) -> None:
    """Examine a robot; a file without links is a piece for others, and none itself."""
    if _is_placeholder(path):
        return
    alone = replace(examination, diagnostics=Diagnostics(), sections=[])
    examine_file((path,), Kind.ROBOT, alone)
    if path.suffix == ".xacro" and alone.diagnostics.by_code("urdf.no-links"):
        return
    examination.diagnostics.extend(alone.diagnostics)
    examination.add(*alone.sections)


def _is_placeholder(path: Path) -> bool:
    """Tell a robot with nothing in it, which stands where users may have a file of their own."""
    root = read_xml(path, Diagnostics())
    return root is not None and not root.children and "name" not in root.attributes


def _files_below(folder: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if name not in _PRUNED and not name.startswith(".")
        )
        for name in sorted(names):
            path = Path(place) / name
            if looks_like(path):
                yield path


def _is_piece(path: Path) -> bool:
    """Tell a file that only defines and includes, or whose outermost element says that."""
    root = read_xml(path, Diagnostics())
    if root is None:
        return False
    words = {tag.name.removeprefix("xacro:") for tag in root.children}
    return root.name == "root" or words <= {"arg", "include", "macro", "property"}


def _kind(path: Path, examination: Examination) -> Kind | None:
    found = Diagnostics()
    kind = kind_of(path, found)
    is_unknown = all(item.code == "doctor.unknown-file" for item in found)
    # Other programs keep XML files too, and pieces for xacro may have any outermost element.
    is_plain = path.suffix == ".xml" or (path.suffix == ".xacro" and _is_piece(path))
    if kind is None and not (is_unknown and is_plain):
        examination.diagnostics.extend(found)
    return kind
