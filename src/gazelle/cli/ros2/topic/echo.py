"""``ros2 topic echo``."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2, until_ended
from gazelle.cli.ros2.topic.echoing import Echo, Selection
from gazelle.cli.ros2.topic.qos import (
    Profile,
    add_qos_arguments,
    chosen_profile,
    warn_of_incompatible,
)
from gazelle.cli.ros2.topic.waiting import type_of_topic
from gazelle.cli.ros2.types import ros2_message_class, stated_message_class
from gazelle.cli.ros2.verbs import add_strategy_arguments, positive_float, whole
from gazelle.cli.tool import ToolError
from gazelle.errors import NotFoundError
from gazelle.graph import Graph, Qos
from gazelle.interfaces import Message

__all__ = ["add_arguments", "run"]

_LENGTH = 128
_MIN_QUEUE = 1000
_FLAGS = (
    ("--no-arr", "Don't print array fields of messages"),
    ("--no-str", "Don't print string fields of messages"),
    ("--flow-style", "Print lists in one line (not available with csv format)"),
    ("--no-lost-messages", "Don't report when a message is lost"),
    ("--raw", "Echo the raw binary representation"),
    ("--once", "Print the first message received and then exit."),
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``echo`` takes."""
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_qos_arguments(parser, "subscribe", "sensor_data")
    add("--csv", action="store_true", help="Output all recursive fields separated by commas")
    add("--field", help="Echo a selected field of a message; '.' selects sub-fields")
    add(
        "--full-length",
        "-f",
        action="store_true",
        help="Output all elements for arrays, bytes, and string",
    )
    add(
        "--truncate-length",
        "-l",
        type=whole,
        default=_LENGTH,
        help=f"The length to truncate arrays, bytes, and string to (default: {_LENGTH})",
    )
    for name, text in _FLAGS:
        add(name, action="store_true", help=text)
    # Humble's default, which it has as an option too.
    add("--lost-messages", action="store_true", help=argparse.SUPPRESS)
    add("--filter", dest="filter_expr", help="Python expression of m, the message")
    add("--timeout", metavar="N", type=positive_float, help="Set a timeout in seconds for waiting")
    add("--include-message-info", "-i", action="store_true", help="Shows the message info")
    add("--clear", "-c", action="store_true", help="Clear screen before printing next message")
    add("-n", "--node-name", help="The name of the echoing node; by default, it is hidden")


def run(options: argparse.Namespace) -> int:
    """Print the messages of a topic."""
    topic = full_name(options.topic_name)
    with graph_of_ros2() as graph:
        publishers = graph.publishers_info(topic)
        profile = chosen_profile(options, publishers)
        kind = _kind(graph, topic, options)
        selection = Selection.of(options, kind)
        warn_of_incompatible(topic, profile, publishers)
        node, ended = cli_node(graph, options, options.node_name)
        echo = Echo(graph, topic, selection, options, ended=ended)
        node.create_subscription(
            topic,
            kind,
            echo,
            queue_size=_queue_size(options, profile),
            raw=options.raw,
            with_info=True,
            qos=_told_qos(profile),
        )
        until_ended(ended, timeout_s=options.timeout)
    if echo.error is not None:
        raise echo.error
    return 0


def _told_qos(profile: Profile) -> Qos:
    """A volatile subscription does not get what was published before it."""
    is_reliable = profile.reliability != "best_effort"
    return Qos(is_reliable, profile.durability != "volatile", profile.queue_size)


def _queue_size(options: argparse.Namespace, profile: Profile) -> int:
    """More may wait than ROS 2's five, unless the user chooses: a busy machine loses none."""
    chosen = options.qos_depth is not None or options.qos_history is not None
    return profile.queue_size if chosen else max(profile.queue_size, _MIN_QUEUE)


def _kind(graph: Graph, topic: str, options: argparse.Namespace) -> type[Message]:
    if options.message_type:
        return stated_message_class(options.message_type)
    name = type_of_topic(graph, topic)
    if not name:
        raise ToolError("Could not determine the type for the passed topic")
    try:
        return ros2_message_class(name)
    except NotFoundError as error:
        raise ToolError(f"The message type '{name}' is invalid\n  {error}") from None
