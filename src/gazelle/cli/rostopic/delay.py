"""``rostopic delay``: how old messages are when they arrive."""

from __future__ import annotations

import math
import sys
import threading
from collections import deque
from typing import Any

from gazelle.cli.ros_tool import ToolError, add_flag, global_name, join_graph, option_parser
from gazelle.cli.ros_types import topic_class
from gazelle.cli.rostopic.topics import join_as_node, uses_sim_time, wait_for_topic

__all__ = ["DelayMeter", "run"]

_PERIOD_S = 1.0
_MAX_WINDOW = 50_000


class DelayMeter:
    """Measures the age of one topic's messages over the last of them."""

    def __init__(self, window: int = -1) -> None:
        """Look at `window` messages; at very many when it is negative."""
        size = _MAX_WINDOW if window < 0 else max(window, 2)
        self._delays: deque[float] = deque(maxlen=size - 1)
        self._last_s = 0.0
        self._told_s = 0.0
        self._lock = threading.Lock()

    def add(self, now_s: float, stamp_s: float) -> None:
        """Count a message; time that goes back starts afresh."""
        with self._lock:
            if now_s < self._last_s:
                if self._delays:
                    print("time has reset, resetting counters")
                self._delays.clear()
            if now_s > 0:
                self._delays.append(now_s - stamp_s)
            self._last_s = now_s

    def report(self) -> str:
        """Return what is printed once a second, empty before the first message."""
        with self._lock:
            delays, is_new = list(self._delays), self._last_s != self._told_s
            self._told_s = self._last_s
        if not delays:
            return ""
        if not is_new:
            return "no new messages"
        mean = sum(delays) / len(delays)
        std_dev = math.sqrt(sum((one - mean) ** 2 for one in delays) / len(delays))
        return (
            f"average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s "
            f"std dev: {std_dev:.5f}s window: {len(delays)}"
        )


def run(argv: list[str]) -> int:
    """Print the delay of a topic once a second."""
    parser = option_parser("rostopic", "delay [options] /topic")
    parser.add_option(
        "-w", "--window", type="int", default=-1, help="window size, in # of messages"
    )
    add_flag(
        parser, "--tcpnodelay", dest="nodelay", text="accepted: nothing waits for full packets here"
    )
    options, args = parser.parse_args(argv)
    if len(args) != 1:
        parser.error("you may only specify one input topic" if args else "topic must be specified")
    meter = DelayMeter(options.window)
    with join_graph() as graph:
        node, ended = join_as_node(graph)
        topic = wait_for_topic(graph, global_name(args[0], "rostopic"))
        kind = topic_class(topic.type_name)
        if not kind._has_header:
            raise ToolError(f"msg does not have header: {topic.type_name} has no time of its own")

        def take(message: Any) -> None:
            meter.add(graph.clock.now_ns() / 1e9, message.header.stamp.to_sec())

        node.create_subscription(topic.name, kind, take, inline=True)
        print(f"subscribed to [{topic.name}]", flush=True)
        if uses_sim_time(graph):
            print("WARNING: may be using simulated time", file=sys.stderr, flush=True)
        while not ended.wait(_PERIOD_S):
            if text := meter.report():
                print(text, flush=True)
    return 0
