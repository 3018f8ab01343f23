"""C++ reads and writes the bytes that Python reads and writes."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.cpp.interfaces.message_probe import MessageProbe, RefusedError, filled, own_types

from gazelle.interfaces import RosVersion, from_cdr, to_cdr, to_ros1

TYPES = own_types()
_SOME = settings(
    max_examples=12,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
_SEEDS = st.integers(0, 2**32)


@_SOME
@given(seed=_SEEDS)
def test_cdr_of_ros2_survives(ros2_probe: MessageProbe, seed: int) -> None:
    for name in ros2_probe.names:
        data = to_cdr(filled(TYPES, name, RosVersion.ROS2, Random(seed)))
        assert ros2_probe.cdr(name, data) == data, name


@_SOME
@given(seed=_SEEDS)
def test_cdr_of_ros1_survives(ros1_probe: MessageProbe, seed: int) -> None:
    for name in ros1_probe.names:
        data = to_cdr(filled(TYPES, name, RosVersion.ROS1, Random(seed)))
        assert ros1_probe.cdr(name, data) == data, name


@_SOME
@given(seed=_SEEDS)
def test_ros1s_own_bytes_and_cdr_become_each_other(ros1_probe: MessageProbe, seed: int) -> None:
    for name in ros1_probe.names:
        message = filled(TYPES, name, RosVersion.ROS1, Random(seed))
        data = to_cdr(message)
        assert ros1_probe.cdr_of(name, to_ros1(message)) == data, name
        again = from_cdr(TYPES.class_of(name, RosVersion.ROS1), data)
        assert ros1_probe.ros1_of(name, data) == to_ros1(again), name


@pytest.mark.parametrize("ros_version", RosVersion)
def test_new_messages_hold_the_same_defaults(
    ros_version: RosVersion, ros1_probe: MessageProbe, ros2_probe: MessageProbe
) -> None:
    probe = ros1_probe if ros_version is RosVersion.ROS1 else ros2_probe
    for name in probe.names:
        assert probe.default(name) == to_cdr(TYPES.class_of(name, ros_version)()), name


def test_bytes_of_a_big_endian_sender_are_read(ros2_probe: MessageProbe) -> None:
    name = "unique_identifier_msgs/msg/UUID"
    assert ros2_probe.cdr(name, b"\0\0\0\0" + bytes(range(16)))[4:] == bytes(range(16))
    text = b"\0\0\0\0" + (3).to_bytes(4, "big") + b"hi\0"
    assert ros2_probe.cdr("std_msgs/msg/String", text) == b"\0\1\0\0\3\0\0\0hi\0"


@_SOME
@given(seed=_SEEDS)
def test_bytes_that_end_early_are_refused(ros2_probe: MessageProbe, seed: int) -> None:
    for name in ("sensor_msgs/msg/LaserScan", "tf2_msgs/msg/TFMessage"):
        data = to_cdr(filled(TYPES, name, RosVersion.ROS2, Random(seed)))
        with pytest.raises(RefusedError, match="the bytes end too early"):
            ros2_probe.cdr(name, data[: Random(seed).randrange(4, len(data))])


@_SOME
@given(junk=st.binary(max_size=120))
def test_junk_does_no_harm(ros2_probe: MessageProbe, junk: bytes) -> None:
    for name in ros2_probe.names:
        try:
            ros2_probe.cdr(name, b"\0\1\0\0" + junk)
        except RefusedError as refused:
            assert str(refused)


def test_a_count_beyond_the_bytes_asks_for_no_memory(ros2_probe: MessageProbe) -> None:
    data = b"\0\1\0\0" + (2**32 - 1).to_bytes(4, "little")
    with pytest.raises(RefusedError, match="the bytes end too early"):
        ros2_probe.cdr("tf2_msgs/msg/TFMessage", data)


def test_other_encapsulations_are_refused(ros2_probe: MessageProbe) -> None:
    with pytest.raises(RefusedError, match="plain CDR"):
        ros2_probe.cdr("std_msgs/msg/String", b"\0\3\0\0\1\0\0\0\0")
    with pytest.raises(RefusedError, match="2 bytes are not a std_msgs/msg/String"):
        ros2_probe.cdr("std_msgs/msg/String", b"\0\1")


def test_more_than_a_bound_is_refused(ros2_probe: MessageProbe) -> None:
    message = TYPES.message_type("probe_msgs/Everything")()
    message.short_text = "abcde"
    data = to_cdr(message)
    longer = data.replace(b"\6\0\0\0abcde\0\0\0", b"\7\0\0\0abcdef\0\0")
    with pytest.raises(RefusedError, match="'short_text' has 6 letters, at most 5 are allowed"):
        ros2_probe.cdr("probe_msgs/msg/Everything", longer)
