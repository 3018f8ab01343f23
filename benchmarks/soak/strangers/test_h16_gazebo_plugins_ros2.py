"""The demo worlds of gazebo_plugins for ROS 2: 29 of them, as gazebo.launch.py runs them."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from stage import Seen, Stage

WORLDS = "ws/src/gazebo_plugins/worlds"
NAMES = [
    "ackermann_drive",
    "bumper",
    "camera",
    "camera_distortion_barrel",
    "camera_distortion_pincushion",
    "camera_triggered",
    "depth_camera",
    "diff_drive",
    "elevator",
    "force",
    "ft_sensor",
    "gps_sensor",
    "hand_of_god",
    "harness",
    "joint_pose_trajectory",
    "joint_state_publisher",
    "multi_camera",
    "multicamera",
    "p3d",
    "planar_move",
    "projector",
    "ray_sensor",
    "skid_steer_drive",
    "template",
    "tricycle_drive",
    "vacuum_gripper",
    "video",
    "wheel_slip",
    "wheel_slip_drawbar_pull",
]


@contextlib.contextmanager
def _demo(stage: Stage, name: str) -> Iterator[Seen]:
    world = stage.folder / WORLDS / f"gazebo_ros_{name}_demo.world"
    words = f"ros2 launch gazebo_ros gazebo.launch.py world:={world} gui:=false"
    with stage.launch(words) as launch:
        launch.wait_until(0.001)
        yield launch


def test_these_are_all_worlds_of_the_package(folder: Path) -> None:
    files = sorted(file.name for file in (folder / WORLDS).glob("*.world"))
    assert files == [f"gazebo_ros_{name}_demo.world" for name in NAMES]


@pytest.mark.parametrize("name", NAMES)
def test_a_demo_world_loads_and_runs(stage: Stage, name: str) -> None:
    done = stage.run(f"gzserver --iters 50 {WORLDS}/gazebo_ros_{name}_demo.world")
    assert done.code == 0, done.output
    assert "error:" not in done.output, done.output
    plugin = f"libgazebo_ros_{name}.so"
    if name in {"elevator", "harness", "projector", "video"}:
        told = [line for line in done.output.splitlines() if plugin in line and "warning" in line]
        assert len(told) == 1, done.output


def test_the_differential_drive_takes_commands_and_tells_its_way(stage: Stage) -> None:
    with _demo(stage, "diff_drive") as launch:
        launch.wait_for_topics("/demo/cmd_demo", "/demo/odom_demo")
        done = stage.run(
            "ros2 topic pub -1 /demo/cmd_demo geometry_msgs/msg/Twist '{linear: {x: 1.0}}'"
        )
        assert done.code == 0, done.output
        launch.run_sim(2.0)
        odom = launch.topic("/demo/odom_demo").next()
        assert odom.twist.twist.linear.x == pytest.approx(1.0, abs=0.1)
        assert launch.frames()["chassis"] == "odom_demo"


def test_joint_states_come_at_the_worlds_rate(stage: Stage) -> None:
    with _demo(stage, "joint_state_publisher") as launch:
        launch.has_rate("/demo/joint_states_demo", 2.0)
        assert set(launch.joints("/demo/joint_states_demo")) == {"upper_joint", "lower_joint"}


def test_the_true_pose_comes_at_the_worlds_rate(stage: Stage) -> None:
    with _demo(stage, "p3d") as launch:
        launch.has_rate("/demo/p3d_demo", 1.0)
        # <frame_name> is the link that poses are told in.
        assert launch.topic("/demo/p3d_demo").next().header.frame_id == "sphere_link"


def test_the_planar_move_tells_its_way(stage: Stage) -> None:
    with _demo(stage, "planar_move") as launch:
        launch.publish("/demo/cmd_demo", linear={"y": 0.5})
        launch.run_sim(1.0)
        odom = launch.topic("/demo/odom_demo").next()
        assert odom.twist.twist.linear.y == pytest.approx(0.5, abs=0.1)


def test_the_prius_tells_distance_and_steering_angle(stage: Stage) -> None:
    with _demo(stage, "ackermann_drive") as launch:
        launch.wait_for_topics("/demo/distance_demo", "/demo/steerangle_demo")
        launch.drive("/demo/cmd_demo", 2.0, 0.5, 5.0)
        assert launch.topic("/demo/distance_demo").next().data > 0.5
        assert math.isfinite(launch.topic("/demo/steerangle_demo").next().data)


def test_one_ray_sensor_publishes_four_kinds_of_messages(stage: Stage) -> None:
    kinds = {
        "pointcloud2": "PointCloud2",
        "pointcloud": "PointCloud",
        "laserscan": "LaserScan",
        "range": "Range",
    }
    with _demo(stage, "ray_sensor") as launch:
        for space in ("ray", "gpu_ray"):
            for topic, kind in kinds.items():
                heard = launch.topic(f"/{space}/{topic}")
                assert heard.type_name == f"sensor_msgs/msg/{kind}"
                heard.next()
                heard.close()
            launch.has_rate(f"/{space}/laserscan", 1.0)
        cloud = launch.topic("/ray/pointcloud2").next()
        scan = launch.topic("/ray/laserscan").next()
        assert len(scan.ranges) == 300
        # Dense: rays that meet nothing have no point.
        assert 0 < cloud.width <= 300 * 100 and cloud.height == 1


def test_a_namespace_without_slash_is_at_the_root(stage: Stage) -> None:
    with _demo(stage, "camera") as launch:
        # The remapping names /demo_cam/image_raw, which is not the camera's topic.
        names = ("/demo_cam/camera1/image_raw", "/demo_cam/camera1/camera_info")
        launch.wait_for_topics(*names)
        launch.topic(names[0]).next()
