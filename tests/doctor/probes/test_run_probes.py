"""All probes over the sample robots."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import pytest
from tests.doctor.probes.worlds import block, ground, probed
from tests.shared_files import SHARED, shared_cases

from gazelle.description.loader import load_models
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.probes import run_probes, stood_on_ground
from gazelle.doctor.probes.robot_motion import robots_of
from gazelle.workspace import Workspace

MODELS = "turtlebot3_ws/src/turtlebot3_simulations/turtlebot3_gazebo/models"
REPOSITORY = Path(__file__).parents[3]
BARROW = REPOSITORY / "tests/workspaces/ros1/src/yard_gazebo/models/barrow"
OWN_RUN_WELL = [
    REPOSITORY / "examples/scout_ws/src/scout_robot/urdf/scout.urdf.xacro",
    REPOSITORY / "examples/four_wheel_ws/src/courier_robot/urdf/courier.urdf.xacro",
    REPOSITORY / "examples/arm_ws/src/heron_description/urdf/heron.urdf.xacro",
    BARROW,
]
RUN_WELL = [
    "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf",
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf",
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf",
    "gazebo_models/my_robot",
    f"{MODELS}/turtlebot3_burger",
    f"{MODELS}/turtlebot3_waffle_pi",
    "ros2_ws/src/luck_description/urdf/luck_description.urdf",
]


@pytest.mark.parametrize(
    "path",
    [*OWN_RUN_WELL, *shared_cases(*(SHARED / "workspaces" / name for name in RUN_WELL))],
    ids=lambda path: path.name,
)
def test_robot_that_runs_well_passes(path: Path) -> None:
    workspace = Workspace.discover(cwd=path.parent)
    models = load_models(path, workspace=workspace, diagnostics=Diagnostics())
    placed = tuple(stood_on_ground(model) for model in models)
    found, told = Diagnostics(), list[str]()
    before_s = time.process_time()
    sections = run_probes(
        World(models=(ground(), *placed)),
        workspace=workspace,
        diagnostics=found,
        progress=told.append,
    )
    assert list(found) == []
    assert told[:2] == ["probe: spawn", "probe: idle drift"]
    assert [section.name for section in sections][:2] == ["probe_spawn", "probe_idle_drift"]
    assert time.process_time() - before_s < 30.0


def test_world_without_robots_is_not_probed() -> None:
    sections, found = probed(ground())
    assert sections == {}
    assert list(found) == []


@pytest.mark.parametrize("path", [BARROW, *shared_cases(SHARED / "workspaces" / RUN_WELL[3])])
def test_things_are_probed_only_where_there_is_no_robot(path: Path) -> None:
    (robot,) = load_models(path, workspace=None, diagnostics=Diagnostics())
    cube = block(0.1)
    assert robots_of(World(models=(ground(), cube))) == (cube,)
    assert robots_of(World(models=(ground(), cube, robot))) == (robot,)


def test_world_that_cannot_be_built_is_told() -> None:
    twice = block(0.1)
    _, found = probed(ground(), twice, replace(twice))
    assert [item.code for item in found] == ["probe.not-built"]
    assert "cube" in next(iter(found)).message


def test_same_seed_gives_the_same_tables() -> None:
    assert probed(ground(), block(0.0))[0] == probed(ground(), block(0.0))[0]
