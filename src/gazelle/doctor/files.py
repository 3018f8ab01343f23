"""Examining one file by its kind."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.description.loader import load_models, load_world
from gazelle.doctor.examination import Examination
from gazelle.doctor.kinds import Kind
from gazelle.doctor.launch import examine_launch
from gazelle.errors import UserFileError

__all__ = ["examine_file", "kind_word"]


def kind_word(kind: Kind) -> str:
    """Return the report's word for a kind of file."""
    words = {Kind.LAUNCH_ROS2: "launch", Kind.MODEL: "robot"}
    return words.get(kind, kind.value)


def examine_file(files: Sequence[Path], kind: Kind, examination: Examination) -> None:
    """Examine a file, or several launch files that are started together.

    Args:
        files: existing files, all of one kind.
        kind: of the first.
        examination: takes findings and tables.
    """
    for file in files:
        examination.see(file)
        examination.say(str(file))
    if kind is Kind.LAUNCH:
        examine_launch(files, examination)
    elif kind is Kind.WORLD:
        _examine_world(files[0], examination)
    elif kind in {Kind.ROBOT, Kind.MODEL}:
        _examine_robot(files[0], examination)


def _examine_world(file: Path, examination: Examination) -> None:
    try:
        load_world(file, workspace=examination.workspace, diagnostics=examination.diagnostics)
    except UserFileError:
        # Everything it holds is among the findings.
        return


def _examine_robot(file: Path, examination: Examination) -> None:
    load_models(
        file,
        workspace=examination.workspace,
        diagnostics=examination.diagnostics,
        mappings=examination.options.arguments,
    )
