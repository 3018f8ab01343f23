"""Robots that a config package is made for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model import RobotModel
from gazelle.motion.setup_assistant import (
    CollisionSearch,
    SetupAssistantConfig,
    propose,
    read_robot,
)
from gazelle.workspace import Workspace

ARM_WS = Path(__file__).parents[3] / "examples" / "arm_ws"
HERON = ARM_WS / "src" / "heron_description" / "urdf" / "heron.urdf.xacro"
SEVEN = Path(__file__).parents[1] / "arms" / "seven.urdf"
FEW = CollisionSearch(trials=300)


@cache
def proposed(file: Path, ros_version: int = 2) -> tuple[SetupAssistantConfig, Model]:
    """Return what is proposed for a robot, and the robot."""
    workspace = Workspace.discover(environ={}, extra=[ARM_WS])
    source, model = read_robot(file, workspace=workspace, diagnostics=Diagnostics())
    config = propose(model, source, diagnostics=Diagnostics(), ros_version=ros_version, search=FEW)
    return config, model


def seven_of(ros_version: int, name: str = "seven_moveit_config") -> SetupAssistantConfig:
    """Return what is proposed for the arm whose URDF lies in no package."""
    return replace(proposed(SEVEN, ros_version)[0], package_name=name)


@pytest.fixture
def bare() -> Callable[[str], RobotModel]:
    """Makes a robot without groups of the insides of a URDF."""

    def make(urdf: str) -> RobotModel:
        text = f'<robot name="r">{urdf}</robot>'
        (model,) = load_models(text, workspace=None, diagnostics=Diagnostics())
        return RobotModel.build(model, diagnostics=Diagnostics())

    return make
