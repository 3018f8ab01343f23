"""Thirty more public packages, each started by the command of its README.

Of each: it comes up, its topics carry messages, its controllers run, its own compiled code is named
once, and Ctrl-C ends all of it. `lay_out.py` lays the packages out.
"""

from __future__ import annotations

import math
import os
import re
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import pytest
from stage import Seen, Stage, staged


class Row(NamedTuple):
    """What must be seen of a package.

    Attributes:
        command: of its README.
        topics: those that carry messages; with how often a second of simulated time, or None.
        running: controllers of ROS 1.
        active: controllers of ROS 2.
        manager: of the controllers.
        nodes: that are there.
        says: lines of the output, as patterns.
        named: one pattern a piece of compiled code that must be named by one line.
        environment: what the README has one set.
        workspace: where the README puts the workspace, below the home folder.
        drives: a topic of commands that moves the robot, and one of odometry that tells.
        first: a command that is given as soon as the nodes are there.
        has_clock: it simulates.
        traceback: its own code is known to end with one.
    """

    command: str
    topics: Mapping[str, float | None] = {}
    running: tuple[str, ...] = ()
    active: tuple[str, ...] = ()
    manager: str = "/controller_manager"
    nodes: tuple[str, ...] = ()
    says: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    environment: Mapping[str, str] = {}
    workspace: str = ""
    drives: tuple[str, str] | None = None
    first: str = ""
    has_clock: bool = True
    traceback: bool = False


def _compiled(name: str) -> str:
    """Return the pattern of the line that names a node of compiled code."""
    return rf"(error|warning): .*\b{re.escape(name)}\b.*compiled code"


def _plugin(name: str) -> str:
    return rf"(error|warning): .*'?{re.escape(name)}'?.*compiled code"


ROWS = {
    "M01": Row(
        "roslaunch stretch_gazebo gazebo.launch rviz:=true",
        {
            "/joint_states": 50.0, "/stretch_diff_drive_controller/odom": 50.0, "/scan": None,
            "/imu/data": 25.0, "/wrist_imu/data": 25.0, "/ground_truth": None,
        },
        running=(
            "stretch_joint_state_controller", "stretch_diff_drive_controller",
            "stretch_arm_controller", "stretch_head_controller", "stretch_gripper_controller",
        ),
        named=(_plugin("librealsense_gazebo_plugin.so"),),
        drives=("/stretch_diff_drive_controller/cmd_vel", "/stretch_diff_drive_controller/odom"),
    ),
    "M02": Row(
        "roslaunch fetch_gazebo simulation.launch",
        {"/base_scan": None, "/head_camera/rgb/image_raw": None},
        nodes=("/robot_state_publisher", "/cmd_vel_mux"),
        named=(_plugin("libfetch_gazebo_plugin.so"),),
    ),
    "M03": Row(
        "roslaunch kuka_kr210_support test_kr210l150.launch",
        {"/joint_states": None},
        nodes=("/joint_state_publisher", "/robot_state_publisher"),
        has_clock=False,
    ),
    "M04": Row(
        "roslaunch abb_irb6640_moveit_config demo.launch",
        {"/joint_states": None},
        nodes=("/move_group", "/robot_state_publisher"),
        says=("You can start planning now!",),
        has_clock=False,
    ),
    "M05": Row(
        "roslaunch xarm_gazebo xarm7_beside_table.launch",
        {"/xarm/joint_states": 50.0},
        running=("joint_state_controller", "xarm7_traj_controller"),
        manager="/xarm/controller_manager",
    ),
    "M06": Row(
        "roslaunch niryo_robot_bringup desktop_gazebo_simulation.launch",
        nodes=("/robot_state_publisher", "/niryo_robot_arm_commander"),
        named=(_compiled("niryo_robot_hardware_interface_node"),),
        # Its camera node wants cv2, and one of its nodes a parameter that no launch file sets.
        traceback=True,
    ),
    "M07": Row(
        "roslaunch mir_gazebo mir_maze_world.launch",
        {"/scan": None, "/b_scan": None, "/f_scan": None, "/odom": 41.2, "/joint_states": None},
        running=("joint_state_controller", "mobile_base_controller"),
        drives=("/cmd_vel", "/odom"),
        says=("Started controllers",),
        first="rosservice call /gazebo/unpause_physics",
    ),
    "M08": Row(
        "roslaunch leo_gazebo leo_gazebo.launch",
        {"/joint_states": None, "/camera/image_raw": None},
        named=(_plugin("libleo_gazebo_differential_plugin.so"),),
    ),
    "M09": Row(
        "roslaunch racecar_gazebo racecar.launch",
        {"/scan": None, "/racecar/joint_states": 50.0, "/vesc/odom": None},
        running=(
            "joint_state_controller", "left_rear_wheel_velocity_controller",
            "right_steering_hinge_position_controller",
        ),
        manager="/racecar/controller_manager",
    ),
    "M10": Row(
        "roslaunch hector_quadrotor_gazebo quadrotor_empty_world.launch",
        {
            "/ground_truth/state": 100.0, "/raw_imu": 100.0, "/sonar_height": 10.0, "/fix": None,
            "/pressure_height": 10.0, "/magnetic": 10.0,
        },
        named=(
            _plugin("libhector_gazebo_quadrotor_propulsion.so"),
            _plugin("libhector_gazebo_quadrotor_aerodynamics.so"),
            _compiled("pose_action"), _compiled("landing_action"), _compiled("takeoff_action"),
            "Could not load class 'hector_quadrotor_controllers/PositionController'",
        ),
        says=("package 'message_to_tf' not found",),
    ),
    "M11": Row(
        "roslaunch aws_robomaker_hospital_world view_hospital.launch", {"/clock": None},
    ),
    "M12": Row(
        "roslaunch ridgeback_gazebo ridgeback_world.launch",
        {"/front/scan": None, "/imu/data": None, "/joint_states": None},
        named=(_plugin("libridgeback_ros_force_based_move.so"),),
    ),
    "M13": Row(
        "roslaunch diff_wheeled_robot_gazebo diff_wheeled_gazebo_full.launch",
        {"/scan": None, "/odom": 100.0, "/joint_states": 10.0},
        drives=("/cmd_vel", "/odom"),
    ),
    "M14": Row(
        "roslaunch scout_gazebo_sim scout_empty_world.launch", {"/joint_states": None},
        named=(_compiled("scout_skid_steer_controller"),),
    ),
    "M15": Row(
        "roslaunch turtlesim multisim.launch",
        {"/turtlesim1/turtle1/pose": None, "/turtlesim2/turtle1/pose": None},
        has_clock=False,
    ),
    "M16": Row(
        "roslaunch kortex_gazebo spawn_kortex_robot.launch",
        {"/my_gen3/joint_states": 50.0, "/my_gen3/gen3_joint_trajectory_controller/state": 25.0},
        running=("joint_state_controller", "gen3_joint_trajectory_controller"),
        manager="/my_gen3/controller_manager",
        nodes=("/my_gen3/move_group", "/my_gen3/home_the_arm"),
        named=(_compiled("kortex_arm_driver"),),
    ),
    "M17": Row(
        "ros2 launch xarm_moveit_config xarm6_moveit_fake.launch.py",
        nodes=("/move_group",),
        says=("You can start planning now!",),
        has_clock=False,
    ),
    "M18": Row(
        "ros2 launch open_manipulator_bringup open_manipulator_x_gazebo.launch.py",
        {"/joint_states": 100.0, "/arm_controller/controller_state": 50.0},
        active=("joint_state_broadcaster", "arm_controller", "gripper_controller"),
        says=("unknown command line flag 'use_sim'",),
    ),
    "M19": Row(
        "ros2 launch linorobot2_gazebo gazebo.launch.py",
        {"/odom": 50.0, "/odom/unfiltered": 100.0, "/scan": None, "/imu/data": None},
        nodes=("/command_timeout", "/ekf_filter_node"),
        environment={"LINOROBOT2_BASE": "2wd"},
        drives=("/cmd_vel", "/odom"),
    ),
    "M20": Row(
        "ros2 launch rosbot_gazebo simulation.launch.py",
        {"/scan": None, "/odometry/filtered": None, "/joint_states": None},
        active=("joint_state_broadcaster", "rosbot_base_controller", "imu_broadcaster"),
    ),
    "M21": Row(
        "ros2 launch sjtu_drone_bringup sjtu_drone_bringup.launch.py",
        {
            "/simple_drone/imu/out": 100.0, "/simple_drone/gps/nav": 30.0,
            "/simple_drone/bumper_states": None, "/simple_drone/front/image_raw": None,
        },
        says=("the program 'xterm' is not on the PATH",),
        named=(_plugin("libplugin_drone.so"),),
    ),
    "M22": Row(
        "ros2 launch ur_simulation_gz ur_sim_control.launch.py",
        {"/joint_states": None},
        active=("joint_state_broadcaster", "joint_trajectory_controller"),
    ),
    "M23": Row(
        "ros2 launch ur_simulation_gazebo ur_sim_control.launch.py",
        {"/joint_states": None},
        active=("joint_state_broadcaster", "joint_trajectory_controller"),
    ),
    "M24": Row(
        "ros2 launch sam_bot_description display.launch.py",
        {"/odometry/filtered": None, "/scan": None, "/demo/imu": None, "/demo/odom": None},
    ),
    "M25": Row(
        "ros2 launch ros_gz_example_bringup diff_drive.launch.py",
        {
            "/diff_drive/odometry": None, "/diff_drive/scan": None, "/joint_states": None,
        },
        nodes=("/robot_state_publisher", "/ros_gz_bridge"),
        # gz sim starts paused; the README has one press "play".
        first="gz service -s /world/demo/control --reqtype gz.msgs.WorldControl "
        "--reptype gz.msgs.Boolean --timeout 20000 --req 'pause: false'",
    ),
    "M26": Row(
        "ros2 launch turtlebot4_ignition_bringup turtlebot4_ignition.launch.py",
        {"/scan": None, "/odom": None, "/joint_states": None},
        active=("joint_state_broadcaster", "diffdrive_controller"),
    ),
    "M27": Row(
        "ros2 launch neo_simulation2 simulation.launch.py",
        {"/odom": None, "/joint_states": None},
        environment={"MY_ROBOT": "mp_400", "MAP_NAME": "neo_workshop"},
    ),
    "M28": Row(
        "ros2 launch bme_gazebo_basics spawn_robot.launch.py",
        {"/odom": None, "/joint_states": None},
        environment={"GZ_SIM_RESOURCE_PATH": "~/gazebo_models"},
        drives=("/cmd_vel", "/odom"),
    ),
    "M29": Row(
        "ros2 launch yahboom_rosmaster_gazebo yahboom_rosmaster.gazebo.launch.py",
        {"/scan": None, "/joint_states": None},
        active=("joint_state_broadcaster",),
        workspace="ros2_ws",  # its launch file writes below ~/ros2_ws/src
    ),
    "M30": Row(
        "ros2 launch dummy_robot_bringup dummy_robot_bringup.launch.py",
        nodes=("/robot_state_publisher",),
        named=(
            _compiled("dummy_map_server"), _compiled("dummy_joint_states"),
            _compiled("dummy_laser"),
        ),
        has_clock=False,
    ),
    "M32": Row(
        "ros2 launch aws_robomaker_bookstore_world bookstore.launch.py gui:=true",
        {"/clock": None},
    ),
    "M34": Row(
        "ros2 launch bumperbot_description gazebo.launch.py", {"/imu/out": None},
    ),
}  # fmt: skip


@pytest.fixture
def row(request: pytest.FixtureRequest) -> Row:
    """What must be seen of the package that the test's parameter names."""
    return ROWS[request.param]


@pytest.fixture
def stage(
    request: pytest.FixtureRequest, row: Row, laid_out: Callable[[str], Path]
) -> Iterator[Stage]:
    """The stage of that package."""
    package = request.node.callspec.params["row"]
    with staged(laid_out(package), row.environment) as opened:
        if row.workspace:
            (opened.home / row.workspace).symlink_to(opened.folder / "ws")
            cache = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
            opened.environment |= {"HOME": str(opened.home), "XDG_CACHE_HOME": cache}
        yield opened


def of(*packages: str) -> pytest.MarkDecorator:
    """Run a test for these packages."""
    return pytest.mark.parametrize("row", packages, indirect=True)


def wait_for_running(stage: Stage, row: Row, patience_s: float = 90.0) -> None:
    """Wait until a controller manager of ROS 1 says that the controllers run."""
    deadline_s = time.monotonic() + patience_s
    while True:
        listed = stage.run(f"rosservice call {row.manager}/list_controllers").stdout
        states = dict(re.findall(r'name: "([^"]+)"\s+state: "([^"]+)"', listed))
        if all(states.get(name) == "running" for name in row.running):
            return
        assert time.monotonic() < deadline_s, f"not all running: {listed}"


def moves(seen: Seen, command: str, odometry: str) -> None:
    """Check that a robot drives forward when told to."""
    begin = seen.topic(odometry).next().pose.pose.position
    seen.drive(command, 0.3, 0.0, 1.5)
    end = seen.topic(odometry).next().pose.pose.position
    way_m = math.hypot(end.x - begin.x, end.y - begin.y)
    assert 0.1 < way_m < 0.8, f"{way_m:.3f} m"


def is_up(seen: Seen, stage: Stage, row: Row) -> None:
    """Wait for all that the row wants, and check it."""
    for pattern in row.says:
        seen.says(pattern)
    for name in row.nodes:
        seen.wait_for_node(name)
    if row.first:
        done = stage.run(row.first)
        assert done.code == 0, done.output
    if row.topics:
        seen.wait_for_topics(*row.topics)
    if row.has_clock:
        seen.wait_until(0.5)
    if row.running:
        wait_for_running(stage, row)
    if row.active:
        seen.wait_for_controllers(*row.active, manager=row.manager)
    for topic, hz in row.topics.items():
        if hz is None:
            seen.topic(topic).next()
        else:
            seen.has_rate(topic, hz, sim_s=1.0, share=0.15)
    if row.drives is not None:
        moves(seen, *row.drives)
    for pattern in row.named:
        found = seen.said(pattern)
        assert len(found) == 1, f"{pattern!r} is told {len(found)} times: {found}"


@of(*ROWS)
def test_the_readmes_command_brings_it_up(stage: Stage, row: Row) -> None:
    with stage.launch(row.command, traceback=row.traceback) as seen:
        is_up(seen, stage, row)


@of("M17")
def test_stand_ins_for_compiled_hardware_let_its_controllers_run(stage: Stage, row: Row) -> None:
    with stage.launch(row.command, env={"GAZELLE_MOCK_HARDWARE": "1"}) as seen:
        seen.wait_for_controllers("joint_state_broadcaster", "xarm6_traj_controller")
        seen.topic("/joint_states").next()
