"""The robot that a config package is made for, read from its file."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.documents import read_text_limited
from gazelle.motion.setup_assistant.config import RobotSource
from gazelle.motion.setup_assistant.package_files import SetupAssistantError
from gazelle.workspace import Workspace

__all__ = ["load_robot", "read_robot"]


def read_robot(
    file: Path, *, workspace: Workspace, diagnostics: Diagnostics, xacro_args: str = ""
) -> tuple[RobotSource, Model]:
    """Read a URDF or xacro and find the package it lies in.

    Args:
        file: the robot's description.
        workspace: finds packages.
        diagnostics: receives findings about the file.
        xacro_args: words ``NAME:=VALUE`` for xacro, with spaces between.

    Raises:
        SetupAssistantError: there is no robot in it; `diagnostics` say why.
    """
    file = file.resolve()
    source = RobotSource(file, xacro_args=xacro_args)
    model = load_robot(source, workspace, diagnostics)
    for package in workspace.user_packages:
        folder = package.path.resolve()
        if file.is_relative_to(folder):
            relative = file.relative_to(folder).as_posix()
            return RobotSource(file, package.name, relative, xacro_args), model
    path = f"config/{model.name}.urdf"
    text = _expanded(source, workspace, diagnostics)
    return RobotSource(file, "", path, "", copied_text=text), model


def load_robot(source: RobotSource, workspace: Workspace, diagnostics: Diagnostics) -> Model:
    """Return the robot of a source, as MoveIt sees it: without what is added for Gazebo.

    Raises:
        SetupAssistantError: there is no robot in it; `diagnostics` say why.
    """
    models = load_models(
        source.file,
        workspace=workspace,
        diagnostics=diagnostics,
        mappings=source.mappings or None,
        inserts=False,
    )
    if not models:
        reasons = [f"    {item}" for item in diagnostics.errors]
        raise SetupAssistantError("\n".join([f"there is no robot in {source.file}:", *reasons]))
    if not models[0].links:
        raise SetupAssistantError(f"the robot in {source.file} has no links")
    return models[0]


def _expanded(source: RobotSource, workspace: Workspace, diagnostics: Diagnostics) -> str:
    if source.file.suffix != ".xacro":
        return read_text_limited(source.file)
    expanded = expand_xacro(
        source.file, mappings=source.mappings, workspace=workspace, diagnostics=diagnostics
    )
    if expanded is None:
        raise SetupAssistantError(f"xacro makes no robot of {source.file}")
    return expanded.text
