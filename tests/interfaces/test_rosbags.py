"""The same bytes, sums and hashes as another implementation and as recorded programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore
from tests.shared_files import SHARED, shared_cases

from gazelle.interfaces import (
    Duration,
    RosVersion,
    Time,
    from_cdr,
    from_ros1,
    md5sum,
    message_type,
    ros1_message_type,
    show_message,
    show_service,
    to_cdr,
    to_ros1,
    type_hash,
)
from gazelle.interfaces.definition import FORMATS, NUMPY_NAMES, Array, attribute_name

RECORDED = Path(__file__).parents[1] / "workspaces/recorded/ros1"
pytestmark = pytest.mark.reference
STORES = {
    RosVersion.ROS1: get_typestore(Stores.ROS1_NOETIC),
    RosVersion.ROS2: get_typestore(Stores.ROS2_JAZZY),
}
OTHERS = ("rmw_dds_common", "rosbag2_interfaces")
TIMES = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")


def _names(ros_version: RosVersion) -> list[str]:
    return [
        name
        for name in STORES[ros_version].fielddefs
        if name.split("/")[0] not in OTHERS
        and not (ros_version is RosVersion.ROS1 and name in TIMES)
    ]


def _peer(message: Any, ros_version: RosVersion) -> Any:
    """The same values in rosbags' class."""
    cls = STORES[ros_version].types[message.TYPE_NAME]
    if not message.FIELDS and ros_version is RosVersion.ROS2:
        return cls(structure_needs_at_least_one_member=0)
    values = {
        attribute_name(item.name): _peer_value(
            getattr(message, attribute_name(item.name)), item.type, ros_version
        )
        for item in message.FIELDS
    }
    return cls(**values)


def _peer_value(value: Any, kind: Any, ros_version: RosVersion) -> Any:
    if isinstance(value, Time | Duration):
        cls = STORES[ros_version].types[f"builtin_interfaces/msg/{type(value).__name__}"]
        return cls(value.secs, value.nsecs)
    if hasattr(value, "FIELDS"):
        return _peer(value, ros_version)
    if kind.array is not Array.ONE and kind.base in FORMATS:
        name = "i1" if kind.base == "byte" else NUMPY_NAMES[FORMATS[kind.base]]
        return np.frombuffer(value, "u1") if isinstance(value, bytes) else np.array(value, name)
    if isinstance(value, list):
        return [_peer_value(item, kind, ros_version) for item in value]
    return value


@pytest.mark.parametrize("seed", range(3))
def test_cdr_bytes_equal_rosbags_of_every_type_both_have(seed, make_message):
    store = STORES[RosVersion.ROS2]
    for name in _names(RosVersion.ROS2):
        message = make_message(name, RosVersion.ROS2, seed)
        peer = _peer(message, RosVersion.ROS2)
        assert to_cdr(message) == bytes(store.serialize_cdr(peer, name)), name
        big_endian = bytes(store.serialize_cdr(peer, name, little_endian=False))
        assert from_cdr(type(message), big_endian) == message, name


@pytest.mark.parametrize("seed", range(3))
def test_ros1_bytes_equal_rosbags_of_every_type_both_have(seed, make_message):
    store = STORES[RosVersion.ROS1]
    for name in _names(RosVersion.ROS1):
        message = make_message(name, RosVersion.ROS1, seed)
        expected = bytes(store.serialize_ros1(_peer(message, RosVersion.ROS1), name))
        assert to_ros1(message) == expected, name


def test_md5_sums_of_all_noetic_messages_are_equal():
    names = _names(RosVersion.ROS1)
    different = [
        name
        for name in names
        if md5sum(name) != STORES[RosVersion.ROS1].generate_msgdef(name, ros_version=1)[1]
    ]
    assert not different
    assert len(names) > 150


def test_type_hashes_of_all_jazzy_messages_are_equal():
    # rosbags hashes char as its own type; rosidl turns it into uint8 (see the published ones)
    own = {"std_msgs/msg/Char", "service_msgs/msg/ServiceEventInfo"}
    names = [name for name in _names(RosVersion.ROS2) if name not in own]
    hashes = STORES[RosVersion.ROS2]
    assert [name for name in names if type_hash(name) != hashes.hash_rihs01(name)] == []


@pytest.mark.parametrize("folder", [RECORDED, *shared_cases(SHARED / "oracles/ros_live")])
def test_recorded_bags_are_read_and_written_back_byte_by_byte(folder):
    for bag in ("t.bag", "tf.bag"):
        assert _written_back(folder / bag) > 0


def _written_back(bag):
    """Return how many messages of a bag are the same again."""
    count = 0
    with Reader(bag) as reader:
        for connection, _, data in reader.messages():
            view = ros1_message_type(connection.msgtype)
            assert view._md5sum == connection.digest
            for cls in (view, message_type(connection.msgtype)):
                again = to_ros1(from_ros1(cls, data))
                if cls is view or not view._has_header:
                    assert again == bytes(data)
                assert len(again) == len(data)
            count += 1
    return count


@pytest.mark.parametrize("folder", [RECORDED, *shared_cases(SHARED / "oracles/ros_live")])
def test_rosmsg_outputs_match_the_recorded_ones(folder):
    assert _output(folder / "msg_show.txt") == show_message("sensor_msgs/JointState").strip()
    assert _output(folder / "srv_show.txt") == show_service("std_srvs/SetBool").strip()
    assert _output(folder / "msg_md5.txt") == md5sum("sensor_msgs/LaserScan")


def _output(path: Any) -> str:
    text = path.read_text(encoding="utf-8")
    return text.split("[stdout]\n")[1].split("[stderr]")[0].strip()
