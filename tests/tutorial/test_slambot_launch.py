"""``roslaunch slam_robot slam_robot_gazebo.launch`` as it is, and its keyboard (S1, S6)."""

from __future__ import annotations

import itertools
import os
import termios
from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(12)]

_LAUNCH = ("roslaunch", "slam_robot", "slam_robot_gazebo.launch")
_TOPICS = {
    "/clock": "rosgraph_msgs/msg/Clock",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/odom": "nav_msgs/msg/Odometry",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/joint_states": "sensor_msgs/msg/JointState",
    "/cmd_vel": "geometry_msgs/msg/Twist",
    "/camera/rgb/image_raw": "sensor_msgs/msg/Image",
    "/camera/depth_registered/image_raw": "sensor_msgs/msg/Image",
    "/depth_camera/rgb/camera_info": "sensor_msgs/msg/CameraInfo",
    "/depth_camera/depth/camera_info": "sensor_msgs/msg/CameraInfo",
    "/depth_camera/depth/points": "sensor_msgs/msg/PointCloud2",
    "/gazebo/model_states": "gazebo_msgs/msg/ModelStates",
    "/gazebo/link_states": "gazebo_msgs/msg/LinkStates",
}
_FRAMES = {
    "odom": None,
    "base_footprint": "odom",
    "base_link": "base_footprint",
    "left_wheel_link": "base_footprint",
    "right_wheel_link": "base_footprint",
    "prewheel_support_link": "base_link",
    "prewheel_link": "prewheel_support_link",
    "backwheel_support_link": "base_link",
    "backwheel_link": "backwheel_support_link",
    "depth_camera_link": "base_link",
    "laser_radar_link": "base_link",
}


def _ms(message: Any) -> int:
    stamp = message.header.stamp
    return int(stamp.sec) * 1000 + int(stamp.nanosec) // 1_000_000


def _steps(messages: list[Any]) -> set[int]:
    times = [_ms(message) for message in messages]
    return {later - earlier for earlier, later in itertools.pairwise(times)}


@pytest.fixture(scope="module")
def robot(module_in_workspace: Callable) -> Iterator[Any]:
    """The launched robot; nothing is left of it."""
    robot = module_in_workspace(*_LAUNCH)
    robot.wait_for_line(r"Spawn status: SpawnModel: Successfully spawned entity")
    yield robot
    assert robot.stop() == 0
    assert robot.processes() == {}


def test_slambot_comes_up_with_all_topics_rates_and_frames(robot: Any) -> None:
    got = robot.messages(
        {"/scan": 6, "/odom": 100, "/clock": 500, "/tf": 150, "/tf_static": 1, "/joint_states": 110}
    )
    known = dict(robot.graph.topic_names_and_types())
    assert {topic: known.get(topic) for topic in _TOPICS} == _TOPICS
    _check_scan_and_odometry(got)
    _check_frames(got["/tf"], got["/tf_static"])
    _check_joint_states(got["/joint_states"])


def _check_scan_and_odometry(got: dict[str, list[Any]]) -> None:
    assert _steps(got["/scan"]) == {182}
    assert _steps(got["/odom"]) == {10}
    ticks = [int(m.clock.sec) * 1000 + int(m.clock.nanosec) // 10**6 for m in got["/clock"]]
    assert {b - a for a, b in itertools.pairwise(ticks)} == {1}
    scan, odom = got["/scan"][0], got["/odom"][0]
    assert (scan.header.frame_id, len(scan.ranges)) == ("laser_radar_link", 360)
    assert (scan.angle_min, scan.angle_max) == (-3.0, 3.0)
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_footprint")


def _check_frames(moving: list[Any], fixed: list[Any]) -> None:
    parents: dict[str, set[str]] = {}
    for message in (*moving, *fixed):
        for one in message.transforms:
            parents.setdefault(one.child_frame_id, set()).add(one.header.frame_id)
    assert parents == {child: {parent} for child, parent in _FRAMES.items() if parent}


def _check_joint_states(messages: list[Any]) -> None:
    wheels = {"left_wheel_joint", "right_wheel_joint"}
    driven = [m for m in messages if set(m.name) == wheels]
    others = [m for m in messages if set(m.name) != wheels]
    assert _steps(driven) == {10}
    assert others and not any(wheels & set(m.name) for m in others)


def test_slambot_cameras_have_the_launch_files_names(robot: Any) -> None:
    images = ("/camera/rgb/image_raw", "/camera/depth_registered/image_raw")
    infos = ("/depth_camera/rgb/camera_info", "/depth_camera/depth/camera_info")
    cloud = "/depth_camera/depth/points"
    got = robot.messages(dict.fromkeys((*images, *infos, cloud), 3))
    for topic in (*images, *infos, cloud):
        assert {m.header.frame_id for m in got[topic]} == {"depth_camera_link"}
        assert {(m.width, m.height) for m in got[topic]} == {(640, 480)}
        # A late frame is dropped in real time: the grid is 20 Hz all the same.
        assert {step % 50 for step in _steps(got[topic])} == {0}
    assert [got[topic][0].encoding for topic in images] == ["rgb8", "32FC1"]
    assert [got[topic][0].step for topic in images] == [1920, 2560]
    for topic in infos:
        info = got[topic][0]
        assert info.distortion_model == "plumb_bob"
        assert [round(info.k[i], 3) for i in (0, 2, 4, 5)] == [552.467, 320.5, 552.467, 240.5]
    points = got[cloud][0]
    assert [(f.name, f.offset) for f in points.fields] == [
        ("x", 0),
        ("y", 4),
        ("z", 8),
        ("rgb", 16),
    ]
    assert points.point_step == 32


def test_teleop_drives_forward_and_back_and_ctrl_c_stops_the_robot(
    robot: Any, module_in_workspace: Callable, terminal: tuple[int, int]
) -> None:
    """``rosrun slam_robot slam_robot_teleop.py``, Python 2 source and all, at a terminal."""
    keys, seen = terminal
    before = termios.tcgetattr(seen)
    speeds: list[float] = []
    commands: list[float] = []
    listen = robot.node.create_subscription
    odometry, twist = "nav_msgs/msg/Odometry", "geometry_msgs/msg/Twist"
    listen("/odom", odometry, lambda message: speeds.append(message.twist.twist.linear.x))
    listen("/cmd_vel", twist, lambda message: commands.append(message.linear.x))

    teleop = module_in_workspace("rosrun", "slam_robot", "slam_robot_teleop.py", stdin=seen)
    teleop.wait_for_line("CTRL-C to quit")

    def typed(key: bytes, arrived: Callable[[], Any]) -> None:
        """Hold a key down until something is so."""

        def press() -> bool:
            os.write(keys, key)
            return bool(arrived())

        robot.eventually(press)

    typed(b"i", lambda: speeds and speeds[-1] > 0.05)
    typed(b",", lambda: speeds[-1] < -0.05)
    typed(b"\x03", lambda: teleop.popen.poll() is not None)
    assert teleop.wait() == 0
    robot.eventually(lambda: commands[-1] == 0.0 and abs(speeds[-1]) < 0.005)
    assert termios.tcgetattr(seen) == before
    assert "translated on the fly; the file stays as it is [launch.python2]" in teleop.text
    assert "currently:\tspeed 1\tturn 1" in teleop.text
