"""Pain 12 while everything runs: who stamps with the wall clock is named, once."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.graph import Graph

S = 1_000_000_000
_SCAN = "sensor_msgs/msg/LaserScan"
_TF = "tf2_msgs/msg/TFMessage"


@pytest.fixture
def listener(join: Callable[..., Graph], eventually: Callable[..., Any]) -> Any:
    """A node that uses simulated time, which is 12.5 s, and the messages it logs."""
    graph = join()
    graph.parameters.set("/use_sim_time", True)
    node: Any = graph.create_node("listener")
    node.logged = []
    node.console = lambda record, **_words: node.logged.append(str(record.text))
    simulator = join().create_node("gazebo")
    clock = simulator.create_publisher("/clock", "rosgraph_msgs/msg/Clock")
    eventually(lambda: clock.matched)
    message = clock.message_class()
    message.clock.sec, message.clock.nanosec = 12, S // 2
    clock.publish(message)
    eventually(lambda: node.clock.now_ns() == 12 * S + S // 2)
    return node


def _send(talker: Any, topic: str, kind: str, seconds: int, eventually: Callable[..., Any]) -> None:
    publisher = talker.create_publisher(topic, kind)
    eventually(lambda: publisher.matched)
    message = publisher.message_class()
    stamped = message
    if kind == _TF:
        from gazelle.interfaces import message_type

        stamped = message_type("geometry_msgs/msg/TransformStamped")()
        message.transforms = [stamped]
    stamped.header.stamp.sec = seconds
    publisher.publish(message)


@pytest.mark.parametrize(("topic", "kind"), [("/scan", _SCAN), ("/tf", _TF)])
def test_wall_stamps_are_told_with_the_publishers_name(
    listener: Any,
    join: Callable[..., Any],
    inbox: Any,
    eventually: Callable[..., Any],
    topic: str,
    kind: str,
) -> None:
    listener.create_subscription(topic, kind, inbox)
    talker = join().create_node("driver")
    for _ in range(2):
        _send(talker, topic, kind, int(time.time()), eventually)
    inbox.wait_for(2)
    (text,) = listener.logged
    assert text.startswith(f"/driver stamps {topic} with wall time (")
    assert "while simulated time is 12.500 s [graph.wall-stamps]" in text
    assert "use_sim_time:=true" in text
    assert "extrapolation into the future" in text


@pytest.mark.parametrize("seconds", [0, 12, 13_000, 1_500_000_000])
def test_other_stamps_are_nobodys_fault(
    listener: Any,
    join: Callable[..., Any],
    inbox: Any,
    eventually: Callable[..., Any],
    seconds: int,
) -> None:
    listener.create_subscription("/scan", _SCAN, inbox)
    _send(join().create_node("driver"), "/scan", _SCAN, seconds, eventually)
    inbox.wait_for(1)
    assert listener.logged == []


def test_wall_stamps_are_right_without_simulated_time(
    join: Callable[..., Any], inbox: Any, eventually: Callable[..., Any]
) -> None:
    node, logged = join().create_node("listener"), []
    node.console = lambda record, **_words: logged.append(record.text)
    node.create_subscription("/scan", _SCAN, inbox)
    _send(join().create_node("driver"), "/scan", _SCAN, int(time.time()), eventually)
    inbox.wait_for(1)
    assert logged == []
