"""ros2 topic hz, bw and delay."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.cli.ros2.topic import hz_bw_delay
from gazelle.cli.ros2.topic.hz_bw_delay import bandwidth_text, rate_text
from gazelle.cli.rostopic.bw import BandwidthMeter
from gazelle.cli.rostopic.hz import RateMeter
from gazelle.graph import Node
from gazelle.interfaces import message_type


@pytest.fixture(autouse=True)
def _often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hz_bw_delay, "_PERIOD_S", 0.02)


def _rate(period_s: float) -> RateMeter:
    meter = RateMeter(10_001)
    for place in range(6):
        meter.add(1.0 + place * period_s)
    return meter


def test_rate_counts_the_gaps() -> None:
    meter = _rate(0.1)
    assert rate_text({"/a": meter}) == (
        "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 5"
    )
    assert rate_text({"/a": meter}) == ""


def test_rates_of_several_topics_are_a_table() -> None:
    assert rate_text({"/a": _rate(0.1), "/bcdefg": _rate(0.5)}) == (
        " topic     rate    min_delta   max_delta   std_dev   window\n"
        "===========================================================\n"
        "/a        10.000   0.100       0.100       0.00000   5     \n"
        "/bcdefg   2.000    0.500       0.500       0.00000   5     \n"
    )


@pytest.mark.parametrize(
    ("size", "text"),
    [
        (100, "400 B/s from 4 messages\n\tMessage size mean: 100 B min: 100 B max: 100 B"),
        (1000, "4.00 KB/s from 4 messages\n\tMessage size mean: 1.00 KB min: 1.00 KB max: 1.00 KB"),
        (
            10**6,
            "4.00 MB/s from 4 messages\n\tMessage size mean: 1.00 MB min: 1.00 MB max: 1.00 MB",
        ),
    ],
)
def test_bandwidth_has_the_unit_of_the_rate(size: int, text: str) -> None:
    meter = BandwidthMeter()
    assert bandwidth_text(meter, 0.0) == ""
    for place in range(4):
        meter.add(1.0 + place / 4, size)
    assert bandwidth_text(meter, 2.0) == text


def test_hz_bw_and_delay_of_a_topic(
    robot: Node, run_until: Any, pump: Callable[[Callable[[], Any]], None]
) -> None:
    kind = message_type("sensor_msgs/msg/JointState")
    publisher = robot.create_publisher("/joints", kind)

    def publish() -> None:
        message = kind()
        message.header.stamp.sec = int(time.time()) - 5
        publisher.publish(message)

    pump(publish)
    assert re.match(
        r"average rate: \d+\.\d{3}\n\tmin: ", run_until("min", "ros2", "topic", "hz", "joints")
    )
    out = run_until("size", "ros2", "topic", "bw", "/joints")
    assert re.match(r"Subscribed to \[/joints\]\n[\d.]+ K?B/s from \d+ messages\n\tMess", out)
    out = run_until("min", "ros2", "topic", "delay", "/joints")
    assert re.search(r"average delay: [56]\.\d{3}\n", out)
    out = run_until("min", "ros2", "topic", "hz", "/joints", "--filter", "m.name == []", "-w", "3")
    assert "average rate: " in out


def test_delay_needs_a_header(robot: Node, run: Any) -> None:
    robot.create_publisher("/n", "std_msgs/msg/Int32")
    code, _, error = run("ros2", "topic", "delay", "/n")
    assert code == 1
    assert error.startswith("msg does not have header")


def test_unpublished_topic_is_waited_for(robot: Node, run_until: Any) -> None:
    out = run_until("yet", "ros2", "topic", "hz", "/nothing")
    assert out == "WARNING: topic [/nothing] does not appear to be published yet\n"
