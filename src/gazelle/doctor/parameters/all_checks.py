"""The front functions: one file, and all files of a package."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path, PurePosixPath

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.file_kinds import is_launch_yaml
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.parameters.controllers import (
    check_controllers,
    check_untyped,
    controllers_in,
)
from gazelle.doctor.parameters.name_checks import NameFiles, check_names, read_name_files
from gazelle.doctor.parameters.parameter_file import Layout, check_layout, layout_of, read_document
from gazelle.doctor.parameters.robot_descriptions import (
    check_description_text,
    robots_for,
    whole_robots,
)
from gazelle.doctor.parameters.value_checks import check_idle, check_values
from gazelle.doctor.report import Section
from gazelle.documents.files import exists
from gazelle.workspace import Package, Workspace

__all__ = ["check_package_parameters", "check_parameter_file"]

_FOLDERS = frozenset(
    {"cfg", "conf", "config", "configs", "control", "controllers", "map", "maps", "param", "params",
     "parameters", "yaml"}
)  # fmt: skip
_OUTSIDE = frozenset({"doc", "docs", "test", "tests"})
_ROBOTS = (".urdf", ".xacro")


def check_parameter_file(
    path: Path,
    *,
    diagnostics: Diagnostics,
    ros_version: int | None = None,
    joints: Collection[str] = (),
) -> None:
    """Check the layout, the values and the keys of a YAML file with parameters.

    Args:
        path: the file.
        diagnostics: receives the findings.
        ros_version: 1 when roslaunch loads it, 2 when a ROS 2 node does; None takes the file's own
            layout at its word.
        joints: names of the robot's joints, for words that YAML takes for something else.
    """
    document = read_document(path, diagnostics)
    if document is None:
        return
    layout = layout_of(document)
    if layout is Layout.MAP:
        _check_map(path, ros_version or 1, diagnostics)
        return
    check_layout(document, layout, ros_version, diagnostics)
    reader = ros_version or (2 if layout is Layout.ROS2 else 1)
    # MoveIt's files of ROS 2 are read by PyYAML too.
    loader = 1 if layout is Layout.MOVEIT else reader
    check_values(document, layout, loader, diagnostics, joints=joints)
    check_controllers(controllers_in(document, layout), diagnostics)
    check_untyped(document, layout, diagnostics)
    if layout is Layout.ROS2 and reader == 2:
        check_idle(document, diagnostics)


def _check_map(path: Path, ros_version: int, diagnostics: Diagnostics) -> None:
    """Report what the map server would."""
    from gazelle.mapping.grids.map_yaml import read_map_file, report_missing_image

    found = read_map_file(path, diagnostics, ros_version)
    if found is not None and not exists(found.image):
        report_missing_image(found.image, found.image_span, diagnostics, ros_version)


def check_package_parameters(
    package: Package, *, workspace: Workspace, diagnostics: Diagnostics
) -> tuple[Section, ...]:
    """Check every parameter file of a package, and its names against the robots they are for.

    Args:
        package: a source package.
        workspace: finds the packages whose robots this one configures.
        diagnostics: receives the findings.
    """
    source = SourcePackage(package)
    near = [package.path / name for name in source.files if _may_be_parameter_file(name)]
    files = [path for path in near if not is_launch_yaml(path)]
    ros_version = 2 if source.is_ros2 else 1
    names = read_name_files(files)
    model = _robot(names, files, package, ros_version, workspace)
    known = [joint.name for joint in model.joints] if model is not None else ()
    for path in files:
        if path.suffix != ".srdf":
            check_parameter_file(
                path, diagnostics=diagnostics, ros_version=ros_version, joints=known
            )
    if ros_version == 2:
        written = [source.folder / name for name in source.files if name.endswith(_ROBOTS)]
        for path, text in whole_robots(source, workspace):
            check_description_text(text, file=str(path), diagnostics=diagnostics, sources=written)
    if model is None:
        return ()
    own = [path for path in files if not _is_of_another(path, model, package, workspace)]
    section = check_names(model, own, diagnostics=diagnostics)
    return (section,) if section is not None else ()


def _is_of_another(path: Path, model: Model, package: Package, workspace: Workspace) -> bool:
    """Tell a file whose joints are all of another robot, where a package is for several."""
    names = read_name_files([path])
    joints = names.joints()
    if joints <= {joint.name for joint in model.joints}:
        return False
    others = robots_for(package, joints, ros_version=names.ros_version, workspace=workspace)
    return any(joints <= {joint.name for joint in other.joints} for other in others)


def _robot(
    names: NameFiles,
    files: Sequence[Path],
    package: Package,
    ros_version: int,
    workspace: Workspace,
) -> Model | None:
    """Return the robot that the files are for: of several, the one they fit best."""
    joints = names.joints()
    if not joints:
        return None
    wanted = names.ros_version or ros_version
    found = robots_for(package, joints, ros_version=wanted, workspace=workspace)
    best: tuple[int, Model] | None = None
    for model in found:
        trial = Diagnostics()
        check_names(model, files, diagnostics=trial)
        if best is None or len(trial) < best[0]:
            best = (len(trial), model)
    return None if best is None else best[1]


def _may_be_parameter_file(name: str) -> bool:
    path = PurePosixPath(name)
    if _OUTSIDE & set(path.parts):
        return False
    if path.suffix == ".srdf":
        return True
    is_near = len(path.parts) == 1 or bool(_FOLDERS & {part.lower() for part in path.parts[:-1]})
    return path.suffix in {".yaml", ".yml"} and is_near
