"""A launch file, expanded and checked as one thing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor.dry_start import DryStart, dry_start
from gazelle.doctor.launch_ros1.frames import check_frames, frames_of, frames_section
from gazelle.doctor.launch_ros1.launched_nodes import (
    Launched,
    Role,
    at_argument,
    launched_from,
    start_plan,
    with_parameter_span,
)
from gazelle.doctor.launch_ros1.name_checks import check_descriptions, check_remaps, check_topics
from gazelle.doctor.launch_ros1.node_checks import (
    check_clock,
    check_nodes,
    check_script_parameters,
    check_unsupported_parameters,
    nodes_section,
)
from gazelle.doctor.launch_ros1.required_arguments import report_required, without_consequences
from gazelle.doctor.launch_ros1.topics import topics_of
from gazelle.doctor.report import Examination
from gazelle.doctor.robots_and_worlds import examine_models, examine_text, texts_known
from gazelle.doctor.simulated_world import probe, simulation_sections
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.node_commands import Executable, find_executable
from gazelle.launch.ros1.loader import load_launch_files

__all__ = ["examine_launch"]

_DESCRIPTION = "robot_description"
_LACKS = frozenset({"doctor.no-controller-manager", "doctor.no-description", "doctor.spawn-fails"})


def examine_launch(files: Sequence[Path], examination: Examination) -> None:
    """Expand launch files that are started together, and check what they would start.

    Args:
        files: existing files of ROS 1's roslaunch.
        examination: takes findings and tables.
    """
    found = Diagnostics()
    config = load_launch_files(
        files,
        examination.options.arguments,
        workspace=examination.workspace,
        diagnostics=found,
        environ=examination.options.environ,
    )
    for file in (*config.files, *config.text_files):
        examination.see(Path(file))
    if examination.is_wide and report_required(config, found, examination):
        for item in without_consequences(found):
            examination.diagnostics.add(item)
        _executables(config, examination)
        return
    whole, examination = examination, replace(examination, diagnostics=Diagnostics())
    examination.diagnostics.extend(found)
    executables = _executables(config, examination)
    name = " ".join(file.name for file in files)
    launched = launched_from(config, executables, name=name, is_whole=not found.errors)
    starts = _starts(launched, examination)
    _examine_descriptions(launched, starts, examination)
    _check(launched, starts, examination)
    is_part = whole.is_wide and not any(name.endswith(_DESCRIPTION) for name in config.params)
    told = examination.diagnostics
    for item in told:
        whole.diagnostics.add(_of_a_part(item) if is_part else item)


def _of_a_part(item: Diagnostic) -> Diagnostic:
    """Soften what a launch lacks that is a part of others, which load the robot before it."""
    if item.code not in _LACKS or (item.code == "doctor.spawn-fails" and not _asks(item)):
        return item
    text = f"{item.message}; right where the launch that includes this one loads the robot"
    return replace(item, severity=Severity.INFO, message=text)


def _asks(item: Diagnostic) -> bool:
    return f"{_DESCRIPTION}'" in item.message


def _executables(config: LaunchConfig, examination: Examination) -> list[Executable | None]:
    return [
        find_executable(
            spec.package,
            spec.type,
            workspace=examination.workspace,
            diagnostics=examination.diagnostics,
            span=spec.span,
            environ=examination.options.environ,
        )
        for spec in config.nodes
    ]


def _starts(launched: Launched, examination: Examination) -> dict[str, DryStart]:
    """Bring up every simulator of the launch; keep the tables about it."""
    found: dict[str, DryStart] = {}
    for server in launched.of_role(Role.SIMULATOR):
        if server.full_name in found:
            continue
        heard = Diagnostics()
        plan = start_plan(launched, server, heard)
        start = dry_start(plan, workspace=examination.workspace, diagnostics=heard)
        told = tuple(
            at_argument(with_parameter_span(item, launched.spans), launched.config.files)
            for item in heard
        )
        for item in told:
            examination.diagnostics.add(item)
        if start is not None:
            found[server.full_name] = start
            examination.add(*simulation_sections(start, told, subject=launched.name))
            probe(start, plan, examination)
    return found


def _examine_descriptions(
    launched: Launched, starts: dict[str, DryStart], examination: Examination
) -> None:
    for start in starts.values():
        examine_models(start.world, examination)
    texts = {launched.description(node) for node in launched.nodes}
    for text in sorted(text for text in texts if text and text.lstrip().startswith("<")):
        # What is no XML comes into no world, and the spawner does not know its file.
        if not starts or parse_xml(text, "", Diagnostics()) is None:
            examine_text(text, launched.config.text_files, examination)


def _check(launched: Launched, starts: dict[str, DryStart], examination: Examination) -> None:
    diagnostics = examination.diagnostics
    topics = topics_of(launched, starts)
    examination.launch_topics += [end for item in topics for end in item.ends()]
    check_descriptions(launched, diagnostics)
    check_nodes(launched, diagnostics)
    check_unsupported_parameters(launched, diagnostics)
    check_script_parameters(launched, diagnostics)
    check_clock(launched, starts, diagnostics)
    check_remaps(launched, topics, diagnostics)
    check_topics(launched, topics, diagnostics)
    with texts_known(launched.config.text_files):
        frames = frames_of(launched, topics, starts, diagnostics)
    check_frames(frames, launched, starts, diagnostics)
    examination.add(nodes_section(launched), frames_section(frames, launched.name))
