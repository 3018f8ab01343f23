"""message_filters for rospy and rclpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.compat.message_filters import (
    ApproximateTimeSynchronizer,
    Cache,
    SimpleFilter,
    TimeSynchronizer,
)
from gazelle.compat.rospy.rostime import Time
from gazelle.interfaces import message_type, ros1_message_type


def _stamped(make: Any, milliseconds: int) -> Any:
    message = make("sensor_msgs/Temperature")(temperature=float(milliseconds))
    if make is message_type:
        message.header.stamp.nanosec = milliseconds * 1_000_000
    else:
        message.header.stamp = Time(0, milliseconds * 1_000_000)
    return message


@pytest.mark.parametrize("make", [ros1_message_type, message_type])
def test_messages_of_one_time_come_together(make: Any) -> None:
    left, right, found = SimpleFilter(), SimpleFilter(), []
    exact = TimeSynchronizer([left, right], 10)
    exact.registerCallback(lambda a, b, word: found.append((a.temperature, word)), "!")
    near: list[Any] = []
    close = ApproximateTimeSynchronizer([left, right], 10, slop=0.003)
    close.registerCallback(lambda a, b: near.append((a.temperature, b.temperature)))
    for stamp in (10, 20, 30):
        left.signalMessage(_stamped(make, stamp))
    for stamp in (12, 20, 40):
        right.signalMessage(_stamped(make, stamp))
    assert found == [(20.0, "!")]
    assert near == [(10.0, 12.0), (20.0, 20.0)]


@pytest.mark.parametrize("make", [ros1_message_type, message_type])
def test_cache_keeps_the_last_messages(make: Any) -> None:
    source = SimpleFilter()
    cache = Cache(source, 3)
    assert cache.getLast() is None and cache.getOldestTime() is None
    for stamp in (10, 30, 20, 40):
        source.signalMessage(_stamped(make, stamp))
    inside = cache.getInterval(Time(0, 20_000_000), Time(0, 30_000_000))
    assert [one.temperature for one in inside] == [20, 30]
    assert cache.getElemBeforeTime(Time(0, 35_000_000)).temperature == 30
    assert cache.getElemAfterTime(Time(0, 35_000_000)).temperature == 40
    assert cache.getElemAfterTime(Time(1)) is None
    assert cache.getLast().temperature == 40
    assert cache.getOldestTime() == Time(0, 20_000_000)
    assert cache.getLastestTime() == Time(0, 40_000_000)


def test_messages_without_header_need_leave(capfd: pytest.CaptureFixture[str]) -> None:
    source, kind = SimpleFilter(), ros1_message_type("std_msgs/Int16")
    Cache(source)
    source.signalMessage(kind(1))
    source.signalMessage(kind(1))
    said = capfd.readouterr().err
    assert said.count("when 'allow_headerless' is disabled") == 1 and "(Int16)" in said


def test_rclpy_subscribers_are_synchronised(passes: Callable[..., Any]) -> None:
    passes(
        """
import rclpy
from message_filters import ApproximateTimeSynchronizer, Cache, Subscriber
from sensor_msgs.msg import Image, Temperature
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('sync')
subs = [Subscriber(node, Temperature, 'temp'), Subscriber(node, Image, 'image', qos_profile=5)]
got = []
ts = ApproximateTimeSynchronizer(subs, 10, 0.1)
ts.registerCallback(lambda t, i: got.append((t.temperature, i.width)))
words = Subscriber(node, String, 'words')
cache = Cache(words, 5, allow_headerless=True)
pubs = [node.create_publisher(kind, name, 10)
        for kind, name in ((Temperature, 'temp'), (Image, 'image'), (String, 'words'))]
assert subs[0].getTopic() == 'temp'
now = node.get_clock().now().to_msg()
first, second = Temperature(temperature=3.0), Image(width=7)
first.header.stamp = second.header.stamp = now
pubs[0].publish(first); pubs[1].publish(second); pubs[2].publish(String(data='x'))
while not got or cache.getLast() is None:
    rclpy.spin_once(node, timeout_sec=1)
assert got == [(3.0, 7)]
assert abs((node.get_clock().now() - cache.getLastestTime()).nanoseconds) < 10e9
subs[0].unregister()
assert node.count_subscribers('temp') == 0
"""
    )
