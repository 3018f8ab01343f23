"""Bags become bags of other formats, and types come along."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.bag import (
    Connection,
    Encoding,
    Storage,
    bag_types,
    create_bag,
    learn_definitions,
    message_class,
    open_bag,
)
from gazelle.bag.conversion import copy_bag
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import exists, from_ros1, ros1_message_type


@pytest.mark.parametrize("middle", ["b.mcap", "b.db3"])
def test_ros1_to_ros2_and_back_is_the_same_bag(
    bag_of: Callable, tmp_path: Path, middle: str
) -> None:
    first = bag_of("a.bag")
    for source, target in (("a.bag", middle), (middle, "c.bag")):
        storage = {".bag": Storage.ROS1, ".mcap": Storage.MCAP, ".db3": Storage.SQLITE}
        writer = create_bag(tmp_path / target, storage[Path(target).suffix])
        diagnostics = Diagnostics()
        copied = copy_bag(open_bag(tmp_path / source), writer, diagnostics=diagnostics)
        writer.close()
        assert (copied.written, copied.left_out, len(diagnostics)) == (100, 0, 0)
    before, after = open_bag(first), open_bag(tmp_path / "c.bag")
    assert [one[1:] for one in after.messages()] == [one[1:] for one in before.messages()]
    for old, new in zip(before.connections, after.connections, strict=True):
        assert (new.topic, new.md5sum, new.latching) == (old.topic, old.md5sum, old.latching)


def test_a_type_that_nothing_defines_is_left_out_and_told(tmp_path: Path) -> None:
    unknown = Connection(0, "/odd", "no_such_msgs/msg/Odd", Encoding.CDR)
    source = create_bag(tmp_path / "a.mcap", Storage.MCAP)
    source.write(source.add(unknown), 5, b"\0\1\0\0")
    source.close()
    target, diagnostics = create_bag(tmp_path / "a.bag", Storage.ROS1), Diagnostics()
    copied = copy_bag(open_bag(tmp_path / "a.mcap"), target, diagnostics=diagnostics)
    target.close()
    assert copied.left_out == 1
    (told,) = diagnostics.by_code("bag.not-converted")
    assert "topic /odd (no_such_msgs/msg/Odd) is left out" in told.message


def test_a_bag_defines_the_types_that_nothing_else_does() -> None:
    text = "bag_only_msgs/Part[] parts\n" + "=" * 80 + "\nMSG: bag_only_msgs/Part\nint32 size\n"
    one = Connection(0, "/whole", "bag_only_msgs/Whole", Encoding.ROS1, text, "1" * 32)
    assert learn_definitions([one]) == ()
    found = from_ros1(message_class(one), b"\2\0\0\0\7\0\0\0\x09\0\0\0")
    assert [part.size for part in found.parts] == [7, 9]
    assert learn_definitions([replace(one, md5sum="2" * 32)]) == ("bag_only_msgs/Whole",)


def test_what_a_bag_defines_is_its_own() -> None:
    text = "int32 size\n"
    one = Connection(0, "/own", "bag_only_msgs/Own", Encoding.ROS1, text, "1" * 32)
    types, differing = bag_types([one])
    assert differing == () and not exists("bag_only_msgs/Own")
    assert from_ros1(message_class(one, types), b"\7\0\0\0").size == 7
    other = replace(one, definition="int16 size\n", md5sum="2" * 32)
    assert from_ros1(message_class(other, bag_types([other]).store), b"\7\0").size == 7
    assert from_ros1(message_class(one, types), b"\7\0\0\0").size == 7


def test_a_bag_keeps_the_classes_of_what_it_defines_as_everybody_does() -> None:
    one = Connection(0, "/own", "std_msgs/Own", Encoding.ROS1, "int32 size\n", "1" * 32)
    types = bag_types([one]).store
    assert types.exists("std_msgs/Own")
    scan = "sensor_msgs/LaserScan"
    assert types.ros1_message_type(scan) is ros1_message_type(scan)
