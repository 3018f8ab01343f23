"""Examples 1, 2, 4, 5, 7, 9 and 13 of ros2_control_demos (Jazzy).

The hardware of most is the package's own C++; GAZELLE_MOCK_HARDWARE stands in for it.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from stage import Seen, Stage

DEMO = "ros2_control_demo_example"
SOURCE = "ws/src/ros2_control_demos"
MOCK = {"GAZELLE_MOCK_HARDWARE": "1"}


def expanded(stage: Stage, number: int, name: str, more: str = "") -> ET.Element:
    done = stage.run(f"xacro {SOURCE}/example_{number}/description/urdf/{name}.urdf.xacro {more}")
    assert done.code == 0, done.output
    checked = stage.run("check_urdf /dev/stdin", stdin=done.stdout)
    assert checked.code == 0, checked.output
    return ET.fromstring(done.stdout)


def moving(robot: ET.Element) -> list[str]:
    return [str(one.get("name")) for one in robot.findall("joint") if one.get("type") != "fixed"]


def drive(seen: Seen, topic: str, linear: float, times: int) -> None:
    """Command a stamped speed once for each state of the joints."""
    states = seen.topic("/joint_states")
    for _ in range(times):
        stamp = states.next().header.stamp
        seen.publish(
            topic, header={"stamp": {"sec": stamp.sec, "nanosec": stamp.nanosec}},
            twist={"linear": {"x": linear}},
        )  # fmt: skip


def test_install_rules_are_applied_and_the_robots_expand(stage: Stage) -> None:
    rrbot = expanded(stage, 1, "rrbot")
    assert len(rrbot.findall("link")) == 5
    assert moving(rrbot) == ["joint1", "joint2"]
    r6bot = expanded(stage, 7, "r6bot")
    assert len(r6bot.findall("link")) == 10
    assert len({one.get("filename") for one in r6bot.iter("mesh")}) == 14
    three = expanded(stage, 13, "three_robots")
    assert len(three.findall("link")) == 14
    assert len(moving(three)) == 7
    assert len(three.findall("ros2_control")) == 4
    found = stage.run(f"ros2 pkg prefix --share {DEMO}_1")
    assert found.code == 0, found.output


@pytest.mark.parametrize(
    ("number", "launch", "hardware"),
    [
        (1, "rrbot.launch.py", f"{DEMO}_1/RRBotSystemPositionOnlyHardware"),
        (7, "r6bot_controller.launch.py", f"{DEMO}_7/RobotSystem"),
    ],
)
def test_hardware_in_cpp_is_named(stage: Stage, number: int, launch: str, hardware: str) -> None:
    with stage.launch(f"ros2 launch {DEMO}_{number} {launch} gui:=false") as robot:
        robot.says(hardware)
        assert len(robot.said(hardware)) <= 2, robot.output
        robot.says("GAZELLE_MOCK_HARDWARE")


def test_the_rrbot_moves_with_mock_hardware_by_a_substituted_yaml(stage: Stage) -> None:
    with stage.launch(f"ros2 launch {DEMO}_1 rrbot.launch.py gui:=false", env=MOCK) as robot:
        robot.wait_for_controllers("joint_state_broadcaster", "forward_position_controller")
        read = stage.run("ros2 param get /forward_position_controller joints")
        assert "joint1" in read.output, read.output
        assert "$(var" not in read.output
        robot.has_rate("/joint_states", 10.0)
        robot.publish("/forward_position_controller/commands", data=[0.5, 0.5])
        robot.joint_reaches("joint1", 0.5, 0.001)
        robot.joint_reaches("joint2", 0.5, 0.001)
        publisher = f"ros2 launch {DEMO}_1 test_forward_position_controller.launch.py"
        with stage.launch(publisher):
            robot.joint_reaches("joint1", 0.785, 0.001)
            robot.joint_reaches("joint1", 0.0, 0.001)


def test_the_diffbot_drives_on_a_remapped_topic(stage: Stage) -> None:
    command = f"ros2 launch {DEMO}_2 diffbot.launch.xml gui:=false use_mock_hardware:=true"
    with stage.launch(command) as robot:
        robot.wait_for_node("/my_ctrl_mgr")
        robot.wait_for_controllers(
            "joint_state_broadcaster", "diffbot_base_controller", manager="/my_ctrl_mgr"
        )
        # publish_rate is 50, but the manager's update_rate is 10.
        robot.has_rate("/diffbot_base_controller/odom", 10.0)
        assert "0.015" in stage.run("ros2 param get /diffbot_base_controller wheel_radius").output
        drive(robot, "/cmd_vel", 0.3, 20)
        odom = robot.topic("/diffbot_base_controller/odom").next()
        assert odom.pose.pose.position.x > 0.2
        states = robot.topic("/joint_states").next()
        drive(robot, "/cmd_vel", 0.3, 3)
        assert max(states.velocity) == pytest.approx(0.3 / 0.015, abs=1.0)


def test_the_r6bots_controller_in_cpp_is_named_beside_its_hardware(stage: Stage) -> None:
    command = f"ros2 launch {DEMO}_7 r6bot_controller.launch.py gui:=false"
    with stage.launch(command, env=MOCK) as robot:
        robot.says(f"{DEMO}_7/RobotController")
        robot.wait_for_controllers("joint_state_broadcaster")
        assert len(robot.joints()) == 6


def test_the_rrbot_reaches_its_goal_in_gz_sim(stage: Stage) -> None:
    with stage.launch(f"ros2 launch {DEMO}_9 rrbot_gazebo.launch.py gui:=false") as robot:
        robot.wait_for_controllers("joint_state_broadcaster", "forward_position_controller")
        robot.publish("/forward_position_controller/commands", data=[0.5, 0.5])
        robot.joint_reaches("joint1", 0.5, 0.01)
        robot.joint_reaches("joint2", 0.5, 0.01)


def test_the_three_robots_begin_in_three_states(stage: Stage) -> None:
    command = f"ros2 launch {DEMO}_13 three_robots.launch.py gui:=false rqt:=false"
    with stage.launch(command, env=MOCK) as robots:
        robots.wait_for_controllers(
            "joint_state_broadcaster", "rrbot_joint_state_broadcaster",
            "rrbot_position_controller", "rrbot_external_fts_broadcaster",
            "rrbot_with_sensor_joint_state_broadcaster", "rrbot_with_sensor_fts_broadcaster",
        )  # fmt: skip
        robots.wait_for_controllers(
            "rrbot_with_sensor_position_controller", "threedofbot_joint_state_broadcaster",
            "threedofbot_position_controller", "threedofbot_pid_gain_controller",
            state="inactive",
        )  # fmt: skip
        answer = robots.call("/controller_manager/list_hardware_components")
        states = {one.name: one.state.label for one in answer.component}
        assert len(states) == 4
        assert states.pop("FakeThreeDofBot") == "unconfigured"
        assert states.pop("RRBotSystemWithSensor") == "inactive"
        assert set(states.values()) == {"active"}


@pytest.mark.parametrize(
    "path",
    [
        "example_1/test/test_rrbot_launch.py",
        "example_1/test/test_rrbot_launch_cli_direct.py",
        "example_1/test/test_rrbot_movement.py",
        "example_1/test/test_view_robot_launch.py",
        "example_2/test/test_diffbot_launch.py",
        "example_4/test/test_rrbot_system_with_sensor_launch.py",
        "example_5/test/test_rrbot_system_with_external_sensor_launch.py",
        "example_9/test/test_rrbot_gazebo_launch.py",
        "example_9/test/test_rrbot_launch.py",
        "example_13/test/test_three_robots_launch.py",
    ],
)
def test_the_packages_own_launch_test_passes(stage: Stage, path: str) -> None:
    done = stage.run(f"launch_test {SOURCE}/{path}", timeout_s=240.0, env=MOCK)
    assert done.code == 0, done.output
