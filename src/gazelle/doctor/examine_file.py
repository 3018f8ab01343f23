"""Examining one file by its kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.description.model import JointType, Model, World
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan
from gazelle.doctor.dry_start import Program, StartPlan, dry_start
from gazelle.doctor.file_kinds import Kind, is_semantic
from gazelle.doctor.included_files import including_robot
from gazelle.doctor.launch_ros1 import examine_launch
from gazelle.doctor.launch_ros2 import LaunchReading, check_launch
from gazelle.doctor.parameters import check_package_parameters, check_parameter_file
from gazelle.doctor.report import Examination
from gazelle.doctor.robots_and_worlds import examine_models
from gazelle.doctor.script_topics import TopicEnd
from gazelle.doctor.simulated_world import probe, simulation_sections
from gazelle.doctor.target import package_at
from gazelle.doctor.topic_checks import check_topic_names, check_topic_types
from gazelle.documents.files import HOW_TO_RAISE, is_file, scaled
from gazelle.errors import GazelleError
from gazelle.workspace.environment_paths import BUILTIN

__all__ = ["examine_file", "kind_name"]

_EMPTY = BUILTIN / "worlds" / "empty.world"
# What is wrong with a file that needs the one that includes it.
_OF_A_PART = frozenset(
    {
        "urdf.no-links",
        "urdf.no-robot-name",
        "xacro.argument-missing",
        "xacro.undefined-name",
        "xacro.unknown-macro",
    }
)
# MuJoCo's time grows with the square of them.
_MAX_MOVING_JOINTS = 2000
_IN_EMPTY = frozenset({"ground_plane", "sun"})


def kind_name(kind: Kind) -> str:
    """Return the report's word for a kind of file."""
    argv = {Kind.LAUNCH_ROS2: "launch", Kind.MODEL: "robot"}
    return argv.get(kind, kind.value)


def examine_file(files: Sequence[Path], kind: Kind, examination: Examination) -> None:
    """Examine files one by one, or several launch files of ROS 1 as started together.

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
        return
    for file in files:
        _examine_one(file, kind, examination)


def _examine_one(file: Path, kind: Kind, examination: Examination) -> None:
    if kind is Kind.LAUNCH_ROS2:
        _examine_ros2(file, examination)
    elif kind is Kind.PARAMETERS:
        check_parameter_file(file, diagnostics=examination.diagnostics)
    elif kind is Kind.SEMANTICS:
        _examine_semantics(file, examination)
    elif kind is Kind.WORLD:
        _examine_world(file, examination)
    elif kind in {Kind.ROBOT, Kind.MODEL}:
        _examine_robot(file, examination)


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
            _examine_robot(robot.path, examination, robot.mappings, started_by=2)
    for world in found.worlds:
        if examination.see(world):
            _examine_world(world, examination, started_by=2)
    _check_topics(found, examination)


def _check_topics(found: LaunchReading, examination: Examination) -> None:
    """Compare the topics of a launch's nodes with each other's and with its simulator's."""
    topics = found.topics
    if topics is None:
        return
    keys = [_key(robot.path, robot.mappings) for robot in found.robots]
    keys += [_key(world, {}) for world in found.worlds]
    known = [examination.simulated[key] for key in keys if key in examination.simulated]
    simulated = [end for ends in known for end in ends] if found.simulates else []
    ends = [*topics.ends, *simulated]
    examination.launch_topics += ends
    is_whole = topics.is_whole and found.simulates and len(known) == len(keys)
    check_topic_types(ends, examination.diagnostics, ros_version=2)
    check_topic_names(ends, examination.diagnostics, is_whole=is_whole, others=topics.others)


def _key(path: Path, mappings: Mapping[str, str]) -> tuple[Path, frozenset[tuple[str, str]]]:
    return path.resolve(), frozenset(mappings.items())


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


def _examine_world(file: Path, examination: Examination, *, started_by: int = 0) -> None:
    plan = StartPlan(Program("gazebo", argv=(str(file),)), started_by=started_by)
    examination.simulated[_key(file, {})] = _bring_up(plan, file.name, examination)


def _examine_robot(
    file: Path,
    examination: Examination,
    mappings: Mapping[str, str] | None = None,
    *,
    started_by: int = 0,
) -> None:
    found = Diagnostics()
    models = load_models(
        file,
        workspace=examination.workspace,
        diagnostics=found,
        mappings=examination.options.arguments if mappings is None else mappings,
    )
    for model in models:
        if model.file is not None:
            # That which a model.config names.
            examination.see(model.file)
    if _is_left(file, found, examination):
        return
    whole = _whole_robot(file, found, examination)
    if whole is not None:
        examination.see(whole)
        _examine_robot(whole, examination, mappings)
        return
    if not models or found.errors:
        examination.diagnostics.extend(found)
        return
    alone = replace(examination, diagnostics=found)
    if not _is_too_large(models, alone):
        key = _key(file, examination.options.arguments if mappings is None else mappings)
        examination.simulated[key] = _bring_up_robot(file, models, alone, started_by)
    for item in found:
        examination.diagnostics.add(_of_real_robot(item))


def _bring_up_robot(
    file: Path, models: Sequence[Model], examination: Examination, started_by: int
) -> tuple[TopicEnd, ...]:
    world = examination.options.world
    # A package of the workspace may have an empty.world of its own, which says other things.
    place = str(_EMPTY) if world == "empty" else world
    plan = StartPlan(
        Program("gazebo", argv=(place,)),
        models=tuple(map(_beside_world, models)),
        started_by=started_by,
    )
    return _bring_up(plan, file.name, examination)


def _is_too_large(models: Sequence[Model], examination: Examination) -> bool:
    """Tell whether bringing models up would take long; they are checked without then.

    An endless chain, which the engine refuses, is refused at once and is brought up all the same.
    """
    moving = [joint for model in models if not model.static for joint in model.joints
              if joint.type is not JointType.FIXED]  # fmt: skip
    most = scaled(_MAX_MOVING_JOINTS)
    if len(moving) <= most or examination.options.probe:
        return False
    # It imports MuJoCo, which not every file needs.
    from gazelle.engine.kinematic_tree import kinematic_tree

    try:
        for model in models:
            kinematic_tree(model)
    except GazelleError:
        return False
    examine_models(World(models=tuple(models)), examination)
    text = "the robot is not brought up, so its plug-ins, controllers and contacts are not tried: "
    text += f"it has {len(moving):,} joints that move, more than {most:,} take long"
    fix = f"{HOW_TO_RAISE}, or add --probe"
    examination.diagnostics.report("doctor.too-many-joints", text, models[0].span, fix=fix)
    return True


def _is_left(file: Path, found: Diagnostics, examination: Examination) -> bool:
    """Take note of a file of a package that is no robot on its own; True when it is one."""
    diagnostics = examination.diagnostics
    if found.by_code("load.nothing") and _is_light(file):
        return True
    if not examination.is_wide:
        return False
    unset = found.by_code("xacro.argument-missing")
    if unset:
        text = f"'{file.name}' needs arguments and is not started: {unset[0].message}"
        fix = f"examine it with them: gazelle doctor {file} …:=…"
        diagnostics.report(
            "doctor.needs-arguments", text, unset[0].span, fix=fix, phrase=unset[0].phrase
        )
        return True
    placeholder = _placeholder_default(file, found)
    if placeholder:
        first = found.errors[0]
        text = f"'{file.name}' needs arguments and is not started: there are no files for "
        text += f"{placeholder}, which is the default ({first.message})"
        fix = f"examine it with a value: gazelle doctor {file} {placeholder.partition('=')[0]}=…"
        diagnostics.report("doctor.needs-arguments", text, first.span, fix=fix)
        return True
    if found.by_code("sdf.no-model"):
        for item in found:
            text = f"{item.message}; right where others use its meshes only, or a program makes it"
            diagnostics.add(replace(item, severity=Severity.INFO, message=text))
        return True
    return False


def _whole_robot(file: Path, found: Diagnostics, examination: Examination) -> Path | None:
    """Return the robot that a file is a part of, which means nothing on its own."""
    package = package_at(file.parent, examination.workspace)
    codes = {item.code for item in found.errors}
    if examination.is_wide or package is None or not codes or not codes <= _OF_A_PART:
        return None
    whole = including_robot(file, package.path)
    if whole is not None:
        text = f"'{file.name}' is a part of '{whole.name}', which is examined in its place"
        examination.diagnostics.report("doctor.part", text, SourceSpan(str(file)))
    return whole


def _placeholder_default(file: Path, found: Diagnostics) -> str:
    """Return an argument, as name:=value, whose default is no robot: files for it are missing.

    It is empty, or the folder of all files that are missing.
    """
    missing = found.by_code("xacro.file-missing")
    root = read_xml(file, Diagnostics()) if missing else None
    if root is None:
        return ""
    # What leads to the missing files: includes, and calls of macros that include.
    spans = [item.span for item in missing if item.span is not None]
    places = [place for span in spans for place in (span, *span.via)]
    lines = {place.line for place in places if Path(place.file) == file}
    leading = [tag for tag in root.walk() if tag.span.line in lines]
    words = " ".join(text for tag in leading for text in tag.attributes.values())
    is_whole = len(missing) == len(found.errors)
    for tag in root.walk():
        if tag.name != "xacro:arg" or "default" not in tag.attributes:
            continue
        name, value = tag.attributes.get("name", ""), tag.attributes["default"].strip()
        is_folder = is_whole and all(f"/{value}/" in item.message for item in missing)
        if is_folder if value else f"$(arg {name})" in words:
            return f"{name}:={value}"
    return ""


def _is_light(file: Path) -> bool:
    """Tell whether a model's folder holds a lamp, as ``model://sun`` does."""
    place = file.with_name("model.sdf") if file.name == "model.config" else file
    root = read_xml(place, Diagnostics()) if is_file(place) else None
    return root is not None and root.find("light") is not None


def _beside_world(model: Model) -> Model:
    """Give a model that is in every empty world, such as the ground, a name of its own."""
    return replace(model, name=f"{model.name}_alone") if model.name in _IN_EMPTY else model


def _of_real_robot(item: Diagnostic) -> Diagnostic:
    """Soften what is wrong for a simulation only: nobody has said that there is one."""
    if item.code != "control.hardware-plugin" or item.fix.startswith("did you mean"):
        return item
    text = f"{item.message}; right for the real robot"
    return replace(item, severity=Severity.WARNING, message=text)


def _bring_up(plan: StartPlan, subject: str, examination: Examination) -> tuple[TopicEnd, ...]:
    """Examine a world that comes up, and return the topics of its simulator."""
    found = Diagnostics()
    start = dry_start(plan, workspace=examination.workspace, diagnostics=found)
    examination.diagnostics.extend(found)
    if start is None:
        return ()
    examine_models(start.world, examination)
    examination.add(*simulation_sections(start, found, subject=subject))
    probe(start, plan, examination)
    node = start.node
    offered = [TopicEnd(node.full_name, *item, True) for item in node.offered.items()]
    return (*offered, *(TopicEnd(node.full_name, *item, False) for item in node.heard.items()))
