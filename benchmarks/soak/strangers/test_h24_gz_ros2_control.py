"""The demos and tests of gz_ros2_control (Jazzy, gz sim), all launch files."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET

import pytest
from stage import Stage

PACKAGE = "gz_ros2_control_demos"
URDF = f"ws/src/{PACKAGE}/urdf"
TRAJECTORY = "/joint_trajectory_controller/follow_joint_trajectory"


def launch(name: str, ending: str = "py") -> str:
    return f"ros2 launch {PACKAGE} {name}.launch.{ending}"


def expanded(stage: Stage, name: str) -> ET.Element:
    done = stage.run(f"xacro {URDF}/{name}.xacro.urdf")
    assert done.code == 0, done.output
    return ET.fromstring(done.stdout)


def state(message: object, kind: str) -> dict[str, float]:
    """Return positions or velocities by joint."""
    return dict(zip(message.name, getattr(message, kind), strict=True))  # type: ignore[attr-defined]


def send(stage: Stage, position: float, seconds: int) -> None:
    goal = (
        "{trajectory: {joint_names: [slider_to_cart], points: "
        f"[{{positions: [{position}], time_from_start: {{sec: {seconds}}}}}]}}}}"
    )
    sent = stage.run(
        f'ros2 action send_goal {TRAJECTORY} control_msgs/action/FollowJointTrajectory "{goal}"'
    )
    assert "SUCCEEDED" in sent.output, sent.output


def test_the_gripper_has_four_links_and_58_kg(stage: Stage) -> None:
    robot = expanded(stage, "test_gripper_mimic_joint_position")
    assert len(robot.findall("link")) == 4
    assert sum(float(one.get("value", "")) for one in robot.iter("mass")) == pytest.approx(58.0)


def test_the_ackermann_robot_has_eight_links(stage: Stage) -> None:
    # The base_link that has no body is counted.
    assert len(expanded(stage, "test_ackermann_drive").findall("link")) == 8


@pytest.mark.parametrize("ending", ["xml", "py"])
def test_the_left_finger_follows_the_right_one(stage: Stage, ending: str) -> None:
    with stage.launch(launch("gripper_mimic_joint_example_position", ending)) as gripper:
        gripper.wait_for_controllers("joint_state_broadcaster", "gripper_controller")
        assert gripper.joints()["right_finger_joint"] == pytest.approx(0.15, abs=0.01)
        answer = gripper.call("/controller_manager/list_controllers")
        types = {one.name: one.type for one in answer.controller}
        # It stands in the file of --param-file alone.
        assert types["gripper_controller"] == "forward_command_controller/ForwardCommandController"
        gripper.publish("/gripper_controller/commands", data=[0.3])
        gripper.joint_reaches("right_finger_joint", 0.3, 0.01)
        gripper.joint_reaches("left_finger_joint", 0.3, 0.01)
        assert not gripper.said("ros2_control_demo_description")
        assert not gripper.said("allow.renaming")


@pytest.mark.parametrize("ending", ["xml", "py"])
def test_an_effort_moves_both_fingers(stage: Stage, ending: str) -> None:
    with stage.launch(launch("gripper_mimic_joint_example_effort", ending)) as gripper:
        gripper.wait_for_controllers("joint_state_broadcaster", "gripper_controller")
        gripper.publish("/gripper_controller/commands", data=[20.0])
        gripper.joint_reaches("right_finger_joint", 0.38, 0.02)
        gripper.joint_reaches("left_finger_joint", 0.38, 0.02)


def test_the_ackermann_robot_turns_its_wheels_by_different_angles(stage: Stage) -> None:
    with stage.launch(launch("ackermann_drive_example")) as robot:
        robot.wait_for_controllers("joint_state_broadcaster", "ackermann_steering_controller")
        robot.has_rate("/joint_states", 10.0)
        info = stage.run("ros2 topic info /ackermann_steering_controller/reference")
        assert "geometry_msgs/msg/TwistStamped" in info.output, info.output
        robot.drive("/ackermann_steering_controller/reference", 0.5, 0.2, 5.0, stamped=True)
        at = robot.joints()
        # The radius is v / w = 2.5 m, the base 1.7 m, the track 1.0 m. The controller takes the
        # right wheel's name first, and the package's YAML has the left one there.
        assert at["left_wheel_steering_joint"] == pytest.approx(math.atan(1.7 / 3.0), abs=0.03)
        assert at["right_wheel_steering_joint"] == pytest.approx(math.atan(1.7 / 2.0), abs=0.03)
        odom = robot.topic("/ackermann_steering_controller/odometry").next()
        assert odom.header.frame_id == "odom"
        assert odom.pose.pose.position.x > 0.5


def test_the_tricycle_turns_its_wheel(stage: Stage) -> None:
    with stage.launch(launch("tricycle_drive_example")) as robot:
        robot.wait_for_controllers("joint_state_broadcaster", "tricycle_controller")
        robot.drive("/tricycle_controller/cmd_vel", 0.2, 0.1, 5.0, stamped=True)
        assert robot.joints()["steering_joint"] == pytest.approx(
            math.atan(1.7 * 0.1 / 0.2), abs=0.08
        )
        assert robot.topic("/tricycle_controller/odom").next().pose.pose.position.x > 0.3


def test_the_diff_drive_goes_by_stamped_speeds(stage: Stage) -> None:
    with stage.launch(launch("diff_drive_example")) as robot:
        robot.wait_for_controllers("joint_state_broadcaster", "diff_drive_base_controller")
        robot.has_rate("/diff_drive_base_controller/odom", 50.0)
        robot.drive("/diff_drive_base_controller/cmd_vel", 0.2, 0.1, 4.0, stamped=True)
        odom = robot.topic("/diff_drive_base_controller/odom").next()
        assert odom.twist.twist.linear.x == pytest.approx(0.2, abs=0.02)
        assert odom.twist.twist.angular.z == pytest.approx(0.1, abs=0.02)
        assert odom.pose.pose.position.x > 0.4


def test_the_cart_starts_at_5_m_and_goes_where_it_is_sent(stage: Stage) -> None:
    with stage.launch(launch("cart_example_position")) as cart:
        cart.wait_for_controllers("joint_state_broadcaster", "joint_trajectory_controller")
        assert cart.joints()["slider_to_cart"] == pytest.approx(5.0, abs=0.05)
        send(stage, 1.0, 2)
        cart.joint_reaches("slider_to_cart", 1.0, 0.05)


def test_the_cart_goes_as_fast_as_it_is_told_and_has_an_imu(stage: Stage) -> None:
    with stage.launch(launch("cart_example_velocity")) as cart:
        cart.wait_for_controllers(
            "joint_state_broadcaster", "velocity_controller", "imu_sensor_broadcaster"
        )
        cart.publish("/velocity_controller/commands", data=[1.0])
        cart.topic("/joint_states").wait_for(
            lambda m: abs(state(m, "velocity")["slider_to_cart"] - 1.0) < 0.05
        )
        imu = cart.topic("/imu_sensor_broadcaster/imu").next()
        assert imu.header.frame_id == "imu"
        assert imu.linear_acceleration.z == pytest.approx(9.8, abs=0.2)


def test_an_effort_accelerates_the_cart(stage: Stage) -> None:
    with stage.launch(launch("cart_example_effort")) as cart:
        cart.wait_for_controllers("joint_state_broadcaster", "effort_controller")
        assert cart.joints()["slider_to_cart"] == pytest.approx(1.0, abs=0.05)
        cart.publish("/effort_controller/commands", data=[10.0])
        cart.topic("/joint_states").wait_for(lambda m: state(m, "velocity")["slider_to_cart"] > 1.0)
        cart.publish("/effort_controller/commands", data=[0.0])


def test_the_pendulums_cart_goes_where_it_is_sent(stage: Stage) -> None:
    with stage.launch(launch("pendulum_example_position")) as cart:
        cart.wait_for_controllers("joint_state_broadcaster", "joint_trajectory_controller")
        at = cart.joints()
        assert at["slider_to_cart"] == pytest.approx(1.0, abs=0.05)
        assert len(at) == 2
        send(stage, 0.0, 1)
        cart.joint_reaches("slider_to_cart", 0.0, 0.05)


def test_an_effort_moves_the_pendulums_cart(stage: Stage) -> None:
    with stage.launch(launch("pendulum_example_effort")) as cart:
        cart.wait_for_controllers("joint_state_broadcaster", "effort_controller")
        cart.publish("/effort_controller/commands", data=[20.0])
        cart.topic("/joint_states").wait_for(lambda m: state(m, "velocity")["slider_to_cart"] > 0.5)
        cart.publish("/effort_controller/commands", data=[0.0])


def test_the_packages_own_launch_test_waits_for_the_spawner(stage: Stage) -> None:
    done = stage.run(
        "launch_test ws/src/gz_ros2_control_tests/tests/position_test.py", timeout_s=240.0
    )
    # Its node is C++: the wait for 'Configured and activated' has passed when that is told.
    assert "Configured and activated" in done.output, done.output
    assert re.search("test_position.*compiled code", done.output), done.output
    assert done.code != 0


@pytest.mark.parametrize(
    "example", ["ackermann_drive", "gripper", "position", "velocity", "effort", "diff_drive"]
)
def test_an_example_in_cpp_is_named_in_one_line(stage: Stage, example: str) -> None:
    done = stage.run(f"ros2 run {PACKAGE} example_{example}")
    assert done.code != 0
    told = [line for line in done.output.splitlines() if f"example_{example}" in line]
    assert len(told) == 1, done.output
    assert PACKAGE in told[0]
    assert "compiled code" in told[0]
