"""TurtleBot3 of the main branch: gz sim and ros_gz_bridge."""

from __future__ import annotations

import pytest
from stage import Seen, Stage

ENVIRONMENT = {"TURTLEBOT3_MODEL": "burger"}
HOUSE = "ros2 launch turtlebot3_gazebo turtlebot3_house.launch.py"
EMPTY = "ros2 launch turtlebot3_gazebo empty_world.launch.py"


def see(world: Seen) -> None:
    world.wait_for_topics("/clock", "/joint_states", "/odom", "/tf", "/cmd_vel", "/imu", "/scan")
    # The tag <odom_publisher_frequency> is not gz-sim's: its default of 50 Hz holds.
    world.has_rate("/odom", 50.0)
    world.has_rate("/scan", 5.0)
    world.has_rate("/imu", 200.0)
    scan = world.topic("/scan").next()
    assert len(scan.ranges) == 360
    assert scan.header.frame_id == "base_scan"
    assert any(
        one.child_frame_id.endswith("base_footprint") and one.header.frame_id.endswith("odom")
        for message in world.topic("/tf").messages(20)
        for one in message.transforms
    )


def test_the_empty_world_has_ground_and_sun_offline(stage: Stage) -> None:
    with stage.launch(EMPTY) as world:
        see(world)
        world.run_sim(3.0)
        assert stage.place("burger")[2] > -0.01
        world.drive("/cmd_vel", 0.1, 0.0, 2.0, stamped=True)
        assert world.topic("/odom").next().twist.twist.linear.x == pytest.approx(0.1, abs=0.02)


def test_both_kinds_of_twist_drive_it_and_the_bridge_names_its_own(stage: Stage) -> None:
    # The original takes only what the bridge names; here drives take both, as docs/plugins.md says.
    with stage.launch(EMPTY) as world:
        world.says(r"/cmd_vel \(geometry_msgs/msg/TwistStamped\) -> /cmd_vel \(gz.msgs.Twist\)")
        world.drive("/cmd_vel", 0.1, 0.0, 2.0)
        assert world.topic("/odom").next().twist.twist.linear.x == pytest.approx(0.1, abs=0.02)


def test_the_house_is_found_and_loaded(stage: Stage) -> None:
    with stage.launch(HOUSE) as world:
        see(world)
        assert stage.place("burger")[2] > -0.01
        # Walls of the house are near the robot.
        assert any(one < 3.5 for one in world.topic("/scan").next().ranges)
        missing = world.said("not found")
        assert all("burger_base.stl" in line for line in missing), missing
