"""The test configurations of ros_controllers, whose hardware nodes are C++ (ROS 1)."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

import pytest
from stage import Seen, Stage

SOURCE = "ws/src/ros_controllers"
TEST = f"{SOURCE}/diff_drive_controller/test"
COMMON = "roslaunch diff_drive_controller diff_drive_common.launch"
# The package's robot in Gazebo, as its node diffbot would offer its joints.
SIMULATED = """
<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  {transmissions}
  <xacro:include filename="$(find diff_drive_controller)/test/{robot}.xacro"/>
  <gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>
</robot>
"""
TRANSMISSION = """
  <transmission name="{wheel}_trans">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="{wheel}">
      <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface>
    </joint>
    <actuator name="{wheel}_motor"/>
  </transmission>
"""
LAUNCH = """
<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <param name="robot_description" command="$(find xacro)/xacro '{xacro}'"/>
  <node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description
      -model robot"/>
  <rosparam command="load" file="{parameters}"/>
  <node pkg="controller_manager" type="spawner" name="spawner" output="screen"
      args="{controller}"/>
</launch>
"""


@contextlib.contextmanager
def _simulated(
    stage: Stage, folder: Path, robot: str, parameters: str, controller: str
) -> Iterator[Seen]:
    wheels = ("wheel_0_joint", "wheel_1_joint") if robot == "diffbot" else ()
    transmissions = "".join(TRANSMISSION.format(wheel=wheel) for wheel in wheels)
    (folder / "robot.xacro").write_text(SIMULATED.format(robot=robot, transmissions=transmissions))
    text = LAUNCH.format(
        xacro=folder / "robot.xacro",
        parameters=stage.folder / SOURCE / parameters,
        controller=controller,
    )
    (folder / "robot.launch").write_text(text)
    with stage.launch(f"roslaunch {folder / 'robot.launch'}") as launch:
        yield launch


@pytest.mark.parametrize(
    ("file", "links", "moving"),
    [
        ("diff_drive_controller/test/diffbot.xacro", 4, 2),
        ("diff_drive_controller/test/skidsteerbot.xacro", 8, 6),
        ("ackermann_steering_controller/test/common/urdf/ackermann_steering_bot.xacro", 10, 8),
    ],
)
def test_the_robots_have_their_wheels(stage: Stage, file: str, links: int, moving: int) -> None:
    robot = stage.robot(f"{SOURCE}/{file}")
    assert (len(robot.links), robot.moving) == (links, moving)
    if "diffbot" in file:
        assert {"wheel_0_joint", "wheel_1_joint"} <= set(robot.joints)


def test_the_node_in_cpp_is_named_and_the_spawner_gives_up(stage: Stage) -> None:
    with stage.launch(COMMON) as launch:
        told = launch.says("compiled code")
        assert "[diffbot]" in told
        assert "[diff_drive_controller]" in told
        # Nobody publishes /clock: the spawner waits in real time, as rospy does.
        launch.says(
            "Controller Spawner couldn't find the expected controller_manager ROS interface"
        )


@pytest.mark.parametrize("file", ["diff_drive_wrong.test", "diff_drive_bad_urdf.test"])
def test_a_test_file_is_read_as_a_launch_and_its_program_named(stage: Stage, file: str) -> None:
    done = stage.run(f"rostest diff_drive_controller {file}", timeout_s=180.0)
    assert done.code != 0
    for name in ("diffbot", "diff_drive_fail_test"):
        assert [
            line
            for line in done.output.splitlines()
            if f"[{name}]" in line and "compiled code" in line
        ], done.output


def test_a_joint_that_does_not_exist_is_named(stage: Stage, tmp_path: Path) -> None:
    files = ("diffbot", "diff_drive_controller/test/diffbot_wrong.yaml", "diffbot_controller")
    with _simulated(stage, tmp_path, *files) as launch:
        launch.says("this_joint_does_not_exist")
        launch.says("Failed to load diffbot_controller|Failed to start controllers")


def test_a_description_with_other_wheels_names_the_wheel_that_is_missing(
    stage: Stage, tmp_path: Path
) -> None:
    files = ("diffbot_bad", "diff_drive_controller/test/diffbot_controllers.yaml")
    with _simulated(stage, tmp_path, *files, "diffbot_controller") as launch:
        launch.says("wheel_0_joint")


def test_the_robot_drives_a_metre_in_ten_seconds(stage: Stage, tmp_path: Path) -> None:
    files = ("diffbot", "diff_drive_controller/test/diffbot_controllers.yaml")
    with _simulated(stage, tmp_path, *files, "diffbot_controller") as launch:
        launch.has_rate("/diffbot_controller/odom", 50.0)
        odom = launch.topic("/diffbot_controller/odom")
        before = odom.next()
        launch.drive("/diffbot_controller/cmd_vel", 0.1, 0.0, 10.0)
        launch.publish("/diffbot_controller/cmd_vel")
        launch.run_sim(1.0)
        odom.clear()
        way_m = odom.next().pose.pose.position.x - before.pose.pose.position.x
        assert way_m == pytest.approx(1.0, abs=0.01)


def test_joints_that_a_file_adds_are_published_as_it_says(stage: Stage, tmp_path: Path) -> None:
    file = "joint_state_controller/test/joint_state_controller_extra_joints_ok.yaml"
    with _simulated(stage, tmp_path, "diffbot", file, "joint_state_controller") as launch:
        launch.has_rate("/joint_states", 10.0)
        one = launch.topic("/joint_states").next()
        rows = zip(one.position, one.velocity, one.effort, strict=True)
        values = dict(zip(one.name, rows, strict=True))
        assert values["extra1"] == (10.0, 20.0, 30.0)
        assert values["extra2"] == (-10.0, 0.0, 0.0)
        assert values["extra3"] == (0.0, 0.0, 0.0)
