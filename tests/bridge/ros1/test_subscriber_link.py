"""Connections that carry topics to ROS 1: what a slow subscriber costs."""

from __future__ import annotations

import socket
from typing import Any

import pytest
from tests.bridge.ros1.peer import read_block
from tests.patience import at_most

from gazelle.bridge.ros1.subscriber_link import FrameQueue, SubscriberLink
from gazelle.bridge.ros1.types import Frame, is_ros2_only, message_kind
from gazelle.errors import GazelleError
from gazelle.interfaces import message_type, to_cdr


def frame(size: int, mark: int = 0) -> Frame:
    return Frame(size.to_bytes(4, "little"), memoryview(bytes([mark]) * size))


def test_oldest_frames_are_dropped_when_there_are_too_many() -> None:
    queue = FrameQueue(most_frames=3)
    for mark in range(5):
        queue.put(frame(1, mark))
    got = [queue.take() for _ in range(3)]
    assert [bytes(one.body)[0] for one in got if one] == [2, 3, 4]
    assert queue.dropped == 2


def test_two_frames_wait_however_big_they_are() -> None:
    queue = FrameQueue(most_bytes=10)
    for mark in range(4):
        queue.put(frame(1000, mark))
    assert queue.dropped == 2
    assert [bytes(one.body)[0] for one in (queue.take(), queue.take()) if one] == [2, 3]


def test_closed_queue_lets_go() -> None:
    queue = FrameQueue()
    queue.close()
    assert queue.take() is None


def test_subscriber_that_stands_still_holds_up_nobody() -> None:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        link = SubscriberLink(ours, "/slow", "/image")
        link.start(b"")
        big = frame(1 << 20)
        with at_most(5.0):
            for _ in range(200):
                link.put(big)
        assert link.dropped > 100
        theirs.settimeout(30.0)
        assert read_block(theirs) == bytes(1 << 20)
        link.close()


def test_sequence_replaces_the_headers_first_number() -> None:
    kind = message_kind("sensor_msgs/msg/Image")
    image: Any = message_type("sensor_msgs/msg/Image")(height=1, width=2, data=b"ab", step=2)
    made = kind.to_frame(to_cdr(image), 7)
    data = made.head + bytes(made.body)
    assert int.from_bytes(data[:4], "little") == len(data) - 4
    assert int.from_bytes(data[4:8], "little") == 7
    back = kind.from_bytes(data[4:])
    assert (back.height, back.width, bytes(back.data)) == (1, 2, b"ab")


@pytest.mark.parametrize(
    ("name", "ros1", "wire"),
    [
        ("sensor_msgs/msg/LaserScan", "sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan"),
        ("rcl_interfaces/msg/Log", "rosgraph_msgs/Log", "rcl_interfaces/msg/Log"),
        ("rosgraph_msgs/Log", "rosgraph_msgs/Log", "rcl_interfaces/msg/Log"),
        ("tf/tfMessage", "tf/tfMessage", "tf2_msgs/msg/TFMessage"),
    ],
)
def test_types_have_a_name_on_either_side(name: str, ros1: str, wire: str) -> None:
    kind = message_kind(name)
    assert (kind.ros1_name, kind.wire_name) == (ros1, wire)


def test_what_only_ros2_defines_is_known() -> None:
    assert is_ros2_only("geometry_msgs/msg/VelocityStamped")
    assert not is_ros2_only("geometry_msgs/msg/Twist")
    with pytest.raises(GazelleError, match="odd_msgs/Odd"):
        message_kind("odd_msgs/Odd")
