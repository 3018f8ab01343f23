"""A URDF that is read and written again is the same robot."""

from __future__ import annotations

import pytest
from tests.description.recorded_robots import OWN, SAMPLES, RecordedRobots
from tests.description.writers.conftest import OWN_ROS1, REPOSITORY
from tests.shared_files import SHARED, shared_cases

from gazelle.description.loader import load_models
from gazelle.description.writers import to_urdf
from gazelle.diagnostics import Diagnostics

OWN_ROBOTS = (
    REPOSITORY / "examples/arm_ws/src/heron_description/urdf/heron.urdf.xacro",
    REPOSITORY / "examples/four_wheel_ws/src/courier_robot/urdf/courier.urdf.xacro",
    REPOSITORY / "examples/scout_ws/src/scout_robot/urdf/scout.urdf.xacro",
    OWN_ROS1 / "src/shown_robot/urdf/barrow.urdf",
    OWN_ROS1 / "src/shown_robot/urdf/barrow.urdf.xacro",
    REPOSITORY / "tests/description/converted/trolley.urdf",
)
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


@pytest.mark.parametrize(
    "file",
    [*OWN_ROBOTS, *shared_cases(*(SHARED / "workspaces" / name for name in ROBOTS))],
    ids=lambda file: file.name,
)
def test_robots_of_the_workspaces_come_back_equal(file, reading, workspace) -> None:
    model = reading.model(file, workspace)
    text = to_urdf(model, diagnostics=Diagnostics()).text
    assert reading.differences(model, reading.model(text, workspace)) == []


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_every_robot_that_check_urdf_accepts_comes_back_equal(
    reading, robots: RecordedRobots
) -> None:
    compared = 0
    for name in robots.names:
        if "Successfully Parsed" not in robots.run(name).out:
            continue
        for model in load_models(robots.file(name), workspace=None, diagnostics=Diagnostics()):
            text = to_urdf(model, diagnostics=Diagnostics()).text
            assert reading.differences(model, reading.model(text)) == [], name
            compared += 1
    assert compared > 10


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_good_robot_reads_without_a_finding_when_written(reading, robots: RecordedRobots) -> None:
    model = reading.model(robots.file("good"))
    found = Diagnostics()
    to_urdf(model, diagnostics=found)
    assert list(found) == []
