"""xbot-u of a beginners' course: Kinetic's names, no walls, and small Python demos (ROS 1)."""

from __future__ import annotations

import re

import pytest
from stage import Seen, Stage, yaw_rad

SPAWN = "roslaunch robot_sim_demo robot_spawn.launch"
GMAPPING = "roslaunch slam_sim_demo gmapping_demo.launch"
AMCL = "roslaunch navigation_sim_demo amcl_demo.launch"
ROBOT = "ws/src/ROS-Academy-for-Beginners/robot_sim_demo/urdf/robot.xacro"
YAW = "/xbot/yaw_platform_position_controller/command"


def _once(launch: Seen, pattern: str) -> str:
    found = launch.said(pattern)
    assert len(found) == 1, found
    return found[0]


def test_the_robot_has_eleven_links_on_base_footprint(stage: Stage) -> None:
    robot = stage.robot(ROBOT)
    assert len(robot.links) == 11
    assert robot.mass_kg == pytest.approx(43.86, abs=0.005)
    assert robot.root == "base_footprint"
    assert 'name="sick_tim"' in stage.run(f"xacro {ROBOT}").stdout


def test_the_world_without_its_museum_runs_the_robot_its_sensors_and_controllers(
    stage: Stage,
) -> None:
    with stage.launch(SPAWN) as launch:
        launch.run_sim(3.0)
        pose = launch.true_pose("xbot-u")
        assert (pose.position.x, pose.position.y) == pytest.approx((5.0, 0.0), abs=0.05)
        assert abs(pose.position.z) < 0.05
        assert yaw_rad(pose.orientation) == pytest.approx(-2.0, abs=0.05)
        _once(launch, r"warning: 'model://ISCAS_Museum/meshes/ISCAS_museum\.dae'")
        _once(launch, r"yocs_cmd_vel_mux/CmdVelMuxNodelet(?!.*mobile_base_nodelet_manager$)")
        launch.has_rate("/odom", 50.0)
        launch.has_rate("/scan", 15.0)
        launch.has_rate("/imu", 10.0)
        launch.has_rate("/xbot/joint_states", 50.0)
        stage.run(f'rostopic pub -1 {YAW} std_msgs/Float64 "data: 0.5"')
        launch.run_sim(4.0)
        joints = launch.joints("/xbot/joint_states")
        assert joints["base_to_yaw_platform"] == pytest.approx(0.5, abs=0.05)


def test_the_doctor_tells_hardware_interfaces_without_their_package(stage: Stage) -> None:
    # They work, so a launch says nothing of them.
    told = stage.run("doctor robot_sim_demo robot_spawn.launch")
    assert "Deprecated syntax, please prepend 'hardware_interface/'" in told.output


def test_gmapping_and_move_base_run_where_nothing_is_seen(stage: Stage) -> None:
    with stage.launch(SPAWN) as robot, stage.launch(GMAPPING) as slam:
        grid = slam.topic("/map").next()
        assert grid.info.resolution == pytest.approx(0.05)
        frames = slam.frames(3.0)
        assert frames["odom"] == "map"
        assert frames["base_footprint"] == "odom"
        slam.wait_for_topics("/move_base/global_costmap/costmap")
        assert not slam.said("no transform from base_footprint to map")
        robot.run_sim(3.0)
        assert slam.exit_code is None


def test_amcl_localises_on_the_museums_map_at_the_initial_pose(stage: Stage) -> None:
    with stage.launch(SPAWN), stage.launch(AMCL) as amcl:
        grid = amcl.topic("/map").next()
        assert (grid.info.width, grid.info.height) == (992, 992)
        assert grid.info.resolution == pytest.approx(0.05)
        origin = grid.info.origin.position
        assert (origin.x, origin.y) == pytest.approx((-25.0, -25.0))
        pose = amcl.topic("/amcl_pose").next().pose.pose
        assert (pose.position.x, pose.position.y) == pytest.approx((5.0, 0.0), abs=0.3)
        assert yaw_rad(pose.orientation) == pytest.approx(-2.0, abs=0.3)
        assert amcl.frames(2.0)["odom"] == "map"


def test_talker_and_listener_exchange_the_packages_own_message(stage: Stage) -> None:
    shown = stage.run("rosmsg show topic_demo/gps")
    assert shown.stdout.split("\n")[:3] == ["string state", "float32 x", "float32 y"]
    with (
        stage.launch("rosrun topic_demo pytalker.py") as talker,
        stage.launch("rosrun topic_demo pylistener.py") as listener,
    ):
        talker.says(r"Talker: GPS: x=1\.0\d+ ,y= 2\.0")
        heard = listener.says(r"Listener: GPS: distance=")
        assert re.search(r"distance=2\.\d+, state=working", heard)


def test_the_service_of_the_packages_own_type_answers(stage: Stage) -> None:
    with stage.launch("rosrun service_demo server_demo.py") as server:
        server.says("Ready to handle the request")
        done = stage.run("rosrun service_demo client_demo.py")
        assert done.code == 0, done.output
        assert "Message From server:Hi HAN. I' server!" in done.output
        server.says("Request from HAN with age 20")


def test_parameters_of_the_launch_reach_the_python_node(stage: Stage) -> None:
    with stage.launch("roslaunch param_demo param_demo_py.launch") as launch:
        launch.says("Get param1 = 1")
        launch.says("Get param2 = 2")
        launch.says("/param3 exists")
        assert [launch.param(f"/param{number}") for number in (3, 4, 5)] == [3, 4, 5]


@pytest.mark.parametrize("words", ["topic_demo talker", "service_demo server"])
def test_a_node_in_cpp_is_named_and_not_run(stage: Stage, words: str) -> None:
    package, node = words.split()
    done = stage.run(f"rosrun {words}")
    assert done.code != 0
    told = [line for line in done.output.splitlines() if node in line and package in line]
    assert len(told) == 1, done.output
    assert "compiled code" in told[0]


def test_a_launch_of_a_node_in_cpp_names_it(stage: Stage) -> None:
    with stage.launch("roslaunch param_demo param_demo_cpp.launch") as launch:
        told = launch.says("param_demo.*compiled code")
        assert "in package [param_demo]" in told
        assert launch.param("/param1") == 1
