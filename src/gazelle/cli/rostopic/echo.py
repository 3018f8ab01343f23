"""``rostopic echo``."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from functools import partial
from optparse import OptionParser, Values
from typing import Any, Protocol

from gazelle.cli.ros_tool import ToolError, add_flag, global_name, join_graph, option_parser
from gazelle.cli.ros_types import topic_class
from gazelle.cli.rostopic.topics import FoundTopic, join_as_node, uses_sim_time, wait_for_topic
from gazelle.cli.text.fields import FieldError, field_type, field_value
from gazelle.graph import Graph
from gazelle.graph.graph_info import topics_of
from gazelle.interfaces import Time, strify

__all__ = ["Echo", "expression", "run"]

_CLEAR = "\033[2J\033[;H"
_LOOK_S = 1.0
_SIM_TIME_S = 2.0
_NO_CLOCK = (
    "WARNING: no messages received and simulated time is active.\nIs /clock being published?"
)


def run(argv: list[str]) -> int:
    """Print the messages of a topic until there were enough."""
    parser = _parser()
    options, args = parser.parse_args(argv)
    if options.all_topics and not options.bag:
        parser.error("Display all option is only valid when echoing from bag files")
    if len(args) != 1 and not (options.all_topics and not args):
        parser.error("you may only specify one input topic" if args else "topic must be specified")
    count = _whole(parser, options.msg_count, "COUNT must be an integer")
    width = _whole(parser, options.width, "NUM_WIDTH must be an integer")
    if width is not None and width < 2:
        parser.error("Fixed width for numeric values must be at least 2")
    word = global_name(args[0], "rostopic") if args else ""
    wanted = expression(options.filter_expr, word) if options.filter_expr else None
    if options.bag:
        from gazelle.cli.rostopic.bag import BagClock, echo_bag

        def make(topic: FoundTopic, clock: BagClock) -> Echo:
            return Echo(topic, options, clock, count=count, width=width, wanted=wanted)

        return echo_bag(options.bag, word, make, options)
    with join_graph() as graph:
        node, ended = join_as_node(graph)
        topic = wait_for_topic(graph, word)
        echo = Echo(topic, options, graph.clock, count=count, width=width, wanted=wanted)
        node.create_subscription(topic.name, topic_class(topic.type_name), echo)
        if uses_sim_time(graph) and not echo.done.wait(_SIM_TIME_S) and not echo.count:
            print(_why_silent(graph, topic.name), file=sys.stderr, flush=True)
        while not echo.done.wait(_LOOK_S) and not ended.is_set():
            pass
    if echo.error is not None:
        raise echo.error
    return 0


def _why_silent(graph: Graph, topic: str) -> str:
    """Say why no message may have come in simulated time: the first of what is so."""
    infos = {one.name: one for one in topics_of(graph.entities(), include_hidden=True)}
    found = infos.get(topic)
    publishers = found.publishers if found else ()
    if not publishers:
        return f"WARNING: no messages received: nobody publishes {topic}."
    if (clock := infos.get("/clock")) is None or not clock.publishers:
        return _NO_CLOCK
    return f"WARNING: no messages received yet from {', '.join(publishers)}."


def expression(text: str, topic: str) -> Callable[[Any], bool]:
    """Return the ``--filter`` that a Python expression of ``m`` and ``topic`` says.

    Raises:
        ToolError: it is not an expression; the function raises it when it fails on a message.
    """
    try:
        code = compile(text, "--filter", "eval")
    except SyntaxError as error:
        raise ToolError(f"--filter '{text}' is not a Python expression: {error.msg}") from None

    def wanted(message: Any) -> bool:
        try:
            # The user's own words on the user's own command line, as in the original.
            return bool(eval(code, {"m": message, "topic": topic}))  # noqa: S307
        except Exception as error:  # noqa: BLE001 - an expression may raise anything
            raise ToolError(f"--filter '{text}': {type(error).__name__}: {error}") from None

    return wanted


class _Clock(Protocol):
    def now_ns(self) -> int: ...


class Echo:
    """Prints each message it is called with.

    Attributes:
        done: set when there were enough, or none can follow.
        count: how many were printed.
        error: why it ended early.
    """

    def __init__(
        self,
        topic: FoundTopic,
        options: Values,
        clock: _Clock,
        *,
        count: int | None = None,
        width: int | None = None,
        wanted: Callable[[Any], bool] | None = None,
    ) -> None:
        """Print fields of `topic` as the options say."""
        self.done = threading.Event()
        if count is not None and count <= 0:
            self.done.set()
        self.count = 0
        self.error: ToolError | None = None
        self._topic = topic
        self._type = field_type(topic.type_name, topic.steps)
        self._options = options
        self._clock = clock
        self._most = count
        self._width = width
        self._wanted = wanted
        self._told: set[str] = set()

    def __call__(self, message: Any) -> None:
        """Print one message."""
        if self.done.is_set():
            return
        try:
            self._take(message)
        except ToolError as error:
            self.error = error
            self.done.set()
        except OSError:
            # Whoever read our output has gone.
            self.done.set()

    def _take(self, message: Any) -> None:
        if self._wanted is not None and not self._wanted(message):
            return
        try:
            value = field_value(message, self._topic.steps)
        except FieldError as error:
            if str(error) not in self._told:
                self._told.add(str(error))
                print(error, file=sys.stderr, flush=True)
            return
        self.count += 1
        sys.stdout.write(self._row(value) if self._options.plot else self._block(value))
        sys.stdout.flush()
        if self._most is not None and self.count >= self._most:
            self.done.set()

    def _block(self, value: Any) -> str:
        options = self._options
        if options.nostr or options.noarr:
            from gazelle.cli.text.ros1_text import hidden

            value = hidden(value, self._type, strings=options.nostr, arrays=options.noarr)
        if isinstance(value, bytes):
            value = list(value)
        offset = Time(0, self._clock.now_ns()) if options.offset_time else None
        text = strify(value, time_offset=offset, width=self._width)
        return f"{_CLEAR if options.clear else ''}{text}\n---\n"

    def _row(self, value: Any) -> str:
        from gazelle.cli.text.ros1_text import csv_header, csv_row, field_filter

        options, now_ns = self._options, self._clock.now_ns()
        keep = field_filter(strings=options.nostr, arrays=options.noarr)
        head = csv_header(value, keep=keep) + "\n" if self.count == 1 else ""
        offset_ns = now_ns if options.offset_time else None
        return head + csv_row(value, now_ns, keep=keep, offset_ns=offset_ns) + "\n"


def _parser() -> OptionParser:
    parser = option_parser("rostopic", "echo [options] /topic")
    add, flag = parser.add_option, partial(add_flag, parser)
    add("-b", "--bag", dest="bag", metavar="BAGFILE", help="echo messages from .bag file")
    flag("-p", dest="plot", text="echo in a plotting friendly format")
    add("-w", dest="width", metavar="NUM_WIDTH", help="fixed width for numeric values")
    add(
        "--filter",
        dest="filter_expr",
        metavar="FILTER-EXPRESSION",
        help="Python expression to filter messages that are printed; it can use m (the message) "
        "and topic (its name)",
    )
    flag("--nostr", dest="nostr", text="exclude string fields")
    flag("--noarr", dest="noarr", text="exclude arrays")
    flag("-c", "--clear", dest="clear", text="clear screen before printing next message")
    flag("-a", "--all", dest="all_topics", text="display all messages in bag, needs -b")
    add("-n", dest="msg_count", metavar="COUNT", help="number of messages to echo")
    flag("--offset", dest="offset_time", text="display time as offset from current time")
    return parser


def _whole(parser: OptionParser, text: str | None, complaint: str) -> int | None:
    if not text:
        return None
    try:
        return int(text)
    except ValueError:
        parser.error(complaint)
