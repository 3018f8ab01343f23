"""MoveIt config packages to `MoveItConfig`."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.moveit.config import MoveItConfig, typed_config
from gazelle.description.moveit.package_files import (
    DEFAULT_CONFIGS,
    PackageFiles,
    find_package_files,
    read_yaml,
)
from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.srdf import Srdf, load_srdf
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.files import is_folder
from gazelle.workspace import Workspace

__all__ = ["read_moveit_config"]

_DESCRIPTION = "robot_description"


def read_moveit_config(
    source: str | os.PathLike[str],
    *,
    workspace: Workspace | None = None,
    diagnostics: Diagnostics,
    robot_name: str = "",
    mappings: Mapping[str, str] | None = None,
) -> MoveItConfig | None:
    """Read a MoveIt config package as its launch files would give it to move_group.

    Args:
        source: the package's name or its folder.
        workspace: where packages are; found around the folder when None.
        diagnostics: receives every finding.
        robot_name: of the SRDF, for packages with several.
        mappings: values of ``<xacro:arg>`` by name, for URDF, SRDF and ROS 1's YAML files.

    Returns:
        The configuration; None (reported) when there is no robot in it.

    Raises:
        NotFoundError: there is no such package.
    """
    folder = Path(source)
    if not is_folder(folder):
        workspace = workspace or Workspace.discover()
        folder = workspace.package(str(source)).path
    workspace = workspace or Workspace.discover(cwd=folder)
    files = find_package_files(
        folder, workspace=workspace, diagnostics=diagnostics, robot_name=robot_name
    )
    if files.urdf is None:
        return None
    given = {**files.arguments, **(mappings or {})}
    models = load_models(
        files.urdf,
        workspace=workspace,
        diagnostics=diagnostics,
        mappings=given or None,
        inserts=False,
    )
    if not models:
        return None
    srdf = _srdf(files, models[0], workspace, diagnostics, given)
    gathered = _gathered(files, diagnostics, {**_defaults(files), **given})
    tree = Settings(gathered.values, diagnostics, spans=gathered.spans)
    return replace(typed_config(tree, _DESCRIPTION, models[0], srdf), package=folder)


def _srdf(
    files: PackageFiles,
    robot: Model,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str],
) -> Srdf:
    found = files.srdf and load_srdf(
        files.srdf, robot=robot, workspace=workspace, diagnostics=diagnostics, mappings=mappings
    )
    return found or Srdf(robot.name)


def _defaults(files: PackageFiles) -> dict[str, str]:
    """Return the defaults of the SRDF's arguments, which the YAML files of ROS 1 name as well."""
    root = None if files.srdf is None else read_xml(files.srdf, Diagnostics())
    tags = () if root is None else root.find_all("xacro:arg")
    return {tag.attributes.get("name", ""): tag.attributes.get("default", "") for tag in tags}


@dataclass
class _Gathered:
    """The parameter tree that files are put into, with the places of its keys."""

    diagnostics: Diagnostics
    arguments: Mapping[str, str]
    values: dict[str, Any] = field(default_factory=dict)
    spans: dict[tuple[str, ...], SourceSpan] = field(default_factory=dict)

    def add(self, file: Path | None, *above: str) -> None:
        """Put a file's values below some keys."""
        if file is None:
            return
        values, spans = read_yaml(file, self.diagnostics, self.arguments)
        branch = self.values
        for key in above:
            branch = branch.setdefault(key, {})
        branch.update(values)
        for path, span in spans.items():
            self.spans.setdefault((*above, *path), span)
        if above:
            self.spans.setdefault(above, SourceSpan(str(file)))


def _gathered(
    files: PackageFiles, diagnostics: Diagnostics, arguments: Mapping[str, str]
) -> _Gathered:
    gathered = _Gathered(diagnostics, arguments)
    gathered.add(files.kinematics, f"{_DESCRIPTION}_kinematics")
    gathered.add(files.joint_limits, f"{_DESCRIPTION}_planning")
    gathered.add(files.cartesian_limits, f"{_DESCRIPTION}_planning")
    gathered.add(files.controllers)
    gathered.add(files.sensors)
    for name, file in files.pipelines.items():
        gathered.add(file, name)
    if "planner_configs" not in gathered.values.get("ompl", {}):
        gathered.add(DEFAULT_CONFIGS / "ompl_defaults.yaml", "ompl")
    names = list(files.pipelines)
    gathered.values["planning_pipelines"] = names
    gathered.values["default_planning_pipeline"] = "ompl" if "ompl" in names else names[0]
    return gathered
