"""transform and relay_field: expressions on topics and their fields."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from gazelle.errors import LaunchError
from gazelle.graph import Graph
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.topic_tools.transform import run_relay_field, run_transform

_QUATERNION = "geometry_msgs/msg/QuaternionStamped"
_WAIT_S = 30.0


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


@pytest.fixture
def imu(graph: Graph) -> Any:
    """A publisher of ``/imu``."""
    return graph.create_node("imu").create_publisher("/imu", _QUATERNION)


def answer(
    graph: Graph, imu: Any, tool: Callable[..., int], words: list[str], kind: str
) -> tuple[Any, list[str]]:
    """What a tool publishes on ``/out`` for one message, None for nothing, and what it logs."""
    arrived, stop, got, said = threading.Event(), threading.Event(), [], []

    def take(message: Any) -> None:
        got.append(message)
        arrived.set()

    def hear(record: Any) -> None:
        if record.level >= 40:
            said.append(record.msg)
            arrived.set()

    node = graph.create_node("ear")
    node.create_subscription("/out", kind, take)
    node.create_subscription("/rosout", "rcl_interfaces/msg/Log", hear)
    thread = threading.Thread(target=tool, args=(read_arguments(words, "tool"), graph, stop))
    thread.start()
    try:
        assert graph.discovery.wait_for(lambda _known: imu.matched, _WAIT_S)
        message = imu.message_class()
        message.quaternion.x, message.header.frame_id = 3.0, "base"
        imu.publish(message)
        assert arrived.wait(_WAIT_S)
    finally:
        stop.set()
        thread.join()
    return (got[0] if got else None), said


@pytest.mark.parametrize(
    ("source", "expression", "kind", "value"),
    [
        ("/imu/quaternion/x", "m + 1", "std_msgs/Float64", 4.0),
        ("/imu/quaternion", "numpy.linalg.norm([m.x, 4])", "std_msgs/Float64", 5.0),
        ("/imu", "m.header.frame_id", "std_msgs/String", "base"),
        ("imu/header/frame_id", "str(len(m))", "std_msgs/String", "4"),
    ],
)
def test_transform_publishes_what_the_expression_gives(
    graph: Graph, imu: Any, source: str, expression: str, kind: str, value: object
) -> None:
    words = [source, "/out", kind, expression]
    found, _ = answer(graph, imu, run_transform, words, kind)
    assert found.data == value


def test_several_values_fill_the_fields_in_order(graph: Graph, imu: Any) -> None:
    words = ["/imu/quaternion", "/out", "geometry_msgs/Vector3", "math.pi, m.x, 0", "-i", "math"]
    found, _ = answer(graph, imu, run_transform, words, "geometry_msgs/msg/Vector3")
    assert (found.x, found.y, found.z) == (3.141592653589793, 3.0, 0.0)


def test_relay_field_fills_what_the_yaml_names(graph: Graph, imu: Any) -> None:
    yaml = "{header: {stamp: now, frame_id: m.header.frame_id}, point: {x: m.quaternion.x * 2}}"
    words = ["/imu", "/out", "geometry_msgs/PointStamped", yaml]
    found, _ = answer(graph, imu, run_relay_field, words, "geometry_msgs/msg/PointStamped")
    assert (found.header.frame_id, found.point.x) == ("base", 6.0)
    assert found.header.stamp.sec > 0


def test_relay_field_takes_whole_messages(graph: Graph, imu: Any) -> None:
    yaml = "{header: m.header, pose: {orientation: m.quaternion}}"
    words = ["/imu", "/out", "geometry_msgs/PoseStamped", yaml]
    found, _ = answer(graph, imu, run_relay_field, words, "geometry_msgs/msg/PoseStamped")
    assert (found.header.frame_id, found.pose.orientation.x) == ("base", 3.0)


def test_an_expression_that_fails_is_told_with_the_message(graph: Graph, imu: Any) -> None:
    words = ["/imu/quaternion", "/out", "std_msgs/Float64", "m.q"]
    found, said = answer(graph, imu, run_transform, words, "std_msgs/msg/Float64")
    assert found is None
    assert said[0].startswith("'m.q' on /imu/quaternion: AttributeError:")


@pytest.mark.usefixtures("imu")
@pytest.mark.parametrize(
    ("tool", "words", "text"),
    [
        (run_transform, ["/imo", "/o", "std_msgs/Float64", "m"], "(or topic field): /imo"),
        (
            run_transform,
            ["/imu/quaternion/u", "/o", "std_msgs/Float64", "m"],
            "no field named u in geometry_msgs/Quaternion\n  its fields: x, y, z, w",
        ),
        (
            run_relay_field,
            ["/imu/quaternio", "/o", "std_msgs/Header", "{}"],
            "no field named quaternio in geometry_msgs/QuaternionStamped\n  did you mean",
        ),
        (run_transform, ["/imu", "/o", "std_msgs/Flot64", "m"], "ERROR: Wrong output type: "),
        (run_transform, ["/imu", "/o", "std_msgs/Float64", "m +"], "Wrong expression: 'm +'"),
        (run_relay_field, ["/imu", "/o", "std_msgs/Header", "5"], "'5' names no fields of"),
    ],
)
def test_wrong_words_are_named(
    graph: Graph, tool: Callable[..., int], words: list[str], text: str
) -> None:
    with pytest.raises(LaunchError, match=re.escape(text)):
        tool(read_arguments(words, "tool"), graph, threading.Event())
