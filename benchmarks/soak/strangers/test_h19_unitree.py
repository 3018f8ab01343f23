"""Unitree's Go1, H1 and G1: paths made of arguments, controllers in C++, a paused start."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from stage import Stage, robot_parts

ROBOTS = "ws/src/unitree_ros/robots"
GO1 = "roslaunch unitree_gazebo normal.launch rname:=go1 wname:=stairs gui:=false"
PLUGINS = (
    "libunitreeFootContactPlugin.so",
    "libunitreeDrawForcePlugin.so",
    "libLinkPlot3DPlugin.so",
)


def test_go1_has_twelve_joints(stage: Stage) -> None:
    robot = stage.robot(f"{ROBOTS}/go1_description/xacro/robot.xacro DEBUG:=false")
    assert len(robot.links) == 46
    assert robot.kinds["revolute"] == 12
    assert robot.mass_kg == pytest.approx(13.10, abs=0.005)


def test_go1_stands_on_the_stairs_with_what_is_not_in_cpp(stage: Stage) -> None:
    with stage.launch(GO1) as launch:
        launch.wait_until(0.001, 180.0)
        launch.has_rate("/go1_gazebo/joint_states", 1000.0, sim_s=1.0)
        assert len(launch.joints("/go1_gazebo/joint_states")) == 12
        launch.true_pose("go1_gazebo")
        told = launch.said("unitree_legged_control/UnitreeJointController")
        assert told
        for plugin in PLUGINS:
            assert len(launch.said(rf"warning: .*{re.escape(plugin)}")) == 1, plugin
        # libgazebo_ros_force.so has a twin: it listens to forces on the trunk.
        launch.wait_for_topics("/apply_force/trunk")


def test_h1_starts_paused_and_stays_where_it_is(stage: Stage) -> None:
    with stage.launch("roslaunch h1_description gazebo.launch") as launch:
        launch.says("Successfully spawned entity")
        # /gazebo/model_states comes with the steps, of which a paused world has none.
        for _ in range(2):
            state = launch.call("/gazebo/get_model_state", model_name="h1_description")
            assert state.success, state.status_message
            assert state.pose.position.z == pytest.approx(1.05, abs=0.001)
        assert launch.sim_time_s == 0.0
        publishers = [one.name for one in launch.graph.topics() if one.publishers]
        assert "/joint_states" not in publishers


@pytest.mark.parametrize(
    ("file", "links", "revolute", "mass_kg"),
    [
        ("h1_description/urdf/h1.urdf", 25, 19, 59.34),
        ("g1_description/g1_29dof.urdf", 40, 29, 35.12),
    ],
)
def test_the_humanoids_have_their_joints(
    stage: Stage, file: str, links: int, revolute: int, mass_kg: float
) -> None:
    robot = robot_parts((stage.folder / ROBOTS / file).read_text())
    assert len(robot.links) == links
    assert robot.kinds["revolute"] == revolute
    assert robot.mass_kg == pytest.approx(mass_kg, abs=0.005)


def test_meshes_beside_the_urdf_of_g1_are_found(folder: Path, stage: Stage) -> None:
    urdf = folder / ROBOTS / "g1_description/g1_29dof.urdf"
    meshes = set(re.findall(r'filename="(meshes/[^"]+\.STL)"', urdf.read_text()))
    assert len(meshes) == 36
    done = stage.run(f"check_urdf {urdf}")
    assert done.code == 0, done.output
    assert "Successfully Parsed XML" in done.stdout
    assert "not found" not in done.output
    assert "not found" not in stage.run(f"doctor {urdf}").output
