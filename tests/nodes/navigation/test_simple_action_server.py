"""One goal at a time: newer goals, cancelling, both generations."""

from __future__ import annotations

import pytest

from gazelle.graph.actions import ActionClient
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer

_TYPES = {1: "move_base_msgs/MoveBase", 2: "nav2_msgs/Wait"}


@pytest.fixture(params=[1, 2])
def pair(bench, request):
    server = SimpleActionServer(
        bench.node, "work", _TYPES[request.param], ros_version=request.param
    )
    client = ActionClient(bench.node, "work", _TYPES[request.param])
    client.require_server(10.0)
    yield server, client
    server.close()


def test_goal_is_taken_and_ends(bench, pair) -> None:
    server, client = pair
    goal = client.send_goal()
    assert server.wait(10.0)
    assert server.take() is server.current
    assert not server.should_end
    server.succeed(text="done")
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "SUCCEEDED"
    assert server.current is None


def test_newer_goal_ends_the_older_one(bench, pair) -> None:
    server, client = pair
    first = client.send_goal()
    assert server.wait(10.0)
    server.take()
    second = client.send_goal()
    bench.eventually(lambda: server.has_new)
    assert server.should_end
    server.take()
    bench.eventually(lambda: first.is_done)
    assert first.status.name in ("PREEMPTED", "ABORTED")
    server.succeed()
    bench.eventually(lambda: second.is_done)
    assert second.status.name == "SUCCEEDED"


def test_goal_that_waits_is_replaced_too(bench, pair) -> None:
    server, client = pair
    goals = [client.send_goal() for _ in range(3)]
    bench.eventually(lambda: goals[0].is_done and goals[1].is_done)
    assert server.has_new
    server.take()
    server.succeed()
    bench.eventually(lambda: goals[2].is_done)
    assert goals[2].status.name == "SUCCEEDED"


def test_cancelling_is_seen_and_answered(bench, pair) -> None:
    server, client = pair
    goal = client.send_goal()
    assert server.wait(10.0)
    server.take()
    goal.cancel()
    bench.eventually(lambda: server.is_cancelled)
    server.cancel()
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name in ("PREEMPTED", "CANCELED")


def test_goal_that_waits_is_cancelled_without_an_error(bench, pair) -> None:
    """Trees of Nav2 halt as soon as they have sent a goal."""
    server, client = pair
    said = bench.listen("/rosout", "rosgraph_msgs/msg/Log")
    goal = client.send_goal()
    assert server.wait(10.0)
    goal.cancel()
    if server.take() is not None:  # ROS 2: it is canceling until somebody ends it
        bench.eventually(lambda: server.is_cancelled)
        server.cancel()
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name in ("RECALLED", "PREEMPTED", "CANCELED")
    assert not [one.msg for one in said if one.level >= 8]


def test_cancelled_goal_that_waits_makes_room_for_a_newer_one(bench, pair) -> None:
    server, client = pair
    first = client.send_goal()
    assert server.wait(10.0)
    first.cancel()
    second = client.send_goal()
    bench.eventually(lambda: first.is_done)
    bench.eventually(lambda: server.take() or server.current)
    server.succeed()
    bench.eventually(lambda: second.is_done)
    assert second.status.name == "SUCCEEDED"


def test_goals_are_refused_for_a_reason(bench, pair) -> None:
    server, client = pair
    server.refuse("the navigator is not active")
    goal = client.send_goal()
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "REJECTED"
    assert server.current is None
