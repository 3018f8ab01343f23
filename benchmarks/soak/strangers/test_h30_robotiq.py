"""The grippers of Robotiq (ros2_robotiq_gripper, Jazzy): descriptions, driver, controllers."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import pytest
from stage import Stage

SOURCE = "ws/src/ros2_robotiq_gripper/robotiq_description/urdf"


def expanded(stage: Stage, size: str) -> ET.Element:
    done = stage.run(f"xacro {SOURCE}/robotiq_2f_{size}_gripper.urdf.xacro use_fake_hardware:=true")
    assert done.code == 0, done.output
    checked = stage.run("check_urdf /dev/stdin", stdin=done.stdout)
    assert checked.code == 0, checked.output
    robot = ET.fromstring(done.stdout)
    assert "robot name is: robotiq_gripper" in checked.stdout
    assert len(re.findall(r"child\(\d+\)", checked.stdout)) == len(robot.findall("link")) - 1
    return robot


def mimics(robot: ET.Element) -> dict[str, float]:
    return {
        str(joint.get("name")): float(mimic.get("multiplier", "1"))
        for joint in robot.findall("joint")
        for mimic in joint.findall("mimic")
    }


def mass(robot: ET.Element) -> float:
    return sum(float(one.get("value", "0")) for one in robot.iter("mass"))


def test_the_2f_85_has_ten_links_and_five_joints_that_mimic(stage: Stage) -> None:
    robot = expanded(stage, "85")
    assert len(robot.findall("link")) == 10
    moving = [one for one in robot.findall("joint") if one.get("type") == "revolute"]
    assert len(moving) == 6
    assert list(mimics(robot).values()) == [-1.0, 1.0, -1.0, -1.0, 1.0]
    assert {one.get("joint") for one in robot.iter("mimic")} == {"robotiq_85_left_knuckle_joint"}
    limit = next(one for one in moving if one.get("name") == "robotiq_85_left_knuckle_joint").find(
        "limit"
    )
    assert limit is not None
    assert (float(limit.get("lower", "")), float(limit.get("upper", ""))) == (0.0, 0.8)
    assert mass(robot) == pytest.approx(0.92, abs=0.01)


def test_the_2f_140_has_thirteen_links_and_five_joints_that_mimic(stage: Stage) -> None:
    robot = expanded(stage, "140")
    assert len(robot.findall("link")) == 13
    assert list(mimics(robot).values()) == [-1.0, 1.0, -1.0, -1.0, 1.0]
    assert {one.get("joint") for one in robot.iter("mimic")} == {"finger_joint"}


def test_all_meshes_are_found(stage: Stage) -> None:
    for size in ("85", "140"):
        done = stage.run(f"gazelle doctor {SOURCE}/robotiq_2f_{size}_gripper.urdf.xacro")
        assert "mesh" not in done.output, done.output


def test_the_gripper_is_shown_and_its_mimic_joints_follow(stage: Stage) -> None:
    with stage.launch("ros2 launch robotiq_description view_gripper.launch.py") as view:
        view.wait_for_node("/robot_state_publisher")
        states = view.topic("/joint_states").next()
        assert len(states.name) == 6
        frames = set()
        for _ in range(5):
            frames |= {one.child_frame_id for one in view.topic("/tf").next().transforms}
        assert "robotiq_85_right_finger_tip_link" in frames
        # Windows of RViz and of the publisher's sliders: at most a line each, and nothing stops.
        assert len(view.said("rviz2")) <= 4, view.output
        assert view.exit_code is None


def test_the_publisher_has_one_free_joint_and_five_that_follow(stage: Stage) -> None:
    urdf = stage.run(f"xacro {SOURCE}/robotiq_2f_85_gripper.urdf.xacro use_fake_hardware:=true")
    path = stage.home / "gripper.urdf"
    path.write_text(urdf.stdout)
    with stage.launch(
        f"ros2 run joint_state_publisher joint_state_publisher {path} "
        "--ros-args -p zeros.robotiq_85_left_knuckle_joint:=0.4"
    ) as publisher:
        assert publisher.joints() == pytest.approx(
            {
                "robotiq_85_left_knuckle_joint": 0.4,
                "robotiq_85_right_knuckle_joint": -0.4,
                "robotiq_85_left_inner_knuckle_joint": 0.4,
                "robotiq_85_right_inner_knuckle_joint": -0.4,
                "robotiq_85_left_finger_tip_joint": -0.4,
                "robotiq_85_right_finger_tip_joint": 0.4,
            }
        )


def test_the_driver_in_cpp_is_named_and_the_absent_file_too(stage: Stage) -> None:
    with stage.launch("ros2 launch robotiq_description robotiq_control.launch.py") as control:
        line = control.says(r"robotiq_update_rate\.yaml")
        assert "robotiq_description/config/robotiq_update_rate.yaml" in line
        control.says(r"robotiq_driver/RobotiqGripperHardwareInterface")
        assert len(control.said("RobotiqGripperHardwareInterface")) <= 2, control.output
        control.topic("/robot_description").next()


def test_mock_hardware_takes_the_drivers_place(stage: Stage) -> None:
    mock = {"GAZELLE_MOCK_HARDWARE": "1"}
    command = "ros2 launch robotiq_description robotiq_control.launch.py"
    with stage.launch(command, env=mock) as control:
        control.says("robotiq_controllers/RobotiqActivationController")
        control.wait_for_controllers("joint_state_broadcaster")
        assert control.joints()["robotiq_85_left_knuckle_joint"] == pytest.approx(0.7929)
        # The package's YAML asks for command interfaces that neither its URDF nor its driver has
        # (max_velocity_interface: …/velocity), so that this controller cannot run anywhere.
        control.says("robotiq_gripper_controller.*left_knuckle_joint/velocity")
