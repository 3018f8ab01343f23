"""The nodes of the wikis' first tutorials, of both generations, each a process of its own."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster
from gazelle.interfaces import message_type

pytestmark = pytest.mark.tutorial

NODES = Path(__file__).parents[1] / "compat" / "tutorial_nodes"
BOTH = pytest.mark.parametrize("ros_version", ["ros1", "ros2"])

Start = Callable[..., Any]


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """The graph, carried by the test."""
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


@pytest.fixture
def start(gazelle: Callable[..., Any]) -> Start:
    """Starts a node by generation and name."""

    def run(ros_version: str, name: str, *words: str) -> Any:
        file = NODES / ros_version / f"{name}.py"
        return gazelle(
            str(file), *words, module="gazelle.compat.script_runner", PYTHONUNBUFFERED="1"
        )

    return run


@BOTH
def test_listener_hears_what_the_talker_says(start: Start, ros_version: str) -> None:
    talker, listener = start(ros_version, "talker"), start(ros_version, "listener")
    if ros_version == "ros1":
        line = listener.wait_for_line(r"I heard hello world")
        assert re.search(
            r"\[INFO\] \[\d+\.\d+\]: /listener_\S+_\d+_\d+I heard hello world \d+", line
        )
        talker.wait_for_line(r"\[INFO\] \[\d+\.\d+\]: hello world \d+")
    else:
        line = listener.wait_for_line(r"I heard")
        assert re.search(r'\[minimal_subscriber\]: I heard: "Hello World: \d+"', line)
        talker.wait_for_line(r'\[minimal_publisher\]: Publishing: "Hello World: 1"')
    assert (talker.stop(), listener.stop()) == (0, 0), talker.text + listener.text


@BOTH
def test_server_adds_two_numbers(start: Start, ros_version: str) -> None:
    server = start(ros_version, "add_two_ints_server")
    client = start(ros_version, "add_two_ints_client", "41", "1")
    assert client.wait() == 0, client.text
    wanted = "41 + 1 = 42" if ros_version == "ros1" else "Result of add_two_ints: 42"
    assert wanted in client.text
    told = "Returning [41 + 1 = 42]" if ros_version == "ros1" else "Incoming request a: 41 b: 1"
    server.wait_for_line(re.escape(told))


@BOTH
def test_turtle_follows_by_tf(start: Start, graph: Graph, ros_version: str) -> None:
    params = {"ros1": ["_turtle:=turtle1"], "ros2": ["--ros-args", "-p", "turtlename:=turtle1"]}
    node = graph.create_node("test", rosout=False)
    frame = StampedPose("world", "turtle2", 0, Pose((1.0, 2.0, 0.0)))
    StaticTransformBroadcaster(node).send(frame)
    steering: list[Any] = []
    node.create_subscription(
        "/turtle2/cmd_vel", message_type("geometry_msgs/Twist"), steering.append
    )
    where = message_type("turtlesim/Pose")
    poses = node.create_publisher("/turtle1/pose", where)
    start(ros_version, "tf_broadcaster", *params[ros_version])
    listener = start(ros_version, "tf_listener")

    def steered() -> bool:
        poses.publish(where(x=4.0, y=6.0, theta=0.5))
        # (4, 6) is 5 m from (1, 2): half of that is the speed.
        return bool(steering) and steering[-1].linear.x == pytest.approx(2.5)

    listener.eventually(steered)
    assert steering[-1].angular.z > 0


@BOTH
def test_goal_is_counted_to_its_result(start: Start, ros_version: str) -> None:
    server = start(
        ros_version, "fibonacci_server", *(["__name:=fibonacci"] * (ros_version == "ros1"))
    )
    client = start(ros_version, "fibonacci_client")
    assert client.wait() == 0, client.text + server.text
    numbers = "0, 1, 1, 2, 3, 5, 8, 13, 21"
    wanted = f"Result: {numbers}" if ros_version == "ros1" else f"Result: [{numbers}]"
    assert wanted in client.text
    if ros_version == "ros2":
        assert "Goal accepted :)" in client.text and "Received feedback of 9 numbers" in client.text
    else:
        server.wait_for_line("/fibonacci: Succeeded")
