"""``rostopic hz``."""

from __future__ import annotations

import math
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

from gazelle.cli.ros_tool import add_flag, global_name, join_graph, option_parser
from gazelle.cli.ros_types import topic_class
from gazelle.cli.rostopic.echo import expression
from gazelle.cli.rostopic.topics import join_as_node, uses_sim_time, wait_for_topic

__all__ = ["Rate", "RateMeter", "rate_report", "rate_table", "run"]

_PERIOD_S = 1.0
_MAX_WINDOW = 50_000
_HEADER = ("topic", "rate", "min_delta", "max_delta", "std_dev", "window")


class Rate(NamedTuple):
    """Statistics of the time between messages, in Hz and seconds, and how many messages."""

    rate_hz: float
    min_s: float
    max_s: float
    std_dev_s: float
    window: int


class RateMeter:
    """Measures the rate of one topic over the last messages."""

    def __init__(self, window: int = -1) -> None:
        """Look at `window` messages; at very many when it is negative."""
        self._deltas: deque[float] = deque(maxlen=max(window - 1, 1) if window >= 0 else None)
        self._last_s: float | None = None
        self._told_s: float | None = None
        self._lock = threading.Lock()

    def add(self, now_s: float) -> None:
        """Count a message; time zero, or time that goes back, starts afresh."""
        with self._lock:
            if now_s == 0:
                if self._deltas:
                    print("time has reset, resetting counters")
                    self._deltas.clear()
                return
            if self._last_s is None or now_s < self._last_s:
                self._deltas.clear()
            else:
                self._deltas.append(now_s - self._last_s)
            self._last_s = now_s
            if len(self._deltas) > _MAX_WINDOW - 1:
                self._deltas.popleft()

    def read(self) -> Rate | None:
        """Return the statistics; None when nothing came since they were last read."""
        with self._lock:
            if not self._deltas or self._last_s == self._told_s:
                return None
            self._told_s = self._last_s
            deltas = list(self._deltas)
        mean = sum(deltas) / len(deltas)
        std_dev = math.sqrt(sum((one - mean) ** 2 for one in deltas) / len(deltas))
        rate = 1 / mean if mean > 0 else 0.0
        return Rate(rate, min(deltas), max(deltas), std_dev, len(deltas) + 1)


def rate_report(meters: Mapping[str, RateMeter]) -> str:
    """Return what is printed once a second: one topic's rate, or a table of several."""
    rates = {topic: rate for topic, meter in meters.items() if (rate := meter.read()) is not None}
    if not rates:
        return "no new messages"
    if len(meters) == 1:
        (one,) = rates.values()
        return (
            f"average rate: {one.rate_hz:.3f}\n\tmin: {one.min_s:.3f}s max: {one.max_s:.3f}s "
            f"std dev: {one.std_dev_s:.5f}s window: {one.window}"
        )
    rows = [
        (topic, *(f"{value:.4}" for value in rate[:4]), str(rate.window))
        for topic, rate in rates.items()
    ]
    return rate_table(rows)


def run(argv: list[str]) -> int:
    """Print the rate of topics once a second."""
    parser = option_parser("rostopic", "hz [options] /topic_0 [/topic_1 [topic_2 [..]]]")
    add = parser.add_option
    add("-w", "--window", metavar="WINDOW", default="-1", help="window size, in # of messages")
    add("-b", "--bag", dest="bag", metavar="BAGFILE", help="rate of the topics of a bag")
    add("--filter", dest="filter_expr", metavar="EXPR", help="only messages that match this")
    add_flag(
        parser, "--wall-time", dest="wall_time", text="use wall time also when time is simulated"
    )
    add_flag(
        parser, "--tcpnodelay", dest="nodelay", text="accepted: nothing waits for full packets here"
    )
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("topic must be specified")
    try:
        window = int(options.window)
    except ValueError:
        parser.error("window size must be an integer")
    meters: dict[str, RateMeter] = {}
    if options.bag:
        meters = {global_name(arg, "rostopic"): RateMeter(window) for arg in args}
        return _print_of_bag(options.bag, meters, options.filter_expr)
    with join_graph() as graph:
        node, ended = join_as_node(graph, clock=not options.wall_time)
        now_ns = time.time_ns if options.wall_time else graph.clock.now_ns
        for word in dict.fromkeys(global_name(arg, "rostopic") for arg in args):
            topic = wait_for_topic(graph, word)
            meter = meters[word] = RateMeter(window)
            wanted = expression(options.filter_expr, word) if options.filter_expr else None
            take = partial(_take, meter, now_ns, wanted)
            # Undecoded and in the receiving thread, to see messages when they come.
            kind = None if wanted is None else topic_class(topic.type_name)
            node.create_subscription(topic.name, kind, take, raw=wanted is None, inline=True)
            print(f"subscribed to [{topic.name}]", flush=True)
        if uses_sim_time(graph):
            print("WARNING: may be using simulated time", file=sys.stderr, flush=True)
        while not ended.wait(_PERIOD_S):
            print(rate_report(meters), flush=True)
    return 0


def _print_of_bag(path: str, meters: dict[str, RateMeter], text: str | None) -> int:
    from gazelle.cli.rostopic.bag import rate_of_bag

    filters = {topic: expression(text, topic) for topic in meters} if text else {}
    wanted = (lambda topic, message: filters[topic](message)) if filters else None
    rate_of_bag(path, {topic: meter.add for topic, meter in meters.items()}, wanted)
    print(rate_report(meters))
    return 0


def _take(
    meter: RateMeter,
    now_ns: Callable[[], int],
    wanted: Callable[[Any], bool] | None,
    message: Any,
) -> None:
    if wanted is None or wanted(message):
        meter.add(now_ns() / 1e9)


def rate_table(rows: list[tuple[str, ...]]) -> str:
    """Return the table of several topics: name and the five numbers, as text."""
    widths = [max(map(len, column)) for column in zip(_HEADER, *rows, strict=True)]
    head = "   ".join(word.center(width) for word, width in zip(_HEADER, widths, strict=True))
    body = [
        "   ".join(word.ljust(width) for word, width in zip(row, widths, strict=True))
        for row in rows
    ]
    rule = "=" * (sum(widths) + 3 * (len(widths) - 1))
    return "\n".join([head, rule, *body, ""])
