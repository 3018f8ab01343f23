"""Leaves: conditions, path tools, actions and services."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from gazelle.interfaces import message_type
from gazelle.nodes.nav2.behavior_trees.ros_interface import Pose2
from gazelle.nodes.nav2.behavior_trees.tree_node import Status, TreeError

RUNNING, SUCCESS, FAILURE = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def _at(x: float):
    made = message_type("geometry_msgs/msg/PoseStamped")()
    made.pose.position.x = float(x)
    return made


def _path(*xs: float):
    return message_type("nav_msgs/msg/Path")(poses=[_at(x) for x in xs])


def _xs(path) -> list[float]:
    return [pose.pose.position.x for pose in path.poses]


def test_goal_reached_within_25_cm(plant, world) -> None:
    tree = plant('<GoalReached goal="{g}"/>', g=_at(0.24))
    assert tree.execute() is SUCCESS
    tree.ports.blackboard.set("g", _at(0.26))
    assert tree.execute() is FAILURE


def test_goal_updated_compares_with_the_last_tick(plant) -> None:
    tree = plant('<GoalUpdated goal="{g}"/>', g="a")
    assert tree.execute() is FAILURE
    tree.ports.blackboard.set("g", "b")
    assert tree.execute() is SUCCESS
    tree.halt()
    tree.ports.blackboard.set("g", "c")
    assert tree.execute() is FAILURE
    tree = plant('<GloballyUpdatedGoal goal="{g}"/>', g="a")
    tree.execute()
    tree.halt()
    tree.ports.blackboard.set("g", "b")
    assert tree.execute() is SUCCESS


def test_time_and_distance_expire(plant, world) -> None:
    timer, way = plant('<TimeExpired seconds="2"/>'), plant('<DistanceTraveled distance="1"/>')
    path_timer = plant('<PathExpiringTimer seconds="2" path="{p}"/>', p="old")
    for tree in (timer, way, path_timer):
        assert tree.execute() is FAILURE
    world.now, world.at = 1_900_000_000, Pose2(0.9, 0.0, 0.0)
    path_timer.ports.blackboard.set("p", "new")
    assert [one.execute() for one in (timer, way, path_timer)] == [FAILURE] * 3
    world.now, world.at = 2_000_000_000, Pose2(1.1, 0.0, 0.0)
    assert [one.execute() for one in (timer, way, path_timer)] == [SUCCESS, SUCCESS, FAILURE]


def test_transform_and_initial_pose(plant, world) -> None:
    tree = plant('<TransformAvailable child="odom" parent="map"/>')
    assert tree.execute() is FAILURE
    world.frames.add(("map", "odom"))
    assert tree.execute() is SUCCESS
    assert plant("<InitialPoseReceived/>").execute() is FAILURE
    assert plant("<InitialPoseReceived/>", initial_pose_received=True).execute() is SUCCESS


@pytest.mark.parametrize(
    ("ports", "status"),
    [('min_battery="0.3"', SUCCESS), ('min_battery="0.1"', FAILURE),
     ('min_battery="11" is_voltage="true"', FAILURE)],
)  # fmt: skip
def test_battery(plant, world, ports, status) -> None:
    assert plant(f"<IsBatteryLow {ports}/>").execute() is FAILURE
    state = message_type("sensor_msgs/msg/BatteryState")(
        percentage=0.2, voltage=12.0, power_supply_status=1
    )
    world.topics["/battery_status"] = state
    assert plant(f"<IsBatteryLow {ports}/>").execute() is status
    assert plant("<IsBatteryCharging/>").execute() is SUCCESS


def test_error_codes(plant) -> None:
    xml = '<AreErrorCodesPresent error_code="{e}" error_codes_to_check="5,7"/>'
    assert plant(xml, e=7).execute() is SUCCESS
    assert plant(xml, e=8).execute() is FAILURE
    for kind, code in (("Controller", 105), ("Planner", 208), ("Smoother", 502)):
        tree = plant(f'<WouldA{kind}RecoveryHelp error_code="{{e}}"/>', e=code)
        assert tree.execute() is SUCCESS
        tree.ports.blackboard.set("e", 101)
        assert tree.execute() is FAILURE


def test_remove_passed_goals(plant, world) -> None:
    goals = [_at(0.1), _at(0.4), _at(3.0)]
    xml = '<RemovePassedGoals input_goals="{g}" output_goals="{g}" radius="0.5"/>'
    tree = plant(xml, g=goals)
    assert tree.execute() is SUCCESS
    assert [goal.pose.position.x for goal in tree.ports.blackboard.get("g")] == [3.0]


def test_paths_are_truncated(plant, world) -> None:
    path = _path(0, 1, 2, 3, 4)
    tree = plant('<TruncatePath distance="1.5" input_path="{p}" output_path="{o}"/>', p=path)
    tree.execute()
    assert _xs(tree.ports.blackboard.get("o")) == [0.0, 1.0, 2.0]
    world.at = Pose2(2.1, 0.0, 0.0)
    ports = 'distance_forward="1" distance_backward="1" input_path="{p}" output_path="{o}"'
    tree = plant(f"<TruncatePathLocal {ports}/>", p=path)
    tree.execute()
    assert _xs(tree.ports.blackboard.get("o")) == [1.0, 2.0, 3.0]


def test_goal_is_nearby_by_the_path(plant) -> None:
    xml = '<IsGoalNearby path="{p}" proximity_threshold="2"/>'
    assert plant(xml, p=_path(0, 1)).execute() is SUCCESS
    assert plant(xml, p=_path(0, 3)).execute() is FAILURE


@pytest.mark.parametrize("word", ["planner", "controller", "smoother", "goal_checker"])
def test_selectors_take_the_topic_before_the_default(plant, world, word) -> None:
    kind = "".join(part.capitalize() for part in word.split("_"))
    xml = f'<{kind}Selector default_{word}="A" selected_{word}="{{s}}" topic_name="choice"/>'
    tree = plant(xml)
    tree.execute()
    assert tree.ports.blackboard.get("s") == "A"
    world.topics["choice"] = SimpleNamespace(data="B")
    tree.execute()
    assert tree.ports.blackboard.get("s") == "B"


def test_blackboard_is_set_and_unset(plant) -> None:
    tree = plant('<SetBlackboard value="5" output_key="k"/>')
    tree.execute()
    assert tree.ports.blackboard.get("k") == "5"
    plant('<UnsetBlackboard key="k"/>', k=1).execute()


def test_path_validity_is_the_planner_servers_word(plant, world) -> None:
    tree = plant('<IsPathValid path="{p}"/>', p=_path(0, 1))
    assert tree.execute() is RUNNING
    assert world.calls[0].name == "is_path_valid"
    world.calls[0].end(True, SimpleNamespace(is_valid=False))
    assert tree.execute() is FAILURE


def test_compute_path_sends_goal_and_planner_and_keeps_the_path(plant, world) -> None:
    xml = '<ComputePathToPose goal="{g}" planner_id="GridBased" path="{p}" error_code_id="{e}"/>'
    tree = plant(xml, g=_at(1))
    assert tree.execute() is RUNNING
    call = world.calls[0]
    assert call.name == "compute_path_to_pose"
    assert call.content == {"goal": _at(1), "planner_id": "GridBased", "use_start": False}
    call.end(True, SimpleNamespace(path="the path", error_code=0))
    assert tree.execute() is SUCCESS
    assert tree.ports.blackboard.get("p") == "the path"
    assert tree.ports.blackboard.get("e") == 0


def test_follow_path_sends_a_new_path_while_it_runs(plant, world) -> None:
    tree = plant('<FollowPath path="{p}" controller_id="FollowPath"/>', p=_path(0, 1))
    tree.execute()
    tree.execute()
    assert len(world.calls) == 1
    tree.ports.blackboard.set("p", _path(0, 2))
    assert tree.execute() is RUNNING
    assert [_xs(call.content["path"]) for call in world.calls] == [[0.0, 1.0], [0.0, 2.0]]
    tree.halt()
    assert world.calls[1].cancelled


@pytest.mark.parametrize(
    ("xml", "server", "content"),
    [
        ('<Spin spin_dist="1.57"/>', "spin",
         {"target_yaw": 1.57, "time_allowance": {"sec": 10, "nanosec": 0}}),
        ('<BackUp backup_dist="0.3" backup_speed="0.05"/>', "backup",
         {"target": {"x": 0.3}, "speed": 0.05, "time_allowance": {"sec": 10, "nanosec": 0}}),
        ('<DriveOnHeading dist_to_travel="0.2" speed="0.1" time_allowance="2.5"/>',
         "drive_on_heading",
         {"target": {"x": 0.2}, "speed": 0.1, "time_allowance": {"sec": 2, "nanosec": 500000000}}),
        ('<Wait wait_duration="5"/>', "wait", {"time": {"sec": 5, "nanosec": 0}}),
    ],
)  # fmt: skip
def test_recoveries_send_their_goals_and_count(plant, world, xml, server, content) -> None:
    tree = plant(xml)
    tree.execute()
    assert (world.calls[0].name, world.calls[0].content) == (server, content)
    assert tree.ports.blackboard.get("number_recoveries") == 1


def test_costmaps_are_cleared_by_service(plant, world) -> None:
    tree = plant('<ClearEntireCostmap service_name="local_costmap/clear_entirely_local_costmap"/>')
    assert tree.execute() is RUNNING
    assert world.calls[0].name == "local_costmap/clear_entirely_local_costmap"
    world.calls[0].end(True)
    assert tree.execute() is SUCCESS
    tree = plant('<ClearCostmapAroundRobot service_name="s" reset_distance="2"/>')
    tree.execute()
    assert world.calls[1].content.reset_distance == 2.0


def test_cancel_nodes_cancel_the_action(plant, world) -> None:
    assert plant("<CancelControl/>").execute() is SUCCESS
    assert world.calls[0].name == "cancel follow_path"


def test_missing_input_names_node_port_and_key(plant) -> None:
    with pytest.raises(TreeError, match=r"\[FollowPath\]: .* \[path\]: key 'p' .* not set"):
        plant('<IsPathValid name="FollowPath" path="{p}"/>').execute()
    with pytest.raises(TreeError, match=r"port \[hz\] is 'often', not a number"):
        tree = plant('<RateController hz="often"><AlwaysSuccess/></RateController>')
        tree.execute()
