"""Examining one file by its kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.descriptions import examine_models
from gazelle.doctor.dry_start import Program, StartPlan, dry_start
from gazelle.doctor.examination import Examination
from gazelle.doctor.kinds import Kind, is_semantic
from gazelle.doctor.launch import examine_launch
from gazelle.doctor.launch_ros2 import check_launch
from gazelle.doctor.parameters import check_package_parameters, check_parameter_file
from gazelle.doctor.probing import probe
from gazelle.doctor.simulated import simulation_sections
from gazelle.doctor.target import package_at
from gazelle.workspace.search_path import BUILTIN

__all__ = ["examine_file", "kind_word"]

_EMPTY = BUILTIN / "worlds" / "empty.world"


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
    elif kind is Kind.LAUNCH_ROS2:
        _examine_ros2(files[0], examination)
    elif kind is Kind.PARAMETERS:
        check_parameter_file(files[0], diagnostics=examination.diagnostics)
    elif kind is Kind.SEMANTICS:
        _examine_semantics(files[0], examination)
    elif kind is Kind.WORLD:
        _examine_world(files[0], examination)
    elif kind in {Kind.ROBOT, Kind.MODEL}:
        _examine_robot(files[0], examination)


def _examine_ros2(file: Path, examination: Examination) -> None:
    """Read a launch file of ROS 2 without running it, and examine what it names."""
    found = check_launch(
        file,
        workspace=examination.workspace,
        diagnostics=examination.diagnostics,
        arguments=examination.options.arguments,
    )
    for path in (*found.launch_files, *found.parameter_files):
        examination.see(path)
    examination.add(*found.sections)
    for robot in found.robots:
        if examination.see(robot.path) and not is_semantic(robot.path):
            _examine_robot(robot.path, examination, robot.mappings)
    for world in found.worlds:
        if examination.see(world):
            _examine_world(world, examination)


def _examine_semantics(file: Path, examination: Examination) -> None:
    """An SRDF means nothing without the robot it is for: the package has both."""
    if read_xml(file, examination.diagnostics) is None:
        return
    package = package_at(file.parent, examination.workspace)
    if package is not None:
        examination.add(
            *check_package_parameters(
                package, workspace=examination.workspace, diagnostics=examination.diagnostics
            )
        )


def _examine_world(file: Path, examination: Examination) -> None:
    _bring_up(StartPlan(Program("gazebo", words=(str(file),))), file.name, examination)


def _examine_robot(
    file: Path, examination: Examination, mappings: Mapping[str, str] | None = None
) -> None:
    found = Diagnostics()
    models = load_models(
        file,
        workspace=examination.workspace,
        diagnostics=found,
        mappings=examination.options.arguments if mappings is None else mappings,
    )
    examination.diagnostics.extend(found)
    if models and not found.errors:
        world = examination.options.world
        # A package of the workspace may have an empty.world of its own, which says other things.
        place = str(_EMPTY) if world == "empty" else world
        server = Program("gazebo", words=(place,))
        if examination.options.probe:
            from gazelle.doctor.probes import stood_on_ground

            # Nobody has placed it, and half in the ground it would be thrown.
            models = tuple(stood_on_ground(model) for model in models)
        _bring_up(StartPlan(server, models=models), file.name, examination)


def _bring_up(plan: StartPlan, subject: str, examination: Examination) -> None:
    found = Diagnostics()
    start = dry_start(plan, workspace=examination.workspace, diagnostics=found)
    examination.diagnostics.extend(found)
    if start is not None:
        examine_models(start.world, examination)
        examination.add(*simulation_sections(start, found, subject=subject))
        probe(start, plan, examination)
