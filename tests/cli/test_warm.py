"""``gazelle warm``, after which nothing is compiled any more."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched

_ROOT = Path(__file__).parents[2]
_WATCHED = """
from gazelle.kernels import compiling

compiled = []
with compiling(lambda source, seconds: compiled.append(source.name)):
    run()
assert not compiled, compiled
"""
_ARM = """
from tests.motion.problems import random_case, robot_named
from gazelle.motion.kinematics import Solver
from gazelle.motion.planning import Search, plan

def run():
    robot = robot_named("ur_like")
    case = random_case(robot, "ur_like", 3)
    solver = Solver(robot, "arm")
    solver.ik(solver.fk(case.goal), seed_q=case.start)
    solver.jacobian(case.goal)
    plan(case.space, case.checker, case.start, [case.goal], search=Search(time_limit_s=60.0))
"""
_SLAM = """
import math
import numpy as np
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.slam.slam_engine import Slam

def run():
    engine = Slam()
    for k in range(12):
        turn = math.tau * k / 12
        angles = np.linspace(-2.0, 2.0, 271)
        ranges = (3.0 + np.cos(4 * (angles + turn))).astype(np.float32)
        scan = Scan(k * 100_000_000, -2.0, 4.0 / 270, ranges, 0.05, 10.0)
        engine.add(scan, (0.5 * math.cos(turn), 0.5 * math.sin(turn), turn))
    engine.finish()
"""
_CAMERA = """
from gazelle.description.model import (
    CameraSpec, Light, LightType, Link, Model, Sphere, Visual, World,
)
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.sensors.camera import render
from gazelle.sensors.ray_scene import RayScene

def run():
    link = Link("link", visuals=(Visual("ball", Sphere(0.5), Pose((3.0, 0.0, 0.0))),))
    lamp = Light("lamp", LightType.POINT)
    scene = RayScene(World(models=(Model("model", links=(link,)),), lights=(lamp, lamp)))
    render(scene, CameraSpec(width_px=32, height_px=24), IDENTITY_POSE, antialias=False)
    render(scene, CameraSpec(width_px=32, height_px=24), IDENTITY_POSE, want_depth=True)
"""
_NAVIGATION = """
import numpy as np
from gazelle.mapping.grids import OccupancyGrid
from gazelle.navigation.controllers import (
    CONTROLLERS, ControllerSetting, DwbOptions, MppiOptions, RobotState,
)
from gazelle.navigation.costmap import CostGrid, Footprint, InflationOptions, inflated
from gazelle.navigation.planners import (
    GlobalPlannerOptions, NavfnOptions, Smac2DOptions, ThetaStarOptions, make_plan,
)

def run():
    robot = Footprint.of_radius(0.2)
    grid = inflated(CostGrid(np.zeros((80, 60), np.uint8), 0.05), InflationOptions(), robot)
    for options in (
        NavfnOptions(), GlobalPlannerOptions(use_quadratic=False),
        GlobalPlannerOptions(use_dijkstra=False), Smac2DOptions(),
        ThetaStarOptions(how_many_corners=4),
    ):
        make_plan(grid, (1.0, 1.0, 0.0), (2.0, 3.0, 0.0), options)
    path = np.column_stack([np.linspace(1.0, 2.0, 20), np.full(20, 1.0), np.zeros(20)])
    for name, options in (
        ("dwb_core::DWBLocalPlanner", DwbOptions()),
        ("nav2_mppi_controller::MPPIController", MppiOptions(batch_size=9, time_steps=12)),
    ):
        controller = CONTROLLERS[name].make(options, ControllerSetting(0.05, {}))
        controller.set_plan(path)
        controller.compute(RobotState((1.0, 1.0, 0.1), (0.1, 0.0, 0.0)), grid, robot)
"""


def _run(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *words], capture_output=True, text=True, cwd=_ROOT,
        timeout=stretched(600.0), check=False,
    )  # fmt: skip


@pytest.fixture(scope="module")
def warmed() -> None:
    """All kernels are compiled."""
    done = _run("-m", "gazelle.cli", "warm")
    assert done.returncode == 0, done.stderr


@pytest.mark.usefixtures("warmed")
def test_a_second_time_nothing_is_to_be_done() -> None:
    done = _run("-m", "gazelle.cli", "warm", "--jobs", "1")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("nothing is to be done: all kernels are kept in /")


@pytest.mark.usefixtures("warmed")
@pytest.mark.parametrize("session", [_ARM, _SLAM, _CAMERA, _NAVIGATION])
def test_afterwards_nothing_is_compiled(session: str) -> None:
    done = _run("-c", f"{session}{_WATCHED}")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
