"""The documents' own robots, against what Gazebo Classic was measured to do."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.shared_files import skip_module_without_shared

from gazelle.description.model import World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.document import read_model_file
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.geometry import Pose
from gazelle.workspace import Workspace

skip_module_without_shared()

pytestmark = pytest.mark.reference


@pytest.fixture(scope="module")
def workspace(workspaces_dir):
    sources = workspaces_dir / "catkin_ws" / "src"
    models = workspaces_dir / "turtlebot3_ws/src/turtlebot3_simulations/turtlebot3_gazebo/models"
    environ = {
        "ROS_PACKAGE_PATH": str(sources),
        "GAZEBO_MODEL_PATH": f"{workspaces_dir / 'gazebo_models'}:{models}",
    }
    return Workspace.discover(environ=environ, cwd=workspaces_dir)


def urdf(path, workspace):
    diagnostics = Diagnostics()
    context = ReadContext(workspace, diagnostics, str(path), path.parent)
    model = read_urdf(path.read_text(), context=context)
    assert model is not None, list(map(str, diagnostics))
    return model


def sdf(path, workspace):
    model = read_model_file(path, workspace=workspace, diagnostics=Diagnostics())
    assert model is not None
    return model


@pytest.fixture(scope="module")
def slambot_model(workspaces_dir, workspace):
    return urdf(workspaces_dir / "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf", workspace)


@pytest.fixture
def slambot(slambot_model, build):
    engine = Engine(World(models=(build.ground(mu1=100.0, mu2=50.0), slambot_model)))
    engine.step(1000)
    return engine


def drive(engine, left, right):
    for side, speed in (("left", left), ("right", right)):
        engine.joint(f"slam_robot::{side}_wheel_joint").set_velocity_target(speed, 5.0)


def test_idle_slambot_does_not_move(slambot):
    start = slambot.model_pose("slam_robot")
    slambot.step(10000)
    end = slambot.model_pose("slam_robot")
    assert np.abs(np.subtract(end.position_m, start.position_m)).max() < 1e-3
    assert np.abs(np.subtract(end.rpy_rad, start.rpy_rad)).max() < math.radians(0.1)


def test_idle_slambot_does_not_move_without_sleep_either(slambot):
    from gazelle.engine.mujoco_library import mujoco

    slambot.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    start = slambot.model_pose("slam_robot")
    slambot.step(10000)
    end = slambot.model_pose("slam_robot")
    assert np.abs(np.subtract(end.position_m, start.position_m)).max() < 1e-4
    assert np.abs(np.subtract(end.rpy_rad, start.rpy_rad)).max() < math.radians(0.01)


def test_slambot_drives_straight_at_its_wheel_speed(slambot):
    drive(slambot, 4.0, 4.0)
    slambot.step(1000)
    start = slambot.model_pose("slam_robot")
    slambot.step(4000)
    end = slambot.model_pose("slam_robot")
    assert (end.position_m[0] - start.position_m[0]) / 4 == pytest.approx(0.22, rel=0.01)
    assert abs(end.rpy_rad[2] - start.rpy_rad[2]) < 0.005


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_slambot_turns_at_gazebos_rate(slambot, sign):
    drive(slambot, -sign, sign)
    slambot.step(1500)
    start = slambot.model_pose("slam_robot").rpy_rad[2]
    slambot.step(3000)
    rate = (slambot.model_pose("slam_robot").rpy_rad[2] - start) / 3
    assert 0.294 <= sign * rate <= 0.307


def test_slambot_stops_when_its_wheels_do(slambot):
    drive(slambot, 4.0, 4.0)
    slambot.step(1000)
    drive(slambot, 0.0, 0.0)
    slambot.step(1000)
    start = slambot.model_pose("slam_robot").position_m
    slambot.step(2000)
    assert slambot.model_pose("slam_robot").position_m == pytest.approx(start, abs=1e-5)


def test_slambots_tessellated_wheels_are_cylinders(slambot):
    from gazelle.engine.mujoco_library import mujoco

    kinds = {
        slambot._compiled.collision_names[i].split("::")[1]: int(slambot.model.geom_type[i])
        for i in range(slambot.model.ngeom)
    }
    wheels = ("left_wheel_link", "right_wheel_link", "prewheel_link", "backwheel_link")
    assert {kinds[name] for name in wheels} == {int(mujoco.mjtGeom.mjGEOM_CYLINDER)}


def test_mira_stands_and_droops_its_head(workspaces_dir, workspace, build):
    mira = urdf(workspaces_dir / "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf", workspace)
    engine = Engine(World(models=(build.ground(),)))
    engine.spawn(mira, T_world_model=Pose((0, 0, 0.2)))
    engine.step(1500)
    assert engine.joint("mira::roll_joint").position == pytest.approx(-0.20, abs=5e-3)
    assert engine.joint("mira::pitch_joint").position == pytest.approx(0.44, abs=5e-3)
    base = engine.model_pose("mira")
    assert base.position_m[2] == pytest.approx(0.0450, abs=5e-4)
    assert base.rpy_rad[:2] == pytest.approx((0, 0), abs=0.01)
    yaw = [abs(engine.joint("mira::yaw_joint").position)]
    for _ in range(30):
        engine.step(100)
        yaw.append(abs(engine.joint("mira::yaw_joint").position))
    assert max(yaw) > 1.5, "the head swings on, undamped"


def test_my_robot_coasts_as_computed(workspaces_dir, workspace, build):
    model = sdf(workspaces_dir / "gazebo_models/my_robot/model.sdf", workspace)
    engine = Engine(World(models=(build.ground(),)))
    engine.spawn(model)
    engine.step(1000)
    start = engine.model_pose("my_robot").position_m[0]
    hinges = [engine.joint(f"my_robot::{side}_wheel_hinge") for side in ("left", "right")]
    for hinge in hinges:
        hinge.set_effort(0.1)
    engine.step(2000)
    assert engine.model_pose("my_robot").position_m[0] - start == pytest.approx(0.0198, rel=0.01)
    assert engine.model_velocity("my_robot")[0][0] == pytest.approx(0.0197, rel=0.01)
    assert hinges[0].velocity == pytest.approx(0.197, rel=0.01)
    for hinge in hinges:
        hinge.set_effort(0.0)
    engine.step(2000)
    assert engine.model_velocity("my_robot")[0][0] == pytest.approx(0.0197, rel=0.01)


def test_a_robot_stands_inside_the_hollow_turtlebot3_world(workspace, workspaces_dir, build):
    world = sdf(workspace.model_dir("turtlebot3_world") / "model.sdf", workspace)
    diagnostics = Diagnostics()
    engine = Engine(
        World(models=(build.ground(), world, build.block(pose=Pose((-2.0, -0.5, 0.1))))),
        diagnostics=diagnostics,
    )
    engine.step(1000)
    assert engine.model_pose("block").position_m == pytest.approx((-2.0, -0.5, 0.1), abs=1e-3)
    assert any("wall.dae" in item.message for item in diagnostics.by_code("engine.hollow-mesh"))
