"""TurtleBot3 of Humble: Gazebo Classic, Nav2, Cartographer."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import pytest
from stage import Stage

ENVIRONMENT = {"TURTLEBOT3_MODEL": "waffle_pi", "ROS_DISTRO": "humble"}
WORLD = "ros2 launch turtlebot3_gazebo turtlebot3_world.launch.py"
NAVIGATION = "ros2 launch turtlebot3_navigation2 navigation2.launch.py use_sim_time:=True"
MAPPING = "ros2 launch turtlebot3_cartographer cartographer.launch.py use_sim_time:=True"
MODELS = "ws/src/turtlebot3_simulations/turtlebot3_gazebo/models"


def transform(stage: Stage, parent: str, child: str) -> str:
    return stage.run(f"ros2 run tf2_ros tf2_echo {parent} {child}", timeout_s=12.0).output


def test_the_model_has_ten_links(stage: Stage) -> None:
    model = ET.parse(stage.folder / MODELS / "turtlebot3_waffle_pi/model.sdf")
    assert len(model.getroot().findall("model/link")) == 10
    printed = stage.run(f"gz sdf -p {MODELS}/turtlebot3_waffle_pi/model.sdf")
    assert printed.code == 0, printed.output
    assert len(ET.fromstring(printed.stdout).findall("model/link")) == 10


def test_the_robot_stands_and_senses_in_its_world(stage: Stage) -> None:
    with stage.launch(WORLD) as world:
        world.wait_for_topics("/scan", "/imu", "/odom", "/joint_states", "/camera/image_raw")
        odom = world.topic("/odom").next()
        assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_footprint")
        x, y, z, *_ = stage.place("waffle_pi")
        assert (x, y) == pytest.approx((-2.0, -0.5), abs=0.02)
        assert abs(z) < 0.05
        scan = world.topic("/scan").next()
        assert len(scan.ranges) == 360
        assert scan.header.frame_id == "base_scan"
        world.has_rate("/scan", 5.0)
        world.has_rate("/imu", 200.0)
        world.has_rate("/odom", 30.0)
        world.has_rate("/joint_states", 30.0)
        world.camera_has_rate("/camera/image_raw", 30.0)
        # frame_prefix is '/': tf2 knows no leading slash.
        assert "Translation" in transform(stage, "odom", "base_link")
        frames = set()
        for topic in ("/tf", "/tf_static"):
            for one in world.topic(topic).messages(1):
                frames |= {each.child_frame_id for each in one.transforms}
        assert not [name for name in frames if "${" in name], frames
        assert len(world.said("warning: .*waffle_pi_base.stl' not found")) == 1, world.output
        world.publish("/cmd_vel", linear={"x": 0.1})
        moved = world.topic("/odom").wait_for(lambda m: m.twist.twist.linear.x > 0.08)
        assert moved.twist.twist.linear.x == pytest.approx(0.1, abs=0.02)


def test_the_namespace_of_the_description_does_not_show_in_frames(stage: Stage) -> None:
    # The file uses an argument that only robot.launch.py declares.
    command = (
        "ros2 launch turtlebot3_bringup turtlebot3_state_publisher.launch.py \"namespace:=''\""
    )
    with stage.launch(command) as state:
        frames = {one.child_frame_id for one in state.topic("/tf_static").next().transforms}
        assert frames
        assert not [name for name in frames if "$" in name], frames


def test_without_a_model_the_error_names_the_variable(stage: Stage) -> None:
    del stage.environment["TURTLEBOT3_MODEL"]
    for command in (WORLD, NAVIGATION):
        done = stage.run(command, timeout_s=30.0)
        assert done.code != 0
        assert "KeyError: 'TURTLEBOT3_MODEL'" in done.output, done.output
        assert "  File " not in done.output


def test_navigation_reaches_its_goal_within_the_speed_of_the_robot(stage: Stage) -> None:
    with stage.launch(WORLD) as world, stage.launch(NAVIGATION) as nav:
        grid = nav.topic("/map", "nav_msgs/msg/OccupancyGrid").next()
        assert (grid.info.width, grid.info.height) == (384, 384)
        assert grid.info.resolution == pytest.approx(0.05)
        assert (grid.info.origin.position.x, grid.info.origin.position.y) == (-10.0, -10.0)
        world.wait_until(5.0)
        nav.wait_for_node("/bt_navigator")
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = 0.25
        covariance[35] = 0.07
        nav.publish(
            "/initialpose",
            header={"frame_id": "map"},
            pose={
                "pose": {"position": {"x": -2.0, "y": -0.5}, "orientation": {"w": 1.0}},
                "covariance": covariance,
            },
        )
        nav.says("Managed nodes are active")
        nav.topic("/amcl_pose").next(60.0)
        nav.says(r"lifecycle_manager_navigation.*Managed nodes are active", 120.0)
        # 1.0 stands in param/humble alone. That file's plug-ins of 'recoveries_server', with their
        # old names, are for a node that Humble's bring-up does not have.
        assert "1.0" in stage.run("ros2 param get /amcl transform_tolerance").output
        driven: list[float] = []
        world.node.create_subscription(
            "/cmd_vel", "geometry_msgs/msg/Twist", lambda one: driven.append(one.linear.x)
        )
        begun_s = world.sim_time_s
        sent = stage.run(
            "ros2 action send_goal /navigate_to_pose nav2_msgs/action/NavigateToPose "
            '"{pose: {header: {frame_id: map}, pose: '
            '{position: {x: 0.5, y: -0.5}, orientation: {w: 1.0}}}}"',
            timeout_s=400.0,
        )
        took_s = world.sim_time_s - begun_s
        assert "SUCCEEDED" in sent.output, sent.output
        assert took_s < 120.0
        assert 0.1 < max(driven) <= 0.22 + 1e-6
        x, y, *_ = stage.place("waffle_pi")
        assert math.hypot(x - 0.5, y + 0.5) < 0.35


def test_cartographer_maps_by_the_packages_lua(stage: Stage) -> None:
    with stage.launch(WORLD), stage.launch(MAPPING) as mapping:
        mapping.wait_for_node("/cartographer_node")
        grid = mapping.topic("/map", "nav_msgs/msg/OccupancyGrid").wait_for(
            lambda m: any(one > 60 for one in m.data)
        )
        assert grid.info.resolution == pytest.approx(0.05)
        assert "Translation" in transform(stage, "map", "odom")
