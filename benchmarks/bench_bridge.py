"""Speed of the bridge to ROS 2: round trips through it and a real node of rclpy, and images.

Run ``python benchmarks/bench_bridge.py --python PATH`` with the Python that has ``rclpy`` and the
packages sensor_msgs and std_msgs; prints one JSON object per measurement.
"""

from __future__ import annotations

import argparse
import json
import os
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import psutil

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type

JOINT_STATE = message_type("sensor_msgs/msg/JointState")
IMAGE = message_type("sensor_msgs/msg/Image")
IMAGE_HZ = 30

PEER = """
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Image, JointState
rclpy.init(args=[])
node = Node("peer")
pong = node.create_publisher(JointState, "pong", 10)
back = node.create_publisher(Image, "image_back", 10)
node.create_subscription(JointState, "ping", pong.publish, 10)
node.create_subscription(Image, "image", back.publish, 10)
rclpy.spin(node)
"""


def main() -> None:
    """Measure everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--python", default=sys.executable, help="the Python that has rclpy")
    parser.add_argument("--rounds", type=int, default=1000, help="round trips to measure")
    parser.add_argument("--images", type=int, default=300, help="images to send")
    options = parser.parse_args()
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    environ = {
        **os.environ,
        "GAZELLE_PORT": str(port),
        "ROS_DOMAIN_ID": "97",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    with Graph.open(port=port, environ={"ROS_DOMAIN_ID": "97"}, role="hub") as graph:
        node = graph.create_node("bench")
        with _running(options.python, environ) as bridge:
            _bench_round_trip(node, bridge, options.rounds, period_s=0.01)
            _bench_images(node, bridge, options.images)
            _bench_idle(bridge)


@contextmanager
def _running(python: str, environ: dict[str, str]) -> Iterator[psutil.Process]:
    """The bridge and the peer."""
    words = [sys.executable, "-m", "gazelle.cli", "bridge", "ros2", "--python", python]
    started = time.perf_counter()
    with (
        subprocess.Popen(words, env=environ, stdout=subprocess.PIPE, text=True) as bridge,
        subprocess.Popen([python, "-c", PEER], env=environ) as peer,
    ):
        assert bridge.stdout is not None
        bridge.stdout.readline()
        _say("start", s=time.perf_counter() - started)
        try:
            yield psutil.Process(bridge.pid)
        finally:
            peer.kill()
            bridge.terminate()


def _bench_round_trip(node: Node, bridge: psutil.Process, rounds: int, period_s: float) -> None:
    arrived = threading.Event()
    ping = node.create_publisher("/ping", JOINT_STATE)
    node.create_subscription("/pong", JOINT_STATE, lambda _message: arrived.set())
    names = [f"joint_{number}" for number in range(6)]
    numbers = [0.1] * 6
    message = JOINT_STATE(name=names, position=numbers, velocity=numbers, effort=numbers)
    while not arrived.wait(0.1):
        ping.publish(message)
    time.sleep(1.0)
    times, lost, busy_s = [], 0, _busy_s(bridge)
    due = begun = time.perf_counter()
    for _ in range(rounds):
        arrived.clear()
        start = time.perf_counter()
        ping.publish(message)
        if arrived.wait(1):
            times.append(time.perf_counter() - start)
        else:
            lost += 1
        due += period_s
        time.sleep(max(0.0, due - time.perf_counter()))
    load = (_busy_s(bridge) - busy_s) / (time.perf_counter() - begun)
    p50, p99 = np.percentile(times, [50, 99]) * 1e3
    _say("JointState round trip at 100 Hz", p50_ms=p50, p99_ms=p99, lost=lost, cpu=load)


def _bench_images(node: Node, bridge: psutil.Process, count: int) -> None:
    got: set[int] = set()
    times: dict[int, float] = {}
    taken: list[float] = []

    def on_image(message: Any) -> None:
        number = int(message.header.stamp.sec)
        if number not in got and number in times:
            taken.append(time.perf_counter() - times[number])
        got.add(number)

    image = node.create_publisher("/image", IMAGE)
    node.create_subscription("/image_back", IMAGE, on_image)
    pixels = np.zeros(640 * 480 * 3, np.uint8)
    message = IMAGE(height=480, width=640, step=1920, encoding="rgb8", data=pixels)
    while not got:
        image.publish(message)
        time.sleep(0.1)
    time.sleep(1.0)
    busy_s = _busy_s(bridge)
    due = begun = time.perf_counter()
    for number in range(1, count + 1):
        message = IMAGE(height=480, width=640, step=1920, encoding="rgb8", data=pixels)
        message.header.stamp.sec = number
        times[number] = time.perf_counter()
        image.publish(message)
        due += 1 / IMAGE_HZ
        time.sleep(max(0.0, due - time.perf_counter()))
    load = (_busy_s(bridge) - busy_s) / (time.perf_counter() - begun)
    time.sleep(1.0)
    lost = count - len(got - {0})
    p50 = float(np.median(taken)) * 1e3
    _say("640x480 images there and back at 30 Hz", sent=count, lost=lost, p50_ms=p50, cpu=load)


def _bench_idle(bridge: psutil.Process) -> None:
    busy_s, begun = _busy_s(bridge), time.perf_counter()
    time.sleep(5.0)
    _say("idle", cpu=(_busy_s(bridge) - busy_s) / (time.perf_counter() - begun))


def _busy_s(bridge: psutil.Process) -> float:
    """Processor time of both halves."""
    found = [one.cpu_times() for one in (bridge, *bridge.children())]
    return sum(one.user + one.system for one in found)


def _say(what: str, **numbers: float) -> None:
    print(json.dumps({"what": what, **{k: round(v, 3) for k, v in numbers.items()}}), flush=True)


if __name__ == "__main__":
    main()
