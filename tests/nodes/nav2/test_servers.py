"""Nav2's servers together, with a robot without physics."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.nodes.navigation.plane_world import PlaneWorld, room

from gazelle.graph.actions import ActionClient

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
                       "waypoint_follower"],
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
def start(bench: Any, world: PlaneWorld, tmp_path: Path) -> Any:
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
    client = ActionClient(bench.node, name, f"nav2_msgs/{kind}", generation=2)
    client.require_server(20.0)
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
