"""``ros2 topic hz``, ``bw`` and ``delay``."""

from __future__ import annotations

import argparse
import contextlib
import threading
import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2, wait_for_type
from gazelle.cli.ros2.verbs import add_direct_arguments, positive_int
from gazelle.cli.ros_tool import ToolError
from gazelle.cli.ros_types import ros2_message_class
from gazelle.cli.rostopic.bw import BandwidthMeter
from gazelle.cli.rostopic.delay import DelayMeter
from gazelle.cli.rostopic.echo import expression
from gazelle.cli.rostopic.hz import RateMeter, rate_table
from gazelle.graph import RawMessage
from gazelle.interfaces.stamps import seconds_of

__all__ = ["add_arguments_bw", "add_arguments_delay", "add_arguments_hz"]
__all__ += ["bandwidth_text", "rate_text", "run_bw", "run_delay", "run_hz"]

_PERIOD_S = 1.0
_WINDOW = 10_000
_BW_WINDOW = 100
_Parser = argparse.ArgumentParser


def add_arguments_hz(parser: _Parser) -> None:
    """Add what ``hz`` takes."""
    add = parser.add_argument
    add("topic_name", nargs="+", help="Names of the ROS topic to listen to (e.g. '/chatter')")
    _add_window(parser, _WINDOW)
    add("--filter", dest="filter_expr", metavar="EXPR", help="only measure matching messages")
    add("--wall-time", action="store_true", help="calculates rate using wall time")
    add_direct_arguments(parser)


def run_hz(options: argparse.Namespace) -> int:
    """Print the rate of topics once a second."""
    meters: dict[str, RateMeter] = {}
    with graph_of_ros2() as graph:
        node, ended = cli_node(graph, options)
        now_ns = time.time_ns if options.wall_time else graph.clock.now_ns
        for word in dict.fromkeys(options.topic_name):
            topic = full_name(word)
            type_name = wait_for_type(graph, topic, ended)
            if not type_name:
                return 0
            meter = meters[word] = RateMeter(options.window + 1)
            wanted = expression(options.filter_expr, topic) if options.filter_expr else None
            kind = ros2_message_class(type_name) if wanted else None
            take = partial(_count, meter, now_ns, wanted)
            node.create_subscription(topic, kind, take, raw=wanted is None, inline=True)
            if len(options.topic_name) > 1:
                print(f"Subscribed to [{word}]", flush=True)
        # Of the three, the original ends this one well at Ctrl-C.
        with contextlib.suppress(KeyboardInterrupt):
            _repeat(ended, lambda: rate_text(meters))
    return 0


def rate_text(meters: Mapping[str, RateMeter]) -> str:
    """Return what is printed once a second, empty when nothing came meanwhile."""
    rates = {topic: rate for topic, meter in meters.items() if (rate := meter.read()) is not None}
    if not rates:
        return ""
    if len(meters) == 1:
        (one,) = rates.values()
        return (
            f"average rate: {one.rate_hz:.3f}\n\tmin: {one.min_s:.3f}s max: {one.max_s:.3f}s "
            f"std dev: {one.std_dev_s:.5f}s window: {one.window - 1}"
        )
    # ros2topic counts the gaps between messages, rostopic the messages.
    rows = [
        (topic, *(f"{value:.3f}" for value in one[:3]), f"{one[3]:.5f}", str(one.window - 1))
        for topic, one in rates.items()
    ]
    return rate_table(rows)


def add_arguments_bw(parser: _Parser) -> None:
    """Add what ``bw`` takes."""
    parser.add_argument("topic", help="Topic name to monitor for bandwidth utilization")
    _add_window(parser, _BW_WINDOW)
    add_direct_arguments(parser)


def run_bw(options: argparse.Namespace) -> int:
    """Print the bandwidth of a topic once a second."""
    meter = BandwidthMeter(options.window)

    def take(message: RawMessage) -> None:
        meter.add(time.monotonic(), len(message.data))

    with graph_of_ros2() as graph:
        node, ended = cli_node(graph, options)
        topic = full_name(options.topic)
        if wait_for_type(graph, topic, ended):
            node.create_subscription(topic, None, take, raw=True, inline=True)
            print(f"Subscribed to [{options.topic}]", flush=True)
            _repeat(ended, lambda: bandwidth_text(meter, time.monotonic()))
    return 0


def bandwidth_text(meter: BandwidthMeter, now_s: float) -> str:
    """Return what is printed once a second, empty before the second message."""
    found = meter.read(now_s)
    if found is None:
        return ""
    if found.bytes_per_s < 1e3:
        layout, scale = "{:.0f} B", 1.0
    elif found.bytes_per_s < 1e6:
        layout, scale = "{:.2f} KB", 1e3
    else:
        layout, scale = "{:.2f} MB", 1e6
    rate, mean, least, most = (layout.format(value / scale) for value in found[:4])
    return (
        f"{rate}/s from {found.window} messages\n"
        f"\tMessage size mean: {mean} min: {least} max: {most}"
    )


def add_arguments_delay(parser: _Parser) -> None:
    """Add what ``delay`` takes."""
    parser.add_argument("topic", help="Topic name to calculate the delay for")
    _add_window(parser, _WINDOW)
    add_direct_arguments(parser)


def run_delay(options: argparse.Namespace) -> int:
    """Print the age of a topic's messages once a second."""
    meter = DelayMeter(options.window)
    with graph_of_ros2() as graph:
        node, ended = cli_node(graph, options)
        topic = full_name(options.topic)
        type_name = wait_for_type(graph, topic, ended)
        if not type_name:
            return 0
        kind = ros2_message_class(type_name)
        if "header" not in kind._names:
            raise ToolError(f"msg does not have header: {type_name} has no time of its own")

        def take(message: Any) -> None:
            stamp = message.header.stamp
            meter.add(graph.clock.now_ns() / 1e9, seconds_of(stamp))

        node.create_subscription(topic, kind, take, inline=True)
        _repeat(ended, meter.report)
    return 0


def _count(
    meter: RateMeter,
    now_ns: Callable[[], int],
    wanted: Callable[[Any], bool] | None,
    message: Any,
) -> None:
    if wanted is None or wanted(message):
        meter.add(now_ns() / 1e9)


def _repeat(ended: threading.Event, text_of: Callable[[], str]) -> None:
    while not ended.wait(_PERIOD_S):
        if text := text_of():
            print(text, flush=True)


def _add_window(parser: _Parser, default: int) -> None:
    parser.add_argument(
        "--window",
        "-w",
        type=positive_int,
        default=default,
        metavar="WINDOW",
        help=f"window size, in # of messages, for calculating rate (default: {default})",
    )
