"""Examining one file by its kind."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.descriptions import examine_models
from gazelle.doctor.dry_start import Program, StartPlan, dry_start
from gazelle.doctor.examination import Examination
from gazelle.doctor.kinds import Kind
from gazelle.doctor.launch import examine_launch
from gazelle.doctor.simulated import simulation_sections

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
    _bring_up(StartPlan(Program("gazebo", words=(str(file),))), file.name, examination)


def _examine_robot(file: Path, examination: Examination) -> None:
    found = Diagnostics()
    models = load_models(
        file,
        workspace=examination.workspace,
        diagnostics=found,
        mappings=examination.options.arguments,
    )
    examination.diagnostics.extend(found)
    if models and not found.errors:
        server = Program("gazebo", words=(examination.options.world,))
        _bring_up(StartPlan(server, models=models), file.name, examination)


def _bring_up(plan: StartPlan, subject: str, examination: Examination) -> None:
    found = Diagnostics()
    start = dry_start(plan, workspace=examination.workspace, diagnostics=found)
    examination.diagnostics.extend(found)
    if start is not None:
        examine_models(start.world, examination)
        examination.add(*simulation_sections(start, found, subject=subject))
