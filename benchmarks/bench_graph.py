"""Speed of the graph: round trips, images, listing, idle publishers, commands.

Run ``python benchmarks/bench_graph.py``; prints one JSON object per measurement. The peer process
is this file again.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import resource
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type

JOINT_STATE = message_type("sensor_msgs/msg/JointState")
IMAGE = message_type("sensor_msgs/msg/Image")
TEXT = message_type("std_msgs/msg/String")
_EARS = 5


def main() -> None:
    """Measure everything, or be the peer."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3000, help="round trips to measure")
    parser.add_argument("--images", type=int, default=600, help="images to send")
    parser.add_argument("--commands", action="store_true", help="measure the commands alone")
    parser.add_argument("--peer", type=int, default=0, help=argparse.SUPPRESS)
    parser.add_argument("--crowd", type=int, default=0, help=argparse.SUPPRESS)
    parser.add_argument("--ear", type=int, default=0, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.ear:
        _be_ear(options.ear)
        return
    if options.peer:
        _be_peer(options.peer, options.crowd)
        return
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    started = time.perf_counter()
    with Graph.open(port=port, environ={}, role="hub") as graph:
        _say("open first", ms=(time.perf_counter() - started) * 1e3)
        if options.commands:
            _bench_commands(graph)
            return
        node = graph.create_node("bench")
        _bench_idle(node)
        _bench_local(node)
        _bench_fan_out(node)
        with subprocess.Popen(
            [sys.executable, __file__, "--peer", str(port)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as peer:
            assert peer.stdout is not None
            peer.stdout.readline()
            _bench_round_trip(node, options.rounds, period_s=0.001)
            _bench_images(node, options.images)
            _bench_listing(node, port)
            peer.communicate("\n")
        _bench_commands(graph)


def _be_peer(port: int, crowd: int) -> None:
    with Graph.open(port=port, environ={}) as graph:
        if crowd:
            _add_nodes(graph, crowd)
            print("ready", flush=True)
            sys.stdin.readline()
            return
        node = graph.create_node("peer")
        pong = node.create_publisher("pong", JOINT_STATE)
        node.create_subscription("ping", JOINT_STATE, pong.publish)
        count = [0]
        seen = node.create_publisher("seen", "std_msgs/msg/UInt32")

        def on_image(_message: Any) -> None:
            count[0] += 1
            seen.publish(seen.message_class(data=count[0]))

        node.create_subscription("image", IMAGE, on_image)
        print("ready", flush=True)
        sys.stdin.readline()


def _bench_idle(node: Node) -> None:
    publisher = node.create_publisher("nobody", JOINT_STATE)
    message = _joint_state()
    _say("publish, nobody listens", us=_per_call_us(lambda: publisher.publish(message)))
    _say("matched, nobody listens", us=_per_call_us(lambda: publisher.matched))


def _bench_local(node: Node) -> None:
    publisher = node.create_publisher("local", JOINT_STATE)
    got: list[Any] = []
    node.create_subscription("local", JOINT_STATE, got.append, inline=True)
    message = _joint_state()
    _say("publish to an inline subscription", us=_per_call_us(lambda: publisher.publish(message)))


def _bench_round_trip(node: Node, rounds: int, period_s: float) -> None:
    arrived = threading.Event()
    ping = node.create_publisher("ping", JOINT_STATE)
    node.create_subscription("pong", JOINT_STATE, lambda _message: arrived.set())
    _await_match(ping)
    message, times = _joint_state(), []
    due = time.perf_counter()
    for _ in range(rounds):
        arrived.clear()
        start = time.perf_counter()
        ping.publish(message)
        assert arrived.wait(5)
        times.append(time.perf_counter() - start)
        due += period_s
        time.sleep(max(0.0, due - time.perf_counter()))
    p50, p99 = np.percentile(times, [50, 99]) * 1e6
    _say("JointState round trip at 1 kHz", p50_us=p50, p99_us=p99)


def _bench_images(node: Node, count: int) -> None:
    """Send with at most four on the way, so none is dropped."""
    credit = threading.Semaphore(4)
    image = node.create_publisher("image", IMAGE)
    node.create_subscription("seen", None, lambda _message: credit.release())
    _await_match(image)
    pixels = np.zeros(640 * 480 * 3, np.uint8)
    message = IMAGE(height=480, width=640, step=1920, encoding="rgb8", data=pixels)
    start = time.perf_counter()
    for _ in range(count):
        assert credit.acquire(timeout=5)
        image.publish(message)
    _say("0.9 MB images", per_second=count / (time.perf_counter() - start))


def _bench_fan_out(node: Node, seconds: int = 10, rate_hz: int = 30) -> None:
    """Send a camera's images to five processes and count what they saw."""
    seen: dict[str, int] = {}
    ended = threading.Semaphore(0)

    def count(message: Any) -> None:
        name, _, number = message.data.partition(" ")
        seen[name] = int(number)
        ended.release()

    camera, end = node.create_publisher("camera", IMAGE), node.create_publisher("end", TEXT)
    node.create_subscription("counted", TEXT, count)
    pixels = np.zeros(640 * 480 * 3, np.uint8)
    message = IMAGE(height=480, width=640, step=1920, encoding="rgb8", data=pixels)
    words = [sys.executable, __file__, "--ear", str(node.graph.port)]
    ears = [subprocess.Popen(words) for _ in range(_EARS)]
    pause = threading.Event()
    while min(camera.subscription_count, end.subscription_count) < _EARS:
        pause.wait(0.05)
    due = time.perf_counter()
    for _ in range(seconds * rate_hz):
        camera.publish(message)
        due += 1 / rate_hz
        pause.wait(max(0.0, due - time.perf_counter()))
    end.publish(TEXT())
    for ear in ears:
        ended.acquire(timeout=10)
        ear.wait(10)
    sent = seconds * rate_hz
    _say("0.9 MB images at 30 Hz to five", sent=sent, lost=sum(sent - n for n in seen.values()))


def _be_ear(port: int) -> None:
    images, done = [0], threading.Event()

    def take(_message: Any) -> None:
        images[0] += 1

    with Graph.open(port=port, environ={}) as graph:
        node = graph.create_node(f"ear{os.getpid()}")
        counted = node.create_publisher("counted", TEXT)
        node.create_subscription("end", TEXT, lambda _message: done.set())
        node.create_subscription("camera", IMAGE, take)
        done.wait()
        time.sleep(0.5)
        counted.publish(TEXT(data=f"{os.getpid()} {images[0]}"))
        time.sleep(0.5)


def _bench_listing(node: Node, port: int) -> None:
    for number in range(100):
        node.create_publisher(f"topic{number}", JOINT_STATE)
    times = []
    for _ in range(10):
        start = time.perf_counter()
        with Graph.open(port=port, environ={}, role="client") as client:
            assert len(client.topics()) > 100
            times.append(time.perf_counter() - start)
    _say("join as client and list 100 topics", ms=float(np.median(times)) * 1e3)


def _add_nodes(graph: Graph, crowd: int) -> None:
    """Make five nodes that publish to and hear those of the next process."""
    for number in range(5):
        node = graph.create_node(f"node{crowd}_{number}")
        for topic in range(4):
            node.create_publisher(f"crowd{crowd}_{number}_{topic}", JOINT_STATE)
            node.create_subscription(f"crowd{crowd % 10 + 1}_{number}_{topic}", None, print)


def _bench_commands(graph: Graph) -> None:
    """Time commands with 50 nodes in ten processes: the best of seven, and computing time."""
    with contextlib.ExitStack() as stack:
        for crowd in range(2, 11):
            words = [sys.executable, __file__, "--peer", str(graph.port), "--crowd", str(crowd)]
            peer = stack.enter_context(
                subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
            )
            stack.callback(peer.communicate, "\n")
            assert peer.stdout is not None
            assert peer.stdout.readline()
        _add_nodes(graph, 1)
        for command in ("rostopic list", "rosnode list", "rosservice list", "ros2 topic list"):
            runs = [_command(command.split(), graph.port) for _ in range(7)]
            _say(f"{command}, 50 nodes", s=min(runs)[0], computing_s=min(run[1] for run in runs))


def _command(words: list[str], port: int) -> tuple[float, float]:
    """Return a command's seconds, by the clock and of computing."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "gazelle.cli", *words],
        env={**os.environ, "GAZELLE_PORT": str(port)}, check=True, stdout=subprocess.DEVNULL,
    )  # fmt: skip
    seconds, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _await_match(publisher: Any) -> None:
    pause = threading.Event()
    while not publisher.matched:
        pause.wait(0.005)


def _joint_state() -> Any:
    names = [f"joint_{number}" for number in range(6)]
    return JOINT_STATE(name=names, position=np.zeros(6), velocity=np.zeros(6), effort=np.zeros(6))


def _per_call_us(call: Callable[[], Any], count: int = 20_000) -> float:
    start = time.perf_counter()
    for _ in range(count):
        call()
    return (time.perf_counter() - start) / count * 1e6


def _say(what: str, **figures: float) -> None:
    print(json.dumps({"what": what} | {key: round(value, 2) for key, value in figures.items()}))


if __name__ == "__main__":
    main()
