"""move_base as a node, with a robot without physics."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.nodes.navigation.plane_world import PlaneWorld, room
from tests.patience import stretched

from gazelle.graph.actions import ActionClient

_COSTMAP = {
    "obstacle_range": 3.0,
    "raytrace_range": 3.5,
    "footprint": [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]],
    "inflation_radius": 0.5,
    "cost_scaling_factor": 3.0,
    "map_type": "costmap",
    "observation_sources": "scan",
    "scan": {"sensor_frame": "base_scan", "data_type": "LaserScan", "topic": "scan",
             "marking": True, "clearing": True},
    "robot_base_frame": "base_footprint",
    "update_frequency": 10.0,
    "publish_frequency": 10.0,
    "transform_tolerance": 0.5,
}  # fmt: skip
_PARAMETERS = {
    "base_local_planner": "dwa_local_planner/DWAPlannerROS",
    "controller_frequency": 10.0,
    "planner_frequency": 5.0,
    "planner_patience": 2.0,
    "controller_patience": 4.0,
    "global_costmap": {**_COSTMAP, "global_frame": "map", "static_map": True},
    "local_costmap": {
        **_COSTMAP, "global_frame": "odom", "static_map": False, "rolling_window": True,
        "width": 3, "height": 3, "resolution": 0.05,
    },
    "DWAPlannerROS": {
        "max_vel_x": 0.5, "min_vel_x": -0.2, "max_vel_y": 0.0, "min_vel_y": 0.0,
        "max_vel_trans": 0.5, "min_vel_trans": 0.1, "max_vel_theta": 2.0, "min_vel_theta": 0.5,
        "acc_lim_x": 2.5, "acc_lim_y": 0.0, "acc_lim_theta": 3.2, "xy_goal_tolerance": 0.1,
        "yaw_goal_tolerance": 0.2, "sim_time": 1.5, "vx_samples": 10, "vy_samples": 0,
        "vth_samples": 20, "path_distance_bias": 32.0, "goal_distance_bias": 20.0,
        "occdist_scale": 0.02,
    },
}  # fmt: skip


@pytest.fixture
def world(bench: Any) -> Iterator[PlaneWorld]:
    made = PlaneWorld(bench.node, room())
    yield made
    made.close()


@pytest.fixture
def start(bench: Any, world: PlaneWorld) -> Any:
    def started(**parameters: Any) -> ActionClient:
        bench.node.parameters.set("/move_base", {**_PARAMETERS, **parameters})
        bench.start("move_base/move_base")
        client = ActionClient(bench.node, "move_base", "move_base_msgs/MoveBase")
        client.require_server(stretched(20.0))
        world.start()
        return client

    return started


def _goal(x: float, y: float, yaw: float = 0.0, frame: str = "map") -> dict[str, Any]:
    turn = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    pose = {"position": {"x": x, "y": y}, "orientation": turn}
    return {"target_pose": {"header": {"frame_id": frame}, "pose": pose}}


def test_robot_drives_to_goals_and_tells_about_it(bench, world, start) -> None:
    client = start()
    plans = bench.listen("/move_base/NavfnROS/plan", "nav_msgs/msg/Path")
    locals_ = bench.listen("/move_base/DWAPlannerROS/local_plan", "nav_msgs/msg/Path")
    feedback: list[Any] = []
    goal = client.send_goal(_goal(4.0, 3.0, math.pi / 2), on_feedback=feedback.append)
    bench.eventually(lambda: goal.is_done)
    assert (goal.status.name, goal.text) == ("SUCCEEDED", "Goal reached.")
    x, y, yaw = world.pose
    assert math.hypot(x - 4.0, y - 3.0) <= 0.1 + 0.02
    assert abs(yaw - math.pi / 2) <= 0.2 + 0.05
    assert not world.touched
    assert feedback[0].base_position.header.frame_id == "map"
    assert plans[-1].header.frame_id == "map"
    assert locals_[-1].header.frame_id == "odom"
    bench.eventually(lambda: world.twist == (0.0, 0.0))


def test_box_in_the_way_is_avoided(bench, world, start) -> None:
    # Two thirds of the room's height, not on the map.
    world.boxes[:50, 58:62] = True
    client = start()
    goal = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: goal.is_done)
    assert goal.text == "Goal reached."
    assert not world.touched


def test_unreachable_goal_is_refused_with_a_reason_after_recovery(bench, world, start) -> None:
    world.walls[:, 80] = True
    client = start(planner_patience=0.5, recovery_behaviors=[
        {"name": "reset", "type": "clear_costmap_recovery/ClearCostmapRecovery"},
        {"name": "turn", "type": "rotate_recovery/RotateRecovery"},
    ])  # fmt: skip
    status = bench.listen("/move_base/recovery_status", "move_base_msgs/msg/RecoveryStatus")
    goal = client.send_goal(_goal(5.0, 2.0))
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "ABORTED"
    assert goal.text.startswith(
        "Failed to find a valid plan. Even after executing recovery behaviors. Last reason: The"
        " goal (5.00, 2.00) is free, but no way leads there"
    )
    bench.eventually(lambda: len(status) >= 2)
    assert [one.recovery_behavior_name for one in status] == ["reset", "turn"]


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"orientation": {"w": 0.0}}, "Quaternion has length close to zero"),
        ({"orientation": {"x": math.nan, "w": 1.0}}, "Quaternion has nans or infs"),
        ({"orientation": {"x": 0.7, "w": 0.7}}, "z-axis of the quaternion must be close to vert"),
        ({"frame": "mapp"}, '"mapp" passed to lookupTransform argument source_frame does not'),
    ],
)
def test_goals_that_make_no_sense_are_refused_at_once(bench, world, start, changes, text) -> None:
    client = start()
    wanted = _goal(2.0, 2.0, frame=changes.get("frame", "map"))
    if "orientation" in changes:
        wanted["target_pose"]["pose"]["orientation"] = changes["orientation"]
    goal = client.send_goal(wanted)
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "ABORTED"
    assert text in goal.text


def test_newer_goal_and_cancelling(bench, world, start) -> None:
    client = start()
    first = client.send_goal(_goal(5.0, 3.0))
    bench.eventually(lambda: world.pose[0] > 1.2)
    second = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: first.is_done)
    assert first.status.name == "PREEMPTED"
    bench.eventually(lambda: second.status.name == "ACTIVE")
    client.cancel_all()
    bench.eventually(lambda: second.is_done)
    assert second.status.name == "PREEMPTED"
    bench.eventually(lambda: world.twist == (0.0, 0.0))


def test_goal_of_rviz_is_taken_in_the_robots_frame(bench, world, start) -> None:
    client = start()
    out = bench.node.create_publisher("/move_base_simple/goal", "geometry_msgs/msg/PoseStamped")
    bench.eventually(lambda: world.now_ns > 2_000_000_000 and out.matched)
    told = bench.listen("/move_base/current_goal", "geometry_msgs/msg/PoseStamped")
    message = out.message_class()
    message.header.frame_id = "base_footprint"
    message.pose.position.x, message.pose.orientation.w = 1.0, 1.0
    out.publish(message)
    bench.eventually(lambda: told)
    assert told[0].header.frame_id == "map"
    assert told[0].pose.position.x == pytest.approx(2.0, abs=0.05)
    bench.eventually(lambda: abs(world.pose[0] - 2.0) < 0.15)
    assert client.is_server_ready


def test_plans_for_others_and_clearing(bench, world, start) -> None:
    start()
    costmaps = bench.listen("/move_base/global_costmap/costmap", "nav_msgs/msg/OccupancyGrid")
    bench.eventually(lambda: costmaps)
    assert (costmaps[0].info.width, costmaps[0].info.height) == (120, 80)
    assert costmaps[0].data[0] == 100
    updates = bench.listen(
        "/move_base/local_costmap/costmap_updates", "map_msgs/msg/OccupancyGridUpdate"
    )
    bench.eventually(lambda: updates)
    goal = _goal(5.0, 3.0)["target_pose"]
    found = bench.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=_filled(goal))
    last = found.plan.poses[-1].pose.position
    assert (last.x, last.y) == pytest.approx((5.0, 3.0))
    assert found.plan.header.frame_id == "map"
    outside = _filled(_goal(50.0, 3.0)["target_pose"])
    assert not bench.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=outside).plan.poses
    planner = "/move_base/NavfnROS/make_plan"
    assert bench.call(planner, "nav_msgs/GetPlan", goal=_filled(goal)).plan.poses
    bench.call("/move_base/clear_costmaps", "std_srvs/Empty")


def test_parameters_change_while_it_runs(bench, world, start) -> None:
    start()
    from gazelle.graph.dynamic_reconfigure import ReconfigureClient

    client = ReconfigureClient(bench.node, "/move_base/DWAPlannerROS")
    assert client.set({"max_vel_x": 0.2, "max_vel_trans": 0.2})["max_vel_x"] == 0.2
    goal = ActionClient(bench.node, "move_base", "move_base_msgs/MoveBase").send_goal(
        _goal(5.0, 1.0)
    )
    bench.eventually(lambda: world.pose[0] > 1.5)
    assert world.twist[0] <= 0.2 + 1e-9
    inflation = ReconfigureClient(bench.node, "/move_base/local_costmap/inflation_layer")
    assert inflation.set({"inflation_radius": 0.3})["inflation_radius"] == 0.3
    goal.cancel()
    bench.eventually(lambda: goal.is_done)


def test_silent_lidar_stops_the_robot_where_a_rate_is_expected(bench, world, start) -> None:
    scan = {**_COSTMAP["scan"], "expected_update_rate": 0.5}
    local = {**_PARAMETERS["local_costmap"], "scan": scan}
    client = start(local_costmap=local)
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    goal = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: world.twist[0] > 0.1)
    world.blind = True
    bench.eventually(lambda: world.twist == (0.0, 0.0))
    # Each may be said of a start without a scan, too.
    for text in ("Sensor data is out of date", "observation buffer has not been updated for"):
        bench.eventually(lambda text=text: any(text in one.msg for one in said))
    world.blind = False
    bench.eventually(lambda: goal.is_done)
    assert goal.text == "Goal reached."


def _filled(pose: dict[str, Any]) -> Any:
    from gazelle.interfaces import fill, message_type

    message = message_type("geometry_msgs/msg/PoseStamped")()
    fill(message, pose)
    return message
