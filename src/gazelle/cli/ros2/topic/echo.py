"""``ros2 topic echo``: its options, and how it prints messages."""

from __future__ import annotations

import argparse
import sys
import threading
import time
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2, type_of_topic, until_ended
from gazelle.cli.ros2.topic.qos import (
    Profile,
    add_qos_arguments,
    chosen_profile,
    warn_of_incompatible,
)
from gazelle.cli.ros2.verbs import add_strategy_arguments, non_negative_int, positive_float
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.ros_types import ros2_message_class, stated_message_class
from gazelle.cli.rostopic.echo import expression
from gazelle.cli.text.fields import FieldError, Step, field_value, parse_path
from gazelle.cli.text.ros2_text import Shortening, message_csv, message_yaml, value_text
from gazelle.errors import NotFoundError
from gazelle.graph import Graph, Kind, MessageInfo, Qos
from gazelle.interfaces import FieldType, Message, message_type
from gazelle.interfaces.definition import Array

__all__ = ["Echo", "Selection", "add_arguments", "run"]

_CLEAR = "\x1b[H\x1b[2J\n"
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


class Selection(NamedTuple):
    """Which part of a message is shown, of which type, and of which messages.

    Attributes:
        steps: to the field, none for the whole message.
        kind: the field's type; None when several are shown.
        wanted: tells messages that are shown.
    """

    steps: tuple[Step, ...] = ()
    kind: FieldType | None = None
    wanted: Callable[[Any], bool] | None = None

    @classmethod
    def of(cls, options: argparse.Namespace, message_class: type[Message]) -> Selection:
        """Return what ``--field`` and ``--filter`` select.

        Raises:
            ToolError: there is no such field, or the filter is no expression.
        """
        wanted = expression(options.filter_expr, "") if options.filter_expr else None
        if options.field is None:
            return cls(wanted=wanted)
        steps = parse_path(options.field.replace(".", "/"))
        if not steps:
            raise ToolError(f"Invalid field value '{options.field}'")
        return cls(steps, _field_kind(message_class, steps, options.field), wanted)


class Echo:
    """Prints each message it is called with.

    Attributes:
        error: why it ended early.
    """

    def __init__(
        self,
        graph: Graph,
        topic: str,
        selection: Selection,
        options: argparse.Namespace,
        *,
        ended: threading.Event,
    ) -> None:
        """Print messages of a topic; set `ended` at the end."""
        self.error: ToolError | None = None
        self._graph = graph
        self._topic = topic
        self._selection = selection
        self._options = options
        self._ended = ended
        length = None if options.full_length else options.truncate_length
        self._how = Shortening(length, options.no_arr, options.no_str)
        self._last: dict[str, int] = {}
        self._lost = 0

    def __call__(self, message: Any, info: MessageInfo) -> None:
        """Print one message."""
        if self._ended.is_set():
            return
        try:
            self._tell_lost(info)
            self._take(message.data if self._options.raw else message, info)
            sys.stdout.flush()
        except ToolError as error:
            self.error = error
            self._ended.set()
        except OSError:
            # Whoever read our output has gone.
            self._ended.set()

    def _take(self, message: Any, info: MessageInfo) -> None:
        options, selection = self._options, self._selection
        if not options.raw:
            try:
                message = field_value(message, selection.steps)
            except FieldError as error:
                raise ToolError(f"Invalid field '{options.field}': {error}") from None
        if selection.wanted is not None and not selection.wanted(message):
            return
        text = self._text(message, info)
        sys.stdout.write(_CLEAR + text if options.clear else text)
        if options.once:
            self._ended.set()

    def _text(self, value: Any, info: MessageInfo) -> str:
        options = self._options
        about = _about(info) if options.include_message_info else {}
        if not isinstance(value, Message):
            head = f"---Got new message, message info:---\n{about}\n---Message data:---\n"
            shown = value if options.raw else value_text(value, self._selection.kind)
            return f"{head if about else ''}{shown}\n---\n"
        if options.csv:
            start = [str(one) for one in about.values()]
            return ",".join([*start, message_csv(value, self._how)]) + "\n"
        head = ""
        if about:
            head = "".join(f"{name}: {_or_null(about[name])}\n" for name in sorted(about)) + "---\n"
        return f"{head}{message_yaml(value, self._how, flow_style=options.flow_style)}---\n"

    def _tell_lost(self, info: MessageInfo) -> None:
        last = self._last.get(info.publisher, 0)
        self._last[info.publisher] = info.sequence
        change = info.sequence - last - 1
        if not last or change <= 0 or self._options.no_lost_messages or not self._is_one(info):
            return
        self._lost += change
        print(
            f"A message was lost!!!\n\ttotal count change:{change}\n\ttotal count: {self._lost}",
            end="---\n",
        )

    def _is_one(self, info: MessageInfo) -> bool:
        """Whether the node has one publisher only; two of them count each on its own."""
        known = self._graph.discovery.known()
        own = [one for one in known if one.node == info.publisher and one.name == self._topic]
        return sum(one.kind is Kind.PUBLISHER for one in own) == 1


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
        type=non_negative_int,
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


def _about(info: MessageInfo) -> dict[str, int | None]:
    return {
        "source_timestamp": info.stamp_ns,
        "received_timestamp": time.time_ns(),
        "publication_sequence_number": info.sequence,
        "reception_sequence_number": None,
    }


def _or_null(number: int | None) -> int | str:
    return "null" if number is None else number


def _field_kind(owner: type[Message], steps: tuple[Step, ...], path: str) -> FieldType | None:
    kind: FieldType | None = None
    for step in steps:
        fields = {item.name: item.type for item in owner.FIELDS}
        kind = fields.get(step.name)
        if kind is None:
            near = hint(step.name, fields)
            raise ToolError(
                f"Invalid field '{path}': '{owner.TYPE_NAME.rpartition('/')[2]}' object has no "
                f"attribute '{step.name}'{near}"
            )
        if isinstance(step.items, slice):
            return None
        if step.items is not None:
            kind = kind._replace(array=Array.ONE)
        if kind.is_message:
            owner = message_type(kind.base)
    return kind


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
