"""Bags to read, and the messages that are in them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.bag import BagWriter, Encoding, cdr_connection, create_bag, ros1_connection
from gazelle.bag import storage_of as by_name
from gazelle.bag.rosbag2.metadata import offered_qos
from gazelle.interfaces import ros1_message_type, to_cdr, to_ros1

START_NS = 1_700_000_000_000_000_000
STEP_NS = 10_000_000

Fill = Callable[..., Path]


def point_bytes(place: int, encoding: Encoding) -> bytes:
    """A PointStamped that tells its place in the bag."""
    message = ros1_message_type("geometry_msgs/PointStamped")()
    message.header.frame_id = "map"
    message.point.x = float(place)
    return to_ros1(message) if encoding is Encoding.ROS1 else to_cdr(message)


def fill(writer: BagWriter, count: int = 100) -> None:
    """Write points and strings by turns, one every 10 ms."""
    is_ros1 = writer.encoding is Encoding.ROS1
    if is_ros1:
        points = writer.add(ros1_connection("/point", "geometry_msgs/PointStamped"))
        words = writer.add(
            ros1_connection("/word", "std_msgs/String", callerid="/talker", latching=True)
        )
    else:
        points = writer.add(cdr_connection("/point", "geometry_msgs/msg/PointStamped"))
        words = writer.add(
            cdr_connection("/word", "std_msgs/msg/String", qos=offered_qos(latched=True))
        )
    for place in range(count):
        word = ros1_message_type("std_msgs/String")(data=f"word {place}")
        if place % 2:
            data = to_ros1(word) if is_ros1 else to_cdr(word)
            writer.write(words, START_NS + place * STEP_NS, data)
        else:
            data = point_bytes(place, writer.encoding)
            writer.write(points, START_NS + place * STEP_NS, data)


@pytest.fixture
def bag_of(tmp_path: Path) -> Fill:
    """Makes a bag of 100 messages under a name that tells its format."""

    def make(name: str, count: int = 100, **options: object) -> Path:
        path = tmp_path / name
        storage = options.pop("storage", None) or by_name(path)
        assert isinstance(storage, str)
        writer = create_bag(path, storage, **options)  # type: ignore[arg-type]
        fill(writer, count)
        writer.close()
        return path

    return make
