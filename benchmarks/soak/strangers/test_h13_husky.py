"""Husky in its playpen: sensors, filter and twist_mux, move_base with and without a map (ROS 1)."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

import pytest
from stage import Stage, roll_pitch_rad, staged

ENVIRONMENT = {"HUSKY_LMS1XX_ENABLED": "1"}
URDF = "ws/src/husky/husky_description/urdf/husky.urdf.xacro"
PLAYPEN = "roslaunch husky_gazebo husky_playpen.launch"
# A barrier stands across (3, 0), with its inflation from 1.3 m on.
GOAL = (0.0, 3.0)
# realsense2_description is included only where a RealSense is asked for.
SENSORS = (
    "lms1xx",
    "velodyne_description",
    "flir_camera_description",
    "fath_pivot_mount_description",
)


def test_the_laser_is_there_by_its_environment_variable(stage: Stage) -> None:
    with_laser = stage.robot(URDF)
    assert len(with_laser.links) == 17
    assert with_laser.mass_kg == pytest.approx(57.68, abs=0.005)
    without = stage.robot(URDF, env={"HUSKY_LMS1XX_ENABLED": "0"})
    assert len(without.links) == 15
    assert not any("laser" in link for link in without.links)


@pytest.mark.parametrize("package", SENSORS)
def test_a_sensors_package_that_is_missing_is_named(
    folder: Path, tmp_path: Path, package: str
) -> None:
    source = tmp_path / "ws/src"
    source.mkdir(parents=True)
    for one in (folder / "ws/src").iterdir():
        if one.name != package:
            shutil.copytree(one, source / one.name, ignore=shutil.ignore_patterns("meshes"))
    with staged(tmp_path, ENVIRONMENT) as stage:
        done = stage.run(f"xacro {URDF}")
        told = [line for line in done.output.splitlines() if f"'{package}' not found" in line]
        assert len(told) == 1, done.output
        # The laser's macro is used, those of the others are not.
        assert (done.code != 0) == (package == "lms1xx")


def test_the_playpen_brings_all_sensors_and_the_filter(stage: Stage) -> None:
    with stage.launch(PLAYPEN) as launch:
        launch.run_sim(5.0)
        pose = launch.true_pose("husky")
        roll, pitch = roll_pitch_rad(pose.orientation)
        assert max(abs(roll), abs(pitch)) < math.radians(3.0)
        assert abs(pose.position.z) < 0.2
        heard = launch.topic("/gazebo/model_states")
        states = heard.next()
        heard.close()
        assert len(states.name) == 36 + 1
        physics = launch.call("/gazebo/get_physics_properties")
        assert physics.time_step == pytest.approx(0.01)
        scan = launch.topic("/front/scan").next()
        assert len(scan.ranges) == 720
        assert len(launch.joints()) == 4
        for topic, hz in {
            "/front/scan": 50.0,
            "/joint_states": 50.0,
            "/husky_velocity_controller/odom": 50.0,
            "/odometry/filtered": 50.0,
            "/imu/data": 50.0,
            "/navsat/fix": 40.0,
        }.items():
            launch.has_rate(topic, hz)
        assert launch.frames()["base_link"] == "odom"
        senders = {one.node for one in launch.graph.publishers_info("/tf")}
        assert "/ekf_localization" in senders
        assert not launch.said("joy_node.*has died")
        for _ in range(30):
            launch.publish("/cmd_vel", linear={"x": 5.0})
            launch.run_sim(0.1)
        odom = launch.topic("/husky_velocity_controller/odom").next()
        assert odom.twist.twist.linear.x == pytest.approx(1.0, abs=0.05)


def test_without_the_laser_there_is_no_scan(stage: Stage) -> None:
    with stage.launch(PLAYPEN, env={"HUSKY_LMS1XX_ENABLED": "0"}) as launch:
        launch.wait_for_topics("/odometry/filtered", "/imu/data")
        launch.run_sim(2.0)
        assert "/front/scan" not in launch.topics()


def test_move_base_reaches_a_goal_without_a_map(stage: Stage) -> None:
    mapless = "roslaunch husky_navigation move_base_mapless_demo.launch"
    with stage.launch(PLAYPEN) as playpen:
        playpen.topic("/odometry/filtered").next()
        with stage.launch(mapless) as launch:
            launch.topic("/move_base/global_costmap/costmap").next()
            goal = {"position": {"x": GOAL[0], "y": GOAL[1]}, "orientation": {"w": 1.0}}
            speeds: list[float] = []
            launch.node.create_subscription(
                "/odometry/filtered", "nav_msgs/msg/Odometry",
                lambda one: speeds.append(one.twist.twist.linear.x),
            )  # fmt: skip
            launch.publish("/move_base_simple/goal", header={"frame_id": "odom"}, pose=goal)
            status = launch.topic("/move_base/result").next(timeout_s=300.0)
            assert status.status.status == 3, status
            odom = launch.topic("/odometry/filtered")
            at = odom.next().pose.pose.position
            assert math.hypot(at.x - GOAL[0], at.y - GOAL[1]) <= 0.2
            assert max(speeds) <= 0.5 * 1.01


def test_amcl_has_the_map_of_the_playpen(stage: Stage) -> None:
    with stage.launch(PLAYPEN) as playpen:
        playpen.topic("/odometry/filtered").next()
        with stage.launch("roslaunch husky_navigation amcl_demo.launch") as launch:
            grid = launch.topic("/map").next()
            assert (grid.info.width, grid.info.height) == (1984, 1984)
            assert grid.info.resolution == pytest.approx(0.05)
            origin = grid.info.origin.position
            assert (origin.x, origin.y) == pytest.approx((-50.0, -50.0))
            assert launch.topic("/amcl_pose").next().header.frame_id == "map"
            assert launch.frames(2.0)["odom"] == "map"
