"""articubot_one, the robot of a well-known series of tutorials (Humble, Gazebo Classic)."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from stage import Stage, roll_pitch_rad

SIMULATION = "ros2 launch articubot_one launch_sim.launch.py"


def test_the_robot_has_ten_links_and_0_71_kg(stage: Stage) -> None:
    done = stage.run("xacro ws/src/articubot_one/description/robot.urdf.xacro")
    assert done.code == 0, done.output
    robot = ET.fromstring(done.stdout)
    assert len(robot.findall("link")) == 10
    assert sum(float(one.get("value", "")) for one in robot.iter("mass")) == pytest.approx(
        0.71, abs=0.01
    )
    joints = {one.get("name") for one in robot.findall("joint")}
    assert {"left_wheel_joint", "right_wheel_joint"} <= joints


def test_the_simulation_drives_senses_and_maps(stage: Stage) -> None:
    with stage.launch(SIMULATION) as robot:
        robot.wait_for_controllers("diff_cont", "joint_broad")
        # Two <parameters> files in one plug-in: the second has only this.
        assert (
            robot.call("/controller_manager/get_parameters", names=["use_sim_time", "update_rate"])
            .values[0]
            .bool_value
        )
        robot.has_rate("/diff_cont/odom", 30.0)
        robot.has_rate("/scan", 10.0)
        robot.camera_has_rate("/camera/image_raw", 10.0)
        scan = robot.topic("/scan").next()
        assert len(scan.ranges) == 360
        assert scan.header.frame_id == "laser_frame"
        assert robot.topic("/camera/image_raw").next().header.frame_id == "camera_link_optical"
        # publish_rate 400 of the node 'gazebo'; a step is 1 ms, so that 2 or 3 steps are between.
        assert "400" in stage.run("ros2 param get /gazebo publish_rate").output
        odom = robot.topic("/diff_cont/odom").next()
        assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_link")
        robot.drive("/cmd_vel", 0.2, 0.0, 4.0)
        odom = robot.topic("/diff_cont/odom").next()
        assert odom.twist.twist.linear.x == pytest.approx(0.2, abs=0.04)
        assert odom.pose.pose.position.x > 0.3
        # A joystick has more say than navigation.
        begun_s = robot.sim_time_s
        while robot.sim_time_s < begun_s + 2.0:
            robot.publish("/cmd_vel", linear={"x": 0.2})
            robot.publish("/cmd_vel_joy", linear={"x": -0.2})
            robot.wait_until(robot.sim_time_s + 0.1)
        back = robot.topic("/diff_cont/odom").next()
        assert back.twist.twist.linear.x == pytest.approx(-0.2, abs=0.04)


def test_it_stands_upright_on_its_caster_among_obstacles_and_is_mapped(stage: Stage) -> None:
    world = "world:=./ws/src/articubot_one/worlds/obstacles.world"
    with stage.launch(f"{SIMULATION} {world}") as robot:
        robot.wait_for_controllers("diff_cont", "joint_broad")
        robot.run_sim(3.0)
        x, y, _z, roll, pitch, _yaw = stage.place("my_bot")
        assert abs(roll) < 0.05
        assert abs(pitch) < 0.05
        assert abs(x) < 0.2
        assert abs(y) < 0.2
        near = [one for one in robot.topic("/scan").next().ranges if one < 12.0]
        assert near, "it sees none of the obstacles"
        slam = "ros2 launch articubot_one online_async_launch.py use_sim_time:=true"
        with stage.launch(slam) as mapping:
            # SLAM is compiled once on a machine.
            grid = mapping.topic("/map", "nav_msgs/msg/OccupancyGrid").next(240.0)
            assert grid.info.resolution == pytest.approx(0.05)
            assert {-1, 0, 100} >= {one if one < 0 else 100 * (one > 50) for one in grid.data}
            assert grid.header.frame_id == "map"
            told = stage.run("ros2 param get /slam_toolbox scan_topic")
            assert "/scan" in told.output, told.output


def test_without_ros2_control_the_plugin_of_gazebo_drives(stage: Stage) -> None:
    state = "ros2 launch articubot_one rsp.launch.py use_sim_time:=true use_ros2_control:=false"
    with (
        stage.launch("ros2 launch gazebo_ros gazebo.launch.py gui:=false") as world,
        stage.launch(state),
    ):
        spawned = stage.run(
            "ros2 run gazebo_ros spawn_entity.py -topic robot_description -entity my_bot"
        )
        assert spawned.code == 0, spawned.output
        world.wait_for_topics("/odom", "/cmd_vel")
        world.drive("/cmd_vel", 0.2, 0.0, 4.0)
        odom = world.topic("/odom").next()
        assert odom.pose.pose.position.x > 0.3
        roll, pitch = roll_pitch_rad(odom.pose.pose.orientation)
        assert abs(roll) < 0.05
        assert abs(pitch) < 0.05


@pytest.mark.parametrize("name", ["spawner", "spawner.py"])
def test_the_spawner_has_both_names(stage: Stage, name: str) -> None:
    done = stage.run(f"ros2 run controller_manager {name} --help")
    assert done.code == 0, done.output
    assert "--controller-manager" in done.output
