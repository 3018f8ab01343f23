"""The same as message_rates.cpp, in rospy."""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable

import rospy  # type: ignore[import-not-found]
from sensor_msgs.msg import Image, JointState  # type: ignore[import-not-found]
from std_msgs.msg import UInt32  # type: ignore[import-not-found]


def say(what: str, seconds: list[float]) -> None:
    """Print one measurement."""
    us = sorted(one * 1e6 for one in seconds)
    found = {"p50_us": us[len(us) // 2], "p99_us": us[len(us) * 99 // 100]}
    print(json.dumps({"what": what, **found}), flush=True)


def answer() -> None:
    """Send back what comes, count images."""
    pong = rospy.Publisher("pong", JointState, queue_size=10)
    seen = rospy.Publisher("seen", UInt32, queue_size=10)
    count = [0]

    def on_image(_image: Image) -> None:
        count[0] += 1
        seen.publish(UInt32(count[0]))

    rospy.Subscriber("ping", JointState, pong.publish, queue_size=10, tcp_nodelay=True)
    rospy.Subscriber("image", Image, on_image, queue_size=10)
    print("ready", flush=True)
    rospy.spin()


def ask(rounds: int, images: int) -> None:
    """Measure round trips and images."""
    arrived = threading.Event()

    def on_arrival(_message: object) -> None:
        arrived.set()

    ping = rospy.Publisher("ping", JointState, queue_size=10)
    image = rospy.Publisher("image", Image, queue_size=10)
    pong = rospy.Subscriber("pong", JointState, on_arrival, queue_size=10, tcp_nodelay=True)
    seen = rospy.Subscriber("seen", UInt32, on_arrival, queue_size=10)
    ends = (pong, seen)
    while not (
        ping.get_num_connections()
        and image.get_num_connections()
        and all(one.get_num_connections() for one in ends)
    ):
        time.sleep(0.01)
    time.sleep(1.0)

    def measured(count: int, publish: Callable[[], None]) -> list[float]:
        found = []
        for _ in range(count):
            arrived.clear()
            begin = time.perf_counter()
            publish()
            arrived.wait(10)
            found.append(time.perf_counter() - begin)
        return found

    names = [f"joint_{number}" for number in range(6)]
    values = [0.1 * number for number in range(6)]
    state = JointState(name=names, position=values, velocity=values, effort=values)
    pixels = Image(width=1000, height=1000, step=1000, encoding="mono8", data=bytes(1_000_000))
    measured(rounds // 10, lambda: ping.publish(state))
    say("round trip", measured(rounds, lambda: ping.publish(state)))
    measured(images // 10, lambda: image.publish(pixels))
    say("image of 1 MB", measured(images, lambda: image.publish(pixels)))


rospy.init_node(f"rates_{sys.argv[1]}")
if sys.argv[1] == "answer":
    answer()
else:
    ask(int(sys.argv[2]), int(sys.argv[3]))
