"""The tests that gazebo_plugins itself brings for ROS 1: two robots, tricycles, old worlds."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from stage import Seen, Stage, roll_pitch_rad

TEST = "ws/src/gazebo_plugins/test"
PIONEER = f"{TEST}/multi_robot_scenario/xacro/p3dx/pioneer3dx.xacro"
TRICYCLE = f"{TEST}/tricycle_drive/xacro/tricycle/tricycle.xacro"
JOINTS = {"chassis_swivel_joint", "swivel_wheel_joint", "left_hub_joint", "right_hub_joint"}


def _upright(launch: Seen, model: str) -> None:
    roll, pitch = roll_pitch_rad(launch.true_pose(model).orientation)
    assert max(abs(roll), abs(pitch)) < math.radians(3.0)


def test_the_pioneer_and_the_tricycle_have_their_links(stage: Stage) -> None:
    pioneer = stage.robot(PIONEER)
    assert len(pioneer.links) == 14
    assert pioneer.mass_kg == pytest.approx(13.73, abs=0.005)
    tricycle = stage.robot(TRICYCLE)
    assert len(tricycle.links) == 6
    assert tricycle.mass_kg == pytest.approx(104.0, abs=0.05)


def test_two_robots_stand_apart_and_obey_their_own_commands(stage: Stage) -> None:
    with stage.launch("roslaunch gazebo_plugins multi_robot_scenario.launch") as launch:
        launch.topic("/r1/odom").next()
        launch.topic("/r2/odom").next()
        launch.run_sim(3.0)
        starts = {name: launch.true_pose(name).position for name in ("r1", "r2")}
        assert starts["r1"].y == pytest.approx(-0.5, abs=0.05)
        assert starts["r2"].y == pytest.approx(0.5, abs=0.05)
        for name in starts:
            _upright(launch, name)
            launch.has_rate(f"/{name}/odom", 10.0)
        launch.has_rate("/r1/front_laser/scan", 30.0)
        states = launch.topic("/r1/joint_states")
        launch.run_sim(3.0)
        # The drive publishes its two wheels on the same topic.
        whole = [one for one in states.messages(40) if set(one.name) == JOINTS]
        stamps = [one.header.stamp.sec + one.header.stamp.nanosec * 1e-9 for one in whole]
        rate_hz = (len(stamps) - 1) / (stamps[-1] - stamps[0])
        assert rate_hz == pytest.approx(10.0, rel=0.1)
        frames = launch.frames()
        assert frames["r1/base_link"] == "r1/odom"
        assert frames["r2/base_link"] == "r2/odom"
        launch.drive("/r1/cmd_vel", -0.3, 0.0, 3.0)
        moved = {
            name: math.hypot(
                launch.true_pose(name).position.x - start.x,
                launch.true_pose(name).position.y - start.y,
            )
            for name, start in starts.items()
        }
        assert moved["r1"] > 0.5
        assert moved["r2"] < 0.02
        _upright(launch, "r1")


def test_the_tricycle_steers_and_accelerates_within_its_limit(stage: Stage) -> None:
    with stage.launch("roslaunch gazebo_plugins tricycle_drive_scenario.launch") as launch:
        launch.topic("/r1/odom").next()
        # The prefix is a parameter of the state publisher alone, which the plug-in does not see.
        assert launch.frames()["base_link"] == "odom"
        odom = launch.topic("/r1/odom")
        launch.drive("/r1/cmd_vel", 0.5, 0.3, 4.0)
        steer = launch.topic("/r1/joint_states").wait_for(
            lambda one: "front_steering_joint" in one.name
        )
        assert abs(steer.position[steer.name.index("front_steering_joint")]) > 0.1
        heard = odom.messages(40)
        speeds = [
            (
                one.header.stamp.sec + one.header.stamp.nanosec * 1e-9,
                math.hypot(one.twist.twist.linear.x, one.twist.twist.linear.y),
            )
            for one in heard
        ]
        assert max(speed for _, speed in speeds) > 0.1
        for (before_s, slow), (after_s, fast) in pairwise(speeds):
            assert abs(fast - slow) <= 1.8 * (after_s - before_s) * 1.2 + 0.02


def test_a_laser_of_an_sdf_1_3_world_publishes_beside_a_plugin_in_cpp(stage: Stage) -> None:
    with stage.launch(
        f"rosrun gazebo_ros gzserver {TEST}/test_worlds/gazebo_ros_laser.world"
    ) as one:
        assert len(one.topic("/base_scan").next().ranges) > 0
        assert (
            len(one.said(r"warning:.*libmove_model_test\.so|libmove_model_test\.so.*warning")) == 1
        )


@pytest.mark.parametrize(
    "world", ["bumper_test/gazebo_ros_bumper.world", "test_worlds/bumper_test.world"]
)
def test_bumpers_of_old_worlds_publish_and_say_what_they_do_not_feel(
    stage: Stage, world: str
) -> None:
    topic = "/test_bumper" if "ros_bumper" in world else "/box_bumper"
    with stage.launch(f"rosrun gazebo_ros gzserver {TEST}/{world}") as launch:
        # <collision name="…"/> of SDF 1.0 has no rule in sdformat's 1_0.convert: it becomes
        # __default__, which is no collision, in Gazebo too.
        launch.says("names no collision: it never feels anything")
        launch.says("fix: write <collision>(collision_box|my_box_geom)</collision>")
        launch.topic(topic).next()


def test_the_pose_of_a_pendulum_of_an_sdf_1_0_world_is_published(stage: Stage) -> None:
    world = f"{TEST}/p3d_test/worlds/single_pendulum.world"
    with stage.launch(f"rosrun gazebo_ros gzserver {world}") as launch:
        assert launch.topic("/model_1/link_1/pose").next().header.frame_id == "world"
