"""Nav2's servers together, with a robot without physics."""

from __future__ import annotations

import math
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.nodes.navigation.plane_world import PlaneWorld, room
from tests.patience import stretched

from gazelle.graph.actions import ActionClient
from gazelle.nodes.arguments import ABSENT_NODES

_COSTMAP = {
    "robot_base_frame": "base_footprint",
    "robot_radius": 0.12,
    "resolution": 0.05,
    "update_frequency": 10.0,
    "publish_frequency": 5.0,
    "transform_tolerance": 0.5,
    "obstacle_layer": {
        "plugin": "nav2_costmap_2d::ObstacleLayer",
        "observation_sources": "scan",
        "scan": {"topic": "/scan", "clearing": True, "marking": True, "max_obstacle_height": 2.0,
                 "data_type": "LaserScan", "obstacle_max_range": 3.0, "raytrace_max_range": 3.5},
    },
    "inflation_layer": {"plugin": "nav2_costmap_2d::InflationLayer", "inflation_radius": 0.4,
                        "cost_scaling_factor": 3.0},
}  # fmt: skip
_PARAMETERS: dict[str, Any] = {
    "planner_server": {
        "planner_plugins": ["GridBased"],
        "GridBased": {"plugin": "nav2_navfn_planner/NavfnPlanner", "tolerance": 0.3},
    },
    "controller_server": {
        "controller_frequency": 10.0,
        "failure_tolerance": 0.5,
        "controller_plugins": ["FollowPath"],
        "progress_checker_plugins": ["progress_checker"],
        "goal_checker_plugins": ["general_goal_checker"],
        "progress_checker": {"plugin": "nav2_controller::SimpleProgressChecker",
                             "movement_time_allowance": 10.0},
        "general_goal_checker": {"plugin": "nav2_controller::SimpleGoalChecker",
                                 "xy_goal_tolerance": 0.15, "yaw_goal_tolerance": 0.25},
        "FollowPath": {
            "plugin": "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController",
            "desired_linear_vel": 0.5, "lookahead_dist": 0.4,
        },
    },
    "behavior_server": {
        "robot_base_frame": "base_footprint",
        "behavior_plugins": ["spin", "backup", "drive_on_heading", "wait"],
        **{name: {"plugin": f"nav2_behaviors/{kind}"} for name, kind in (
            ("spin", "Spin"), ("backup", "BackUp"), ("drive_on_heading", "DriveOnHeading"),
            ("wait", "Wait"))},
    },
    "bt_navigator": {"robot_base_frame": "base_footprint", "odom_topic": "/odom"},
    "waypoint_follower": {"loop_rate": 20.0, "stop_on_failure": False},
    "lifecycle_manager_navigation": {
        "autostart": True,
        "node_names": ["controller_server", "planner_server", "behavior_server", "bt_navigator",
                       "route_server", "waypoint_follower"],
    },
}  # fmt: skip
_NESTED = {
    "local_costmap": {"local_costmap": {"ros__parameters": {
        **_COSTMAP, "global_frame": "odom", "rolling_window": True, "width": 3, "height": 3,
        "plugins": ["obstacle_layer", "inflation_layer"]}}},
    "global_costmap": {"global_costmap": {"ros__parameters": {
        **_COSTMAP, "global_frame": "map",
        "plugins": ["static_layer", "obstacle_layer", "inflation_layer"],
        "static_layer": {"plugin": "nav2_costmap_2d::StaticLayer"}}}},
}  # fmt: skip
_NODES = (
    ("nav2_planner", "planner_server"),
    ("nav2_controller", "controller_server"),
    ("nav2_behaviors", "behavior_server"),
    ("nav2_bt_navigator", "bt_navigator"),
    ("nav2_waypoint_follower", "waypoint_follower"),
)


@pytest.fixture
def world(bench: Any, tmp_path: Path) -> Iterator[PlaneWorld]:
    made = PlaneWorld(bench.node, room())
    yield made
    made.close()


@pytest.fixture
def start(bench: Any, world: PlaneWorld, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    # A manager does not wait for a node that the launch could not start.
    monkeypatch.setenv(ABSENT_NODES, "/route_server")

    def started(**changes: dict[str, Any]) -> None:
        sections = {name: {"ros__parameters": {"use_sim_time": True, **values}}
                    for name, values in _PARAMETERS.items()}  # fmt: skip
        for name, values in changes.items():
            sections[name]["ros__parameters"].update(values)
        file = tmp_path / "nav2_params.yaml"
        file.write_text(yaml.safe_dump({**sections, **_NESTED}))
        world.start()
        words = ("--ros-args", "--params-file", str(file))
        for package, name in _NODES:
            bench.start(f"{package}/{name}", *words)
        bench.start(
            "nav2_lifecycle_manager/lifecycle_manager", *words, "-r",
            "__node:=lifecycle_manager_navigation",
        )  # fmt: skip
        kind = "std_srvs/srv/Trigger"
        service = "/lifecycle_manager_navigation/is_active"
        bench.eventually(lambda: bench.call(service, kind).success)

    return started


def _pose(x: float, y: float, yaw: float = 0.0) -> Any:
    from gazelle.interfaces import message_type

    made = message_type("geometry_msgs/msg/PoseStamped")()
    made.header.frame_id = "map"
    made.pose.position.x, made.pose.position.y = x, y
    made.pose.orientation.z, made.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


def _send(bench: Any, name: str, kind: str, **fields: Any) -> Any:
    client = ActionClient(bench.node, name, f"nav2_msgs/{kind}", ros_version=2)
    client.require_server(stretched(20.0))
    goal = client.send_goal(client.types.Goal(**fields))
    bench.eventually(lambda: goal.is_done)
    return goal


def test_navigate_to_pose_through_poses_and_waypoints(bench, world, start) -> None:
    start()
    goal = _send(bench, "navigate_to_pose", "NavigateToPose", pose=_pose(4.0, 1.5))
    assert (goal.status.name, goal.result.error_msg) == ("SUCCEEDED", "")
    assert math.hypot(world.pose[0] - 4.0, world.pose[1] - 1.5) <= 0.15 + 0.05
    through = [_pose(3.0, 3.0), _pose(1.0, 3.0)]
    goal = _send(bench, "navigate_through_poses", "NavigateThroughPoses", poses=through)
    assert goal.status.name == "SUCCEEDED"
    assert math.hypot(world.pose[0] - 1.0, world.pose[1] - 3.0) <= 0.15 + 0.05
    points = [_pose(1.0, 1.0), _pose(50.0, 1.0), _pose(2.0, 1.0)]
    goal = _send(bench, "follow_waypoints", "FollowWaypoints", poses=points)
    assert goal.status.name == "SUCCEEDED"
    assert [int(one.index) for one in goal.result.missed_waypoints] == [1]
    assert not world.touched


def test_late_tf_is_told_and_driven_by(bench, world, start) -> None:
    world.late_steps = 14
    # Half of the room's height, not on the map.
    world.boxes[:40, 58:62] = True
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    start()
    goal = _send(bench, "navigate_to_pose", "NavigateToPose", pose=_pose(4.0, 1.5))
    assert (goal.status.name, goal.result.error_msg) == ("SUCCEEDED", "")
    assert not world.touched
    texts = [one.msg for one in said]
    late = re.compile(r"the transform from base_footprint to map is 0\.\d+ s old, .*all the same")
    assert any(late.match(text) for text in texts), texts


_SCRIPT = """
import rclpy
from geometry_msgs.msg import PoseStamped
from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult

rclpy.init()
navigator = BasicNavigator()
navigator.waitUntilNav2Active(localizer="robot_localization")

def pose(x, y):
    made = PoseStamped()
    made.header.frame_id = "map"
    made.pose.position.x, made.pose.position.y = x, y
    made.pose.orientation.w = 1.0
    return made

path = navigator.getPath(pose(0.0, 0.0), pose(2.0, 1.0))
print("path", len(path.poses) > 5, navigator.getPath(pose(0.0, 0.0), pose(90.0, 1.0)))
navigator.goToPose(pose(2.0, 1.0))
seen = 0
while not navigator.isTaskComplete():
    seen += navigator.getFeedback() is not None
print("drive", navigator.getResult() is TaskResult.SUCCEEDED, seen > 0, flush=True)
input()
navigator.spin(500.0, time_allowance=1000)
navigator.cancelTask()
while not navigator.isTaskComplete():
    pass
print("spin", navigator.getResult())
navigator.clearAllCostmaps()
print("costmap", navigator.getGlobalCostmap().metadata.size_x)
navigator.goToPose(pose(90.0, 1.0))
navigator.cancelTask()
while not navigator.isTaskComplete():
    pass
print("left", navigator.getResult())
rclpy.shutdown()
"""


def test_simple_commander_drives(bench, world, start, gazelle, tmp_path: Path) -> None:
    start()
    script = tmp_path / "commander.py"
    script.write_text(_SCRIPT)
    words = {"module": "gazelle.compat.script_runner", "ROS_VERSION": "2"}
    run = gazelle(str(script), stdin=subprocess.PIPE, **words)
    run.wait_for_line("^drive True True$")
    assert "path True None" in run.text
    # What is to be cancelled must not be over before.
    world.factor = 2.0
    run.popen.stdin.write("\n")
    run.popen.stdin.close()
    assert run.wait(stretched(120.0)) == 0, run.text
    assert "spin TaskResult.CANCELED" in run.text
    assert "costmap 120" in run.text
    assert "left TaskResult.CANCELED" in run.text


def test_behaviours_move_the_robot(bench, world, start) -> None:
    start()
    from gazelle.interfaces import message_type

    # How far they go beyond the goal is how late they are, times this.
    world.factor = 2.0
    before = world.pose
    assert _send(bench, "spin", "Spin", target_yaw=1.57).status.name == "SUCCEEDED"
    assert math.remainder(world.pose[2] - before[2] - 1.57, math.tau) == pytest.approx(0, abs=0.2)
    point = message_type("geometry_msgs/msg/Point")
    goal = _send(bench, "drive_on_heading", "DriveOnHeading", target=point(x=0.5), speed=0.25)
    assert goal.status.name == "SUCCEEDED"
    assert world.pose[1] - before[1] == pytest.approx(0.5, abs=0.1)
    goal = _send(bench, "backup", "BackUp", target=point(x=0.3), speed=0.1)
    assert goal.status.name == "SUCCEEDED"
    assert world.pose[1] - before[1] == pytest.approx(0.2, abs=0.15)
    # A wall is 4 m away, and the robot drives on while the costmap is late.
    world.factor = 1.0
    goal = _send(bench, "drive_on_heading", "DriveOnHeading", target=point(x=9.0), speed=0.5)
    assert goal.status.name == "ABORTED"
    assert (goal.result.error_code, goal.result.error_msg) == (723, "Collision Ahead - Exiting")
    goal = _send(bench, "drive_on_heading", "DriveOnHeading", target=point(x=1.0), speed=-1.0)
    assert goal.result.error_msg == "Speed and command sign did not match"
    assert not world.touched


def test_unreachable_goals_end_with_codes_and_reasons(bench, world, start, tmp_path: Path) -> None:
    tree = tmp_path / "once.xml"
    tree.write_text(
        '<root BTCPP_format="4" main_tree_to_execute="Once"><BehaviorTree ID="Once"><Sequence>'
        '<ComputePathToPose goal="{goal}" path="{path}" error_code_id="{compute_path_error_code}"/>'
        '<FollowPath path="{path}"/></Sequence></BehaviorTree></root>'
    )
    start(bt_navigator={"default_nav_to_pose_bt_xml": str(tree)})
    goal = _send(bench, "navigate_to_pose", "NavigateToPose", pose=_pose(90.0, 1.0))
    assert goal.status.name == "ABORTED"
    assert goal.result.error_code == 204
    assert "The goal (90.00, 1.00) is off the global costmap" in goal.result.error_msg
    goal = _send(bench, "navigate_to_pose", "NavigateToPose", pose=_pose(2.0, 1.0))
    assert goal.status.name == "SUCCEEDED"
    goal = _send(
        bench, "compute_path_to_pose", "ComputePathToPose", goal=_pose(1.0, 1.0), planner_id="Grid"
    )
    assert goal.result.error_code == 201
    assert "Planner names are: GridBased" in goal.result.error_msg
    strange = _pose(1.0, 1.0)
    strange.header.frame_id = "mapp"
    goal = _send(bench, "navigate_to_pose", "NavigateToPose", pose=strange)
    assert goal.status.name == "ABORTED"
    empty = _send(bench, "follow_waypoints", "FollowWaypoints")
    assert empty.status.name == "ABORTED"
