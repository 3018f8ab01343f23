"""``ros2 topic pub``."""

from __future__ import annotations

import argparse
import sys
import threading
import time
from typing import Any, NamedTuple

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2, types_by_name
from gazelle.cli.ros2.topic.qos import add_qos_arguments, chosen_profile
from gazelle.cli.ros2.verbs import add_direct_arguments, non_negative_int, positive_float
from gazelle.cli.ros_tool import ToolError
from gazelle.cli.ros_types import stated_message_class
from gazelle.cli.text.fill_message import filled, yaml_values
from gazelle.cli.text.ros2_text import message_repr
from gazelle.errors import GraphError
from gazelle.graph import Graph, Kind, Publisher, TimeJumpError
from gazelle.interfaces import Message

__all__ = ["add_arguments", "run"]

_LOOK_S = 0.1
_TELL_EVERY = 10
_INEFFECTIVE = (
    "--max-wait-time-secs option is only effective with --wait-matching-subscriptions, --once or "
    "--times"
)


class _Job(NamedTuple):
    """All that publishing needs."""

    graph: Graph
    publisher: Publisher
    kind: type[Message]
    values: dict[str, Any]
    ended: threading.Event

    def message(self) -> Message:
        return filled(self.kind, self.values, self.graph.clock.now_ns())

    def publish(self, message: Message) -> None:
        try:
            self.publisher.publish(message)
        except GraphError:
            # The node may be killed at any moment.
            if not self.ended.is_set():
                raise


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``pub`` takes."""
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    add("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')")
    group = parser.add_mutually_exclusive_group()
    text = "Values to fill the message with in YAML format (e.g. 'data: Hello World')"
    group.add_argument("values", nargs="?", default="{}", help=text)
    group.add_argument("--stdin", action="store_true", help="Read values from standard input")
    add(
        "-r",
        "--rate",
        metavar="N",
        type=positive_float,
        default=1.0,
        help="Rate in Hz (default: 1)",
    )
    text = "Only print every N-th published message (default: 1)"
    add("-p", "--print", metavar="N", type=int, default=1, help=text)
    group = parser.add_mutually_exclusive_group()
    group.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    text = "Publish this number of times and then exit"
    group.add_argument("-t", "--times", type=non_negative_int, default=0, help=text)
    text = "Wait until finding the specified number of matching subscriptions"
    add("-w", "--wait-matching-subscriptions", type=non_negative_int, default=None, help=text)
    text = "The maximum wait time in seconds for matching subscriptions"
    add("--max-wait-time-secs", type=positive_float, help=text)
    text = "Keep publishing node alive for N seconds after the last msg (default: 0.1)"
    add("--keep-alive", metavar="N", type=positive_float, default=0.1, help=text)
    add("-n", "--node-name", help="Name of the created publishing node")
    add_qos_arguments(parser, "publish", "default")
    add_direct_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Publish messages on a topic."""
    kind = stated_message_class(options.message_type)
    values = yaml_values(sys.stdin.read() if options.stdin else options.values)
    times = 1 if options.once else options.times
    wanted = options.wait_matching_subscriptions
    wanted = int(times != 0) if wanted is None else wanted
    if not wanted and options.max_wait_time_secs is not None:
        raise ToolError(_INEFFECTIVE)
    # What is wrong in the values is told before anybody is waited for.
    filled(kind, values, time.time_ns())
    topic = full_name(options.topic_name)
    with graph_of_ros2() as graph:
        _warn_of_other_type(graph, topic, kind.TYPE_NAME)
        node, ended = cli_node(graph, options, options.node_name)
        profile = chosen_profile(options)
        publisher = node.create_publisher(
            topic,
            kind,
            latch=profile.durability == "transient_local",
            reliable=profile.reliability != "best_effort",
            queue_size=profile.queue_size,
        )
        job = _Job(graph, publisher, kind, values, ended)
        if _wait_for_subscriptions(job, wanted, options.max_wait_time_secs):
            _publish(job, times, 1.0 / options.rate, options.print)
            ended.wait(options.keep_alive)
    return 0


def _publish(job: _Job, times: int, period_s: float, print_nth: int) -> None:
    print("publisher: beginning loop", flush=True)
    clock, next_ns, count = job.graph.clock, job.graph.clock.now_ns(), 0
    while not job.ended.is_set():
        message = job.message()
        count += 1
        if print_nth and count % print_nth == 0:
            print(f"publishing #{count}: {message_repr(message)}\n", flush=True)
        job.publish(message)
        if times and count >= times:
            return
        next_ns = max(next_ns + round(period_s * 1e9), clock.now_ns())
        try:
            clock.sleep_until(next_ns)
        except TimeJumpError:
            next_ns = clock.now_ns()


def _wait_for_subscriptions(job: _Job, wanted: int, limit_s: float | None) -> bool:
    """Wait until so many subscribe; False when the node ended first.

    Raises:
        ToolError: time is up.
    """
    attempts, start_s = 0, time.monotonic()
    while wanted and not _is_heard(job.publisher, wanted):
        if attempts % _TELL_EVERY == 0:
            print(f"Waiting for at least {wanted} matching subscription(s)...", flush=True)
        attempts += 1
        if limit_s is not None and time.monotonic() - start_s >= limit_s:
            raise ToolError(
                f"Timed out waiting for subscribers: Expected {wanted} subcribers but only got "
                f"{job.publisher.subscription_count} subscribers"
            )
        if job.ended.wait(_LOOK_S):
            return False
    return True


def _is_heard(publisher: Publisher, wanted: int) -> bool:
    """Subscriptions of other types are counted too, and known before the transport knows them."""
    return publisher.subscription_count >= wanted and publisher.matched


def _warn_of_other_type(graph: Graph, topic: str, type_name: str) -> None:
    entities = graph.entities()
    if type_name in types_by_name(entities, (Kind.SUBSCRIPTION,)).get(topic, ()):
        return
    for other in types_by_name(entities, (Kind.PUBLISHER, Kind.SUBSCRIPTION)).get(topic, ()):
        if other != type_name:
            print(
                f"WARNING: {topic} has type {other}, you publish {type_name}; its subscribers "
                "drop that",
                file=sys.stderr,
            )
