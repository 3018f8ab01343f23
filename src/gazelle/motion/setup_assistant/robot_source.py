"""The robot that a config package is made for, read from its file."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents import read_text_limited
from gazelle.motion.setup_assistant.config import RobotSource
from gazelle.motion.setup_assistant.package_files import SetupAssistantError
from gazelle.workspace import Workspace

__all__ = ["load_robot", "read_robot", "with_hardware_arguments"]

_OPPOSITES = {"true": "false", "false": "true"}
_MOCK = ("mock_components/", "fake_components/")
_GAZEBO = re.compile(r"gazebo|^gz_|^ign_", re.IGNORECASE)


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
            found = RobotSource(file, package.name, relative, xacro_args)
            return with_hardware_arguments(found, model, workspace), model
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


def with_hardware_arguments(source: RobotSource, model: Model, workspace: Workspace) -> RobotSource:
    """Return a source with the words for xacro that choose mirroring hardware, and Gazebo's.

    Looked for are arguments that are true or false, as ``use_sim`` of many robots.
    """
    if not model.ros2_controls:
        return source
    root = read_xml(source.file, Diagnostics()) if source.is_xacro else None
    tags = () if root is None else root.find_all("xacro:arg")
    found = {_hardware(model): ""}
    for tag in tags:
        name, default = (tag.attributes.get(key, "") for key in ("name", "default"))
        if default.lower() not in _OPPOSITES or name in source.mappings:
            continue
        word = f"{name}:={_OPPOSITES[default.lower()]}"
        tried = replace(source, xacro_args=f"{source.xacro_args} {word}".strip())
        with suppress(SetupAssistantError):
            found.setdefault(_hardware(load_robot(tried, workspace, Diagnostics())), word)
    demo, gazebo = found.get("mock", ""), found.get("gazebo", "")
    return replace(source, demo_args=demo, gazebo_args=gazebo, has_demo="mock" in found)


def _hardware(model: Model) -> str:
    """Which hardware the blocks of ``<ros2_control>`` name."""
    names = [block.element.text_of("hardware", "plugin") for block in model.ros2_controls]
    if names and all(name.startswith(_MOCK) for name in names):
        return "mock"
    return "gazebo" if any(_GAZEBO.search(name) for name in names) else "other"


def _expanded(source: RobotSource, workspace: Workspace, diagnostics: Diagnostics) -> str:
    if source.file.suffix != ".xacro":
        return read_text_limited(source.file)
    expanded = expand_xacro(
        source.file, mappings=source.mappings, workspace=workspace, diagnostics=diagnostics
    )
    if expanded is None:
        raise SetupAssistantError(f"xacro makes no robot of {source.file}")
    return expanded.text
