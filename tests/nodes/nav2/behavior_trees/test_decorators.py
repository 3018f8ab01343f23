"""Decorators: when the child is ticked, and what its status becomes."""

from __future__ import annotations

import pytest

from gazelle.interfaces import message_type
from gazelle.nodes.nav2.behavior_trees.ros_interface import Pose2
from gazelle.nodes.nav2.behavior_trees.tree_node import Status

RUNNING, SUCCESS, FAILURE = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def _path(*xs: float):
    pose = message_type("geometry_msgs/msg/PoseStamped")
    made = message_type("nav_msgs/msg/Path")()
    for x in xs:
        one = pose()
        one.pose.position.x = x
        made.poses.append(one)
    return made


@pytest.mark.parametrize(
    ("xml", "status"),
    [
        ("<Inverter><AlwaysSuccess/></Inverter>", FAILURE),
        ("<Inverter><AlwaysFailure/></Inverter>", SUCCESS),
        ("<ForceSuccess><AlwaysFailure/></ForceSuccess>", SUCCESS),
        ("<ForceFailure><AlwaysSuccess/></ForceFailure>", FAILURE),
        ('<Precondition if="x == 1" else="SUCCESS"><AlwaysFailure/></Precondition>', SUCCESS),
        ('<Precondition if="x == 0" else="SUCCESS"><AlwaysFailure/></Precondition>', FAILURE),
        ("<KeepRunningUntilFailure><AlwaysSuccess/></KeepRunningUntilFailure>", RUNNING),
        ("<KeepRunningUntilFailure><AlwaysFailure/></KeepRunningUntilFailure>", FAILURE),
        ("<KeepRunningUntilSuccess><AlwaysFailure/></KeepRunningUntilSuccess>", RUNNING),
        ("<KeepRunningUntilSuccess><AlwaysSuccess/></KeepRunningUntilSuccess>", SUCCESS),
    ],
)
def test_status_of_the_child_is_changed(plant, xml, status) -> None:
    assert plant(xml, x=0).execute() is status


def test_repeat_and_retry_count(plant) -> None:
    tree = plant('<Repeat num_cycles="3"><Script code="n += 1"/></Repeat>', n=0)
    assert [tree.execute() for _ in range(3)] == [RUNNING, RUNNING, SUCCESS]
    assert tree.ports.blackboard.get("n") == 3
    code = '<Sequence><Script code="n += 1"/><AlwaysFailure/></Sequence>'
    for kind in ("RetryUntilSuccessful", "RetryUntilSuccesful"):
        tree = plant(f'<{kind} num_attempts="2">{code}</{kind}>', n=0)
        assert [tree.execute() for _ in range(2)] == [RUNNING, FAILURE]
        assert tree.ports.blackboard.get("n") == 2


def test_delay_and_timeout_count_milliseconds_of_the_clock(plant, world) -> None:
    tree = plant('<Delay delay_msec="500"><AlwaysSuccess/></Delay>')
    assert tree.execute() is RUNNING
    world.now = 499_000_000
    assert tree.execute() is RUNNING
    world.now = 500_000_000
    assert tree.execute() is SUCCESS
    tree = plant('<Timeout msec="100"><Wait wait_duration="9"/></Timeout>')
    assert tree.execute() is RUNNING
    world.now += 101_000_000
    assert tree.execute() is FAILURE
    assert world.calls[0].cancelled


def test_run_once_and_single_trigger_fire_once(plant) -> None:
    tree = plant('<RunOnce then_skip="false"><Script code="n += 1"/></RunOnce>', n=0)
    assert [tree.execute() for _ in range(3)] == [SUCCESS] * 3
    assert tree.ports.blackboard.get("n") == 1
    assert plant("<RunOnce><AlwaysSuccess/></RunOnce>").execute() is SUCCESS
    tree = plant("<SingleTrigger><AlwaysSuccess/></SingleTrigger>")
    assert [tree.execute() for _ in range(2)] == [SUCCESS, FAILURE]
    tree.halt()
    assert tree.execute() is SUCCESS


def test_rate_controller_ticks_at_its_rate(plant, world) -> None:
    tree = plant('<RateController hz="2"><Script code="n += 1"/></RateController>', n=0)
    board = tree.ports.blackboard
    said = []
    for now in (0, 100, 499, 500, 600, 1000):
        world.now = now * 1_000_000
        said.append((tree.execute(), board.get("n")))
    assert said == [
        (SUCCESS, 1), (RUNNING, 1), (RUNNING, 1), (SUCCESS, 2), (RUNNING, 2), (SUCCESS, 3),
    ]  # fmt: skip


def test_speed_controller_ticks_faster_for_fast_robots(plant, world) -> None:
    ports = 'min_rate="1" max_rate="10" min_speed="0" max_speed="1"'
    tree = plant(f'<SpeedController {ports}><Script code="n += 1"/></SpeedController>', n=0)
    board = tree.ports.blackboard
    tree.execute()
    world.now = 150_000_000
    tree.execute()
    assert board.get("n") == 1
    world.speed = 2.0
    tree.execute()
    assert board.get("n") == 2


def test_distance_controller_ticks_after_a_way(plant, world) -> None:
    xml = '<DistanceController distance="1"><Script code="n += 1"/></DistanceController>'
    tree = plant(xml, n=0)
    tree.execute()
    world.at = Pose2(0.9, 0.0, 0.0)
    assert tree.execute() is RUNNING
    world.at = Pose2(1.1, 0.0, 0.0)
    assert tree.execute() is SUCCESS
    assert tree.ports.blackboard.get("n") == 2
    world.at = None
    assert tree.execute() is FAILURE


def test_goal_updater_takes_a_newer_goal_of_the_topic(plant, world) -> None:
    goal, newer = (message_type("geometry_msgs/msg/PoseStamped")() for _ in range(2))
    xml = '<GoalUpdater input_goal="{g}" output_goal="{o}"><AlwaysSuccess/></GoalUpdater>'
    tree = plant(xml, g=goal)
    tree.execute()
    assert tree.ports.blackboard.get("o") is goal
    newer.header.stamp.sec = 5
    world.topics["goal_update"] = newer
    tree.execute()
    assert tree.ports.blackboard.get("o") is newer


def test_goal_updated_controller_ticks_for_new_goals_only(plant) -> None:
    xml = '<GoalUpdatedController goal="{g}"><Script code="n += 1"/></GoalUpdatedController>'
    tree = plant(xml, n=0, g="a")
    for goal, count in (("a", 1), ("a", 1), ("b", 2), ("b", 2)):
        tree.ports.blackboard.set("g", goal)
        tree.execute()
        assert tree.ports.blackboard.get("n") == count


def test_path_longer_on_approach_ticks_the_child_for_a_long_way_round(plant) -> None:
    xml = (
        '<PathLongerOnApproach path="{p}" prox_len="9" length_factor="2">'
        "<AlwaysFailure/></PathLongerOnApproach>"
    )
    tree = plant(xml, p=_path(0.0, 1.0, 2.0))
    assert tree.execute() is SUCCESS
    tree.ports.blackboard.set("p", _path(0.0, 1.5, 2.0))
    assert tree.execute() is SUCCESS
    tree.ports.blackboard.set("p", _path(0.0, -3.0, 2.0))
    assert tree.execute() is FAILURE
