"""R2D2 of the tutorials on URDF: drawn, published, turned, gripping and driving (ROS 1)."""

from __future__ import annotations

import math

import pytest
from stage import Seen, Stage, roll_pitch_rad

URDF = "ws/src/urdf_sim_tutorial/urdf"
GRIPPER = ("gripper_extension", "left_gripper_joint", "right_gripper_joint")
WHEELS = {f"{side}_{end}_wheel" for side in ("left", "right") for end in ("front", "back")}


def _stands(launch: Seen) -> None:
    pose = launch.true_pose("robot")
    roll, pitch = roll_pitch_rad(pose.orientation)
    assert max(abs(roll), abs(pitch)) < math.radians(3.0)
    # The wheels' lower edge is 0.485 m below base_link.
    assert pose.position.z == pytest.approx(0.485, abs=0.02)


@pytest.mark.parametrize(
    ("file", "transmissions"),
    [
        ("09-publishjoints", 0),
        ("10-firsttransmission", 1),
        ("12-gripper", 4),
        ("13-diffdrive", 8),
    ],
)
def test_the_robot_has_the_links_joints_and_masses_of_the_tutorial(
    stage: Stage, file: str, transmissions: int
) -> None:
    robot = stage.robot(f"{URDF}/{file}.urdf.xacro")
    assert (len(robot.links), robot.moving) == (16, 8)
    assert robot.mass_kg == pytest.approx(57.25, abs=0.005)
    expanded = stage.run(f"xacro {URDF}/{file}.urdf.xacro")
    assert expanded.stdout.count("<transmission ") == transmissions


def test_without_ros_control_the_robot_stands_and_its_wheels_have_no_frames(stage: Stage) -> None:
    with stage.launch("roslaunch urdf_sim_tutorial gazebo.launch") as launch:
        launch.run_sim(4.0)
        _stands(launch)
        frames = launch.frames(2.0)
        assert "right_leg" in frames
        assert not WHEELS & frames.keys()
        publishers = [one.name for one in launch.graph.topics() if one.publishers]
        assert "/joint_states" not in publishers


def test_joint_states_without_transmissions_are_empty(stage: Stage) -> None:
    # joint_state_controller reads the hardware's joints, and without transmissions it has none.
    with stage.launch("roslaunch urdf_sim_tutorial 09-joints.launch") as launch:
        launch.has_rate("/joint_states", 50.0)
        assert launch.joints() == {}
        assert not launch.said(r"rviz.*has died")


def test_the_head_turns(stage: Stage) -> None:
    with stage.launch("roslaunch urdf_sim_tutorial 10-head.launch") as launch:
        launch.wait_for_topics("/r2d2_head_controller/command")
        stage.run('rostopic pub -1 /r2d2_head_controller/command std_msgs/Float64 "data: 1.0"')
        launch.joint_reaches("head_swivel", 1.0, 0.02)
        launch.run_sim(1.0)
        assert launch.joints()["head_swivel"] == pytest.approx(1.0, abs=0.02)


def test_the_gripper_takes_its_joints_in_the_order_of_the_file(stage: Stage) -> None:
    with stage.launch("roslaunch urdf_sim_tutorial 12-gripper.launch") as launch:
        topic = "/r2d2_gripper_controller/command"
        launch.wait_for_topics(topic)
        stage.run(f'rostopic pub -1 {topic} std_msgs/Float64MultiArray "data: [-0.1, 0.5, 0.5]"')
        for name, position in zip(GRIPPER, (-0.1, 0.5, 0.5), strict=True):
            launch.joint_reaches(name, position, 0.02)


def test_the_robot_drives_no_faster_than_its_limit_and_odometry_tells_the_way(
    stage: Stage,
) -> None:
    with stage.launch("roslaunch urdf_sim_tutorial 13-diffdrive.launch") as launch:
        launch.has_rate("/r2d2_diff_drive_controller/odom", 50.0)
        launch.has_rate("/joint_states", 50.0)
        assert len(launch.joints()) == 8
        assert not launch.said("has died")
        start = launch.true_pose("robot").position
        for _ in range(100):
            launch.publish("/r2d2_diff_drive_controller/cmd_vel", linear={"x": 1.0})
            launch.run_sim(0.1)
        odom = launch.topic("/r2d2_diff_drive_controller/odom").next()
        assert odom.twist.twist.linear.x == pytest.approx(0.2, abs=0.02)
        assert 1.8 <= odom.pose.pose.position.x <= 2.05
        end = launch.true_pose("robot").position
        way_m = math.hypot(end.x - start.x, end.y - start.y)
        assert way_m == pytest.approx(odom.pose.pose.position.x, rel=0.15)
        _stands(launch)
