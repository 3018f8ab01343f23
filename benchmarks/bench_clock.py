"""What it costs nodes to follow a clock of 1 kHz, by messages and by the page that shows it.

Run ``python benchmarks/bench_clock.py``; prints one JSON object per measurement: of each kind of
node the processor time in ms a second, and how much a timer's periods vary, in either time.
The clock runs as the simulator's does, four steps at a time. It and the nodes are this file again.
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
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.graph import Graph
from gazelle.graph.shared_clock_discovery import share_clock
from gazelle.interfaces import message_type

CLOCK = message_type("rosgraph_msgs/msg/Clock")
STEP_NS = 1_000_000
STEPS_AT_ONCE = 4
NODES = ("idle", "rospy rate", "rclpy timer")


def main() -> None:
    """Measure everything, or be the clock or a node."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0, help="how long each is measured")
    parser.add_argument("--factor", type=float, default=1.0, help="of real time")
    parser.add_argument("--hz", type=float, default=100.0, help="of rates and timers")
    parser.add_argument("--paused", action="store_true", help="the clock stands still")
    parser.add_argument("--be", default="", help=argparse.SUPPRESS)
    parser.add_argument("--shares", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.be == "clock":
        _be_clock(options)
    elif options.be:
        _be_node(options.be, options.seconds, options.hz)
    else:
        _measure(options)


def _measure(options: argparse.Namespace) -> None:
    found: dict[tuple[str, str], dict[str, float]] = {}
    for way in ("messages", "page"):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        os.environ["GAZELLE_PORT"] = str(port)
        with Graph.open(port=port, role="hub") as graph:
            graph.parameters.set("/use_sim_time", True)
            graph.clock.use(False)
            words = ["--factor", str(options.factor)] + ["--paused"] * options.paused
            clock = _start("clock", *words, *["--shares"] * (way == "page"))
            for node in NODES:
                one = _start(node, "--seconds", str(options.seconds), "--hz", str(options.hz))
                assert one.stdout is not None
                found[way, node] = json.loads(one.stdout.readline())
                one.wait(30)
                _say(f"{node}, {way}", **found[way, node])
            assert clock.stdin is not None
            clock.stdin.close()
            assert clock.stdout is not None
            _say(f"clock, {way}", **json.loads(clock.stdout.readline()))
            clock.wait(30)
    for node in NODES:
        before, after = (found[way, node]["cpu_ms_per_s"] for way in ("messages", "page"))
        _say(f"{node}, page over messages", ratio=after / before)


def _start(what: str, *words: str) -> subprocess.Popen[str]:
    # Nodes find rospy and rclpy as those of a launch do.
    runner = [] if what == "clock" else ["-m", "gazelle.compat.script_runner"]
    return subprocess.Popen(
        [sys.executable, *runner, __file__, "--be", what, *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


def _be_clock(options: argparse.Namespace) -> None:
    ended = threading.Event()

    def listen() -> None:
        sys.stdin.read()
        ended.set()

    threading.Thread(target=listen, daemon=True).start()
    with Graph.open() as graph:
        graph.clock.use(False)
        clock = graph.create_node("clock").create_publisher("/clock", CLOCK)
        shared = share_clock(clock) if options.shares else None
        start_s, start_cpu_s, now_ns = time.perf_counter(), time.process_time(), 0
        message = CLOCK()
        while not ended.wait(
            max(0.0, start_s + now_ns / 1e9 / options.factor - time.perf_counter())
        ):
            for _ in range(STEPS_AT_ONCE):
                now_ns += STEP_NS
                if shared is not None and shared.is_used:
                    shared.show(now_ns)
                if clock.matched:
                    message.clock.sec, message.clock.nanosec = divmod(now_ns, 1_000_000_000)
                    clock.publish(message)
            if options.paused and now_ns > 1_000_000_000:
                ended.wait()
        cpu_s = time.process_time() - start_cpu_s
        took_s = time.perf_counter() - start_s
        print(json.dumps({"cpu_ms_per_s": round(cpu_s * 1e3 / took_s, 2)}), flush=True)


def _be_node(what: str, seconds: float, hz: float) -> None:
    ticks: list[tuple[int, float]] = []
    if what == "rclpy timer":
        now_ns, spin = _rclpy_timer(ticks, hz)
    else:
        now_ns, spin = _rospy_node(ticks, hz, rate=what != "idle")
    threading.Thread(target=spin, daemon=True).start()
    # What the start takes is not what is measured.
    time.sleep(1.5)
    ticks.clear()
    start_s, start_cpu_s, start_ns = time.perf_counter(), time.process_time(), now_ns()
    time.sleep(seconds)
    cpu_s, took_s = time.process_time() - start_cpu_s, time.perf_counter() - start_s
    figures = {"cpu_ms_per_s": cpu_s * 1e3 / took_s}
    figures["real_time_factor"] = (now_ns() - start_ns) / 1e9 / took_s
    if len(ticks) > 2:
        figures["hz"] = (len(ticks) - 1) / (ticks[-1][1] - ticks[0][1])
        figures["sim_jitter_ms"] = float(np.diff([tick[0] for tick in ticks]).std() / 1e6)
        figures["wall_jitter_ms"] = float(np.diff([tick[1] for tick in ticks]).std() * 1e3)
    print(json.dumps({key: round(float(value), 2) for key, value in figures.items()}), flush=True)
    os._exit(0)


def _rospy_node(
    ticks: list[tuple[int, float]], hz: float, *, rate: bool
) -> tuple[Callable[[], int], Callable[[], Any]]:
    import rospy

    rospy.init_node("measured")

    def spin() -> None:
        every = rospy.Rate(hz)
        while not rospy.is_shutdown():
            every.sleep()
            ticks.append((rospy.Time.now().to_nsec(), time.perf_counter()))

    return lambda: int(rospy.Time.now().to_nsec()), spin if rate else rospy.spin


def _rclpy_timer(
    ticks: list[tuple[int, float]], hz: float
) -> tuple[Callable[[], int], Callable[[], Any]]:
    import rclpy

    rclpy.init(args=["--ros-args", "-p", "use_sim_time:=true"])
    node = rclpy.create_node("measured")

    def now_ns() -> int:
        return int(node.get_clock().now().nanoseconds)

    node.create_timer(1 / hz, lambda: ticks.append((now_ns(), time.perf_counter())))
    return now_ns, lambda: rclpy.spin(node)


def _say(what: str, **figures: float) -> None:
    print(
        json.dumps({"what": what} | {key: round(value, 3) for key, value in figures.items()}),
        flush=True,
    )


if __name__ == "__main__":
    main()
