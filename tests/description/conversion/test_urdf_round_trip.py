"""A URDF that is read and written again is the same robot."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.conversion import to_urdf
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics

ROBOTS = (
    "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf",
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf",
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo_camera.urdf",
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo_controller.urdf",
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf",
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf.xacro",
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot_stl.urdf",
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot_visual.urdf",
    "ros2_ws/src/luck_description/urdf/luck_description.urdf",
    "ros2_ws/src/luck_robot/config/luck_description.urdf.xacro",
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro",
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro",
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle_pi.urdf.xacro",
)


@pytest.mark.parametrize("name", ROBOTS)
def test_robots_of_the_workspaces_come_back_equal(name, reading, workspace, workspaces_dir) -> None:
    model = reading.model(workspaces_dir / name, workspace)
    text = to_urdf(model, diagnostics=Diagnostics()).text
    assert reading.differences(model, reading.model(text, workspace)) == []


def test_every_robot_that_check_urdf_accepts_comes_back_equal(reading, oracles_dir) -> None:
    compared = 0
    for file in sorted((oracles_dir / "urdf").glob("*.urdf")):
        said = (oracles_dir / "check_urdf" / f"{file.stem}.txt").read_text(encoding="utf-8")
        if "Successfully Parsed" not in said:
            continue
        for model in load_models(file, workspace=None, diagnostics=Diagnostics()):
            text = to_urdf(model, diagnostics=Diagnostics()).text
            assert reading.differences(model, reading.model(text)) == [], file.name
            compared += 1
    assert compared > 10


def test_good_oracle_reads_without_a_finding_when_written(oracles_dir: Path, reading) -> None:
    model = reading.model(oracles_dir / "urdf" / "good.urdf")
    found = Diagnostics()
    to_urdf(model, diagnostics=found)
    assert list(found) == []
