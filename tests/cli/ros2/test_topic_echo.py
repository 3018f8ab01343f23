"""ros2 topic echo."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from gazelle.graph import Graph, Node
from gazelle.interfaces import Message, fill, message_type

SCAN = "sensor_msgs/msg/LaserScan"


@pytest.fixture
def say(robot: Node) -> Callable[..., Any]:
    """Publishes a latched message: ``say("/topic", kind, field=value)``."""

    def publish(topic: str, kind: str, *, latch: bool = True, **values: Any) -> Message:
        message = message_type(kind)()
        fill(message, values)
        robot.create_publisher(topic, kind, latch=latch).publish(message)
        return message

    return publish


@pytest.fixture
def once(run: Any) -> Callable[..., Any]:
    """Runs ``ros2 topic echo --once …``."""
    return lambda *words: run("ros2", "topic", "echo", "--once", *words)


def test_yaml_csv_flow_and_raw(say: Any, once: Any) -> None:
    say("/point", "geometry_msgs/msg/Point", x=1.0)
    assert once("/point") == (0, "x: 1.0\ny: 0.0\nz: 0.0\n---\n", "")
    assert once("point").out == "x: 1.0\ny: 0.0\nz: 0.0\n---\n"
    assert once("/point", "geometry_msgs/msg/Point", "--csv").out == "1.0,0.0,0.0\n"
    say("/names", "sensor_msgs/msg/JointState", name=["a", "b"])
    assert "name: [a, b]\n" in once("/names", "--flow-style").out
    raw = once("/point", "--raw").out
    assert raw == repr(b"\0\1\0\0\0\0\0\0\0\0\xf0\x3f" + bytes(16)) + "\n---\n"
    assert once("/point", "-c").out.startswith("\x1b[H\x1b[2J\nx: 1.0\n")


def test_fields_and_their_items(say: Any, once: Any) -> None:
    say("/scan", SCAN, ranges=[1.0, 2.0], header={"frame_id": "laser"})
    assert once("/scan", "--field", "header.frame_id").out == "laser\n---\n"
    assert once("/scan", "--field", "ranges").out == "array('f', [1.0, 2.0])\n---\n"
    assert once("/scan", "--field", "ranges[1]").out == "2.0\n---\n"
    assert once("/scan", "--field", "header.stamp").out == "sec: 0\nnanosec: 0\n---\n"
    code, out, error = once("/scan", "--field", "header.frame")
    assert (code, out) == (1, "")
    assert error == (
        "Invalid field 'header.frame': 'Header' object has no attribute 'frame'\n"
        "  did you mean 'frame_id'?\n"
    )
    code, _, error = once("/scan", "--field", "ranges[7]")
    assert code == 1
    assert error.startswith("Invalid field 'ranges[7]': ")


def test_long_arrays_end_with_dots_unless_they_shall_not(say: Any, once: Any) -> None:
    say("/scan", SCAN, ranges=[0.0] * 200)
    assert once("/scan").out.count("- 0.0\n") == 128
    assert once("/scan", "-f").out.count("- 0.0\n") == 200
    assert "ranges:\n- 0.0\n- '...'\n" in once("/scan", "-l", "1").out
    short = once("/scan", "--no-arr", "--no-str").out
    assert "ranges: '<sequence type: float, length: 200>'\n" in short
    assert "frame_id: '<string length: <0>>'\n" in short


def test_filter_chooses_messages(robot: Node, run: Any, when_heard: Any) -> None:
    publisher = robot.create_publisher("/n", "std_msgs/msg/Int32")
    kind = message_type("std_msgs/msg/Int32")

    def publish() -> None:
        for one in range(5):
            publisher.publish(kind(data=one))

    when_heard("/n", publish)
    words = ("/n", "--filter", "m.data > 2", "--once")
    assert run("ros2", "topic", "echo", *words) == (0, "data: 3\n---\n", "")
    assert "is not a Python expression" in run("ros2", "topic", "echo", "/n", "--filter", "a b").err


def test_info_of_the_message_stands_in_front(say: Any, once: Any) -> None:
    say("/n", "std_msgs/msg/Int32", data=7)
    head, text, _ = once("/n", "-i").out.split("---\n")
    assert "publication_sequence_number: 1\n" in head
    assert text == "data: 7\n"
    row = once("/n", "-i", "--csv").out.strip().split(",")
    assert row[2:] == ["1", "None", "7"]


def test_unknown_topic_and_types_are_errors(say: Any, once: Any, run: Any) -> None:
    say("/point", "geometry_msgs/msg/Point")
    code, out, error = run("ros2", "topic", "echo", "/pont")
    assert code == 1
    assert out == "WARNING: topic [/pont] does not appear to be published yet\n"
    assert error == (
        "  did you mean '/point'?\nCould not determine the type for the passed topic\n"
    )
    code, _, error = once("/point", "geometry_msgs/msg/Pont")
    assert code == 1
    assert error.startswith("The passed message type is invalid\n")
    assert "did you mean 'geometry_msgs/msg/Point'" in error


def test_quality_of_service_suits_the_publishers(robot: Node, say: Any, once: Any) -> None:
    say("/map", "std_msgs/msg/Int32", data=1)
    robot.create_publisher("/map", "std_msgs/msg/Int32", reliable=False)
    out = once("/map", "--timeout", "0.2").out
    assert out == (
        "Some, but not all, publishers are offering QoSReliabilityPolicy.RELIABLE. Falling back "
        "to QoSReliabilityPolicy.BEST_EFFORT as it will connect to all publishers\n"
        "Some, but not all, publishers are offering QoSDurabilityPolicy.TRANSIENT_LOCAL. Falling "
        "back to QoSDurabilityPolicy.VOLATILE as it will connect to all publishers\n"
    )


def test_volatile_subscription_does_not_get_what_was_before(say: Any, once: Any) -> None:
    say("/map", "std_msgs/msg/Int32", data=1)
    assert once("/map", "--qos-durability", "volatile", "--timeout", "0.2").out == ""
    assert once("/map", "--qos-durability", "transient_local").out == "data: 1\n---\n"


def test_messages_are_printed_after_the_clock_was_set_back(
    robot: Node, once: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    hour_ns = 3600 * 10**9
    late = SimpleNamespace(time_ns=lambda: time.time_ns() - hour_ns, monotonic=time.monotonic)
    monkeypatch.setattr("gazelle.graph.publisher.time", late)
    publisher = robot.create_publisher("/n", "std_msgs/msg/Int32")
    ended = threading.Event()

    def talk() -> None:
        while not ended.wait(0.01):
            publisher.publish(publisher.message_class(data=7))

    talking = threading.Thread(target=talk)
    talking.start()
    assert once("/n").out == "data: 7\n---\n"
    ended.set()
    talking.join()


def test_incompatible_quality_of_service_is_told(robot: Node, run: Any) -> None:
    robot.create_publisher("/n", "std_msgs/msg/Int32", reliable=False)
    words = ("--qos-reliability", "reliable", "--timeout", "0.1")
    error = run("ros2", "topic", "echo", "/n", *words).err
    assert error.startswith("New publisher discovered on topic '/n', offering incompatible QoS.")
    assert error.endswith("Last incompatible policy: RELIABILITY\n")


def test_echo_ends_with_its_node(graph: Graph, say: Any, run_until: Any) -> None:
    say("/n", "std_msgs/msg/Int32", data=7)
    assert run_until("---", "ros2", "topic", "echo", "/n") == "data: 7\n---\n"


def test_lost_messages_are_told(graph: Graph, robot: Node, capsys: Any) -> None:
    import argparse
    import threading

    from gazelle.cli.ros2.topic.echo import Echo, Selection, add_arguments
    from gazelle.graph import MessageInfo

    robot.create_publisher("/n", "std_msgs/msg/Int32")
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    graph.entities()
    echo = Echo(graph, "/n", Selection(), parser.parse_args(["/n"]), ended=threading.Event())
    message = message_type("std_msgs/msg/Int32")()
    for sequence in (4, 5, 9):
        echo(message, MessageInfo(sequence, 1, "/robot", "std_msgs/msg/Int32"))
    assert capsys.readouterr().out == (
        "data: 0\n---\n" * 2
        + "A message was lost!!!\n\ttotal count change:3\n\ttotal count: 3---\ndata: 0\n---\n"
    )
