"""``rostopic bw``."""

from __future__ import annotations

import threading
import time
from collections import deque
from typing import NamedTuple

from gazelle.cli.ros_tool import global_name, join_graph, option_parser
from gazelle.cli.rostopic.topics import join_as_node, wait_for_topic
from gazelle.graph import RawMessage

__all__ = ["Bandwidth", "BandwidthMeter", "run"]

_PERIOD_S = 1.0
_WINDOW = 100
_UNITS = ((1e6, "MB"), (1e3, "KB"), (1.0, "B"))


class Bandwidth(NamedTuple):
    """Bytes per second, bytes of messages, and how many messages."""

    bytes_per_s: float
    mean: float
    least: int
    most: int
    window: int


class BandwidthMeter:
    """Measures the bytes of one topic over the last messages."""

    def __init__(self, window: int | None = None) -> None:
        """Look at `window` messages, 100 by default."""
        self._items: deque[tuple[float, int]] = deque(maxlen=window or _WINDOW)
        self._lock = threading.Lock()

    def add(self, now_s: float, size: int) -> None:
        """Count a message of so many bytes."""
        with self._lock:
            self._items.append((now_s, size))

    def read(self, now_s: float) -> Bandwidth | None:
        """Return the statistics, None before the second message."""
        with self._lock:
            items = list(self._items)
        if len(items) < 2 or now_s <= items[0][0]:
            return None
        sizes = [size for _, size in items]
        total = sum(sizes)
        per_second, mean = total / (now_s - items[0][0]), total / len(sizes)
        return Bandwidth(per_second, mean, min(sizes), max(sizes), len(items))

    def report(self, now_s: float) -> str:
        """Return what is printed once a second, empty before the second message."""
        found = self.read(now_s)
        if found is None:
            return ""
        scale, unit = next(one for one in _UNITS if found.bytes_per_s >= one[0] or one[0] == 1.0)
        average, mean, least, most = (f"{value / scale:.2f}{unit}" for value in found[:4])
        return (
            f"average: {average}/s\n\tmean: {mean} min: {least} max: {most} window: {found.window}"
        )


def run(argv: list[str]) -> int:
    """Print the bandwidth of a topic once a second."""
    parser = option_parser("rostopic", "bw /topic")
    parser.add_option("-w", "--window", metavar="WINDOW", help="window size, in # of messages")
    parser.add_option("-b", "--bag", metavar="BAGFILE", help="bandwidth of the topic of a bag")
    options, args = parser.parse_args(argv)
    if len(args) != 1:
        parser.error("you may only specify one input topic" if args else "topic must be specified")
    try:
        meter = BandwidthMeter(None if options.window is None else int(options.window))
    except ValueError:
        parser.error("window size must be an integer")

    if options.bag:
        from gazelle.cli.rostopic.bag import bandwidth_of_bag

        topic_name = global_name(args[0], "rostopic")
        end_s = bandwidth_of_bag(options.bag, topic_name, meter.add)
        print(meter.report(end_s) or "no new messages")
        return 0

    def take(message: RawMessage) -> None:
        meter.add(time.monotonic(), len(message.data))

    with join_graph() as graph:
        node, ended = join_as_node(graph, clock=False)
        topic = wait_for_topic(graph, global_name(args[0], "rostopic"))
        node.create_subscription(topic.name, None, take, raw=True, inline=True)
        print(f"subscribed to [{topic.name}]", flush=True)
        while not ended.wait(_PERIOD_S):
            if text := meter.report(time.monotonic()):
                print(text, flush=True)
    return 0
