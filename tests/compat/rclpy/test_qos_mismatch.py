"""Qualities of service that do not fit, between processes (rviz#1122): in ROS 2 nothing arrives.

Here the message arrives, and each side is told once, in the words of rclpy.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

_LISTENER = """
import rclpy
from rclpy.qos import *
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('listener')
got = []
node.create_subscription(String, 'map', got.append, QoSProfile(depth=1, {wanted}))
print('listens', flush=True)
while not got:
    rclpy.spin_once(node, timeout_sec=0.05)
print('got', got[0].data, flush=True)
rclpy.spin(node)
"""
_TALKER = """
import rclpy
from rclpy.qos import *
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('talker')
pub = node.create_publisher(String, 'map', QoSProfile(depth=1, {offered}))
node.create_timer(0.1, lambda: pub.publish(String(data='a map')))
rclpy.spin(node)
"""
_REST = "in ROS 2 (here they are). Last incompatible policy: "


@pytest.mark.parametrize(
    ("offered", "wanted", "policy"),
    [
        (
            "reliability=ReliabilityPolicy.BEST_EFFORT",
            "reliability=ReliabilityPolicy.RELIABLE",
            "RELIABILITY",
        ),
        (
            "durability=DurabilityPolicy.VOLATILE",
            "durability=DurabilityPolicy.TRANSIENT_LOCAL",
            "DURABILITY",
        ),
    ],
    ids=["reliability", "durability"],
)
def test_the_message_arrives_and_each_side_is_warned_once(
    program: Callable[..., Any], offered: str, wanted: str, policy: str
) -> None:
    listener = program(_LISTENER.format(wanted=wanted))
    listener.wait_for_line("listens")
    talker = program(_TALKER.format(offered=offered))
    listener.wait_for_line("got a map")
    talker.wait_for_line("incompatible QoS")
    listener.wait_for_line("incompatible QoS")
    listener.stop()
    talker.stop()
    _warned_once(
        listener.lines,
        "[listener]: New publisher discovered on topic 'map', offering incompatible QoS. "
        f"No messages will be received from it {_REST}{policy}",
    )
    _warned_once(
        talker.lines,
        "[talker]: New subscription discovered on topic 'map', requesting incompatible QoS. "
        f"No messages will be sent to it {_REST}{policy}",
    )


def _warned_once(lines: list[str], sentence: str) -> None:
    warnings = [line for line in lines if "incompatible QoS" in line]
    assert len(warnings) == 1, lines
    assert warnings[0].startswith("[WARN] "), lines
    assert warnings[0].endswith(sentence), lines


def test_what_fits_is_not_warned_of(program: Callable[..., Any]) -> None:
    listener = program(_LISTENER.format(wanted="reliability=ReliabilityPolicy.BEST_EFFORT"))
    listener.wait_for_line("listens")
    talker = program(_TALKER.format(offered="durability=DurabilityPolicy.TRANSIENT_LOCAL"))
    listener.wait_for_line("got a map")
    listener.stop()
    talker.stop()
    assert "QoS" not in listener.text + talker.text
