"""``rostopic pub``."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Iterator
from functools import partial
from optparse import OptionParser, Values
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.cli.ros_tool import ToolError, add_flag, global_name, join_graph, option_parser
from gazelle.cli.ros_types import message_class, shown_type
from gazelle.cli.rostopic.topics import join_as_node
from gazelle.cli.text.fill_message import documents, fill_from_words, yaml_words
from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import ANY_TYPE, Graph, Publisher, TimeJumpError
from gazelle.interfaces import Ros1Message

__all__ = ["run"]

_ONCE_S = 3.0
_LISTENER_S = 5.0
_STREAM_RATE_HZ = 10.0
_MATCH_S = 0.01


class _Job(NamedTuple):
    """All that publishing needs."""

    graph: Graph
    publisher: Publisher
    kind: type[Ros1Message]
    options: Values
    rate_hz: float | None
    ended: threading.Event

    def message(self, values: Any) -> Ros1Message:
        made = self.kind()
        fill_from_words(made, values, self.graph.clock.now_ns())
        return made

    def publish(self, message: Ros1Message) -> None:
        try:
            self.publisher.publish(message)
        except GraphError:
            # The node may be killed at any moment.
            if not self.ended.is_set():
                raise


def run(argv: list[str]) -> int:
    """Publish messages on a topic."""
    parser = _parser()
    options, args = parser.parse_args(argv)
    rate_hz = _rate(parser, options)
    if len(args) < 2:
        parser.error("topic type must be specified" if args else "/topic must be specified")
    if len(args) > 2 and options.file:
        parser.error("args conflict with -f setting")
    values = yaml_words(args[2:])
    topic, type_name = global_name(args[0], "rostopic"), args[1]
    with join_graph() as graph:
        kind = _kind(type_name)
        if not values and kind._names and not options.file and sys.stdin.isatty():
            parser.error("Please specify message values")
        _warn_of_other_type(graph, topic, shown_type(type_name))
        node, ended = join_as_node(graph, clock=options.use_rostime, rosout=False)
        publisher = node.create_publisher(
            topic, kind, latch=rate_hz is None or options.latch, queue_size=100
        )
        job = _Job(graph, publisher, kind, options, rate_hz, ended)
        if values or not kind._names:
            _publish_values(job, values)
        else:
            _publish_stream(job)
    return 0


def _publish_values(job: _Job, values: Any) -> None:
    if job.rate_hz is not None:
        _publish_at_rate(job, values, job.rate_hz)
        return
    _publish_latched(job, values, once=job.options.once)
    job.ended.wait(_ONCE_S if job.options.once else None)


def _publish_latched(job: _Job, values: Any, *, once: bool) -> None:
    message = job.message(values)
    shown = f"[{message}]" if job.options.verbose else "message"
    end = f" for {_ONCE_S} seconds" if once else ". Press ctrl-C to terminate"
    print(f"publishing and latching {shown}{end}", flush=True)
    job.publish(message)


def _publish_at_rate(job: _Job, values: Any, rate_hz: float) -> None:
    message = job.message(values)
    for _ in _ticks(job, rate_hz):
        if job.options.substitute_keywords:
            message = job.message(values)
        if job.options.verbose:
            print(f"publishing {message}", flush=True)
        job.publish(message)


def _ticks(job: _Job, rate_hz: float) -> Iterator[None]:
    """Yield at a rate, until the node ends."""
    clock, period_ns = job.graph.clock, round(1e9 / rate_hz)
    next_ns = clock.now_ns()
    while not job.ended.is_set():
        yield
        next_ns += period_ns
        try:
            if not clock.sleep_until(next_ns):
                return
        except TimeJumpError:
            next_ns = clock.now_ns()
        if clock.now_ns() > next_ns + period_ns:
            next_ns = clock.now_ns()


def _publish_stream(job: _Job) -> None:
    """Publish the documents of a file or of standard input, one after the other."""
    options, rate_hz = job.options, job.rate_hz
    if rate_hz is None and not options.latch and not options.once:
        rate_hz = _STREAM_RATE_HZ
    items = iter(_file_documents(options.file)) if options.file else documents(sys.stdin)
    _wait_for_listener(job)
    if options.file and rate_hz is not None:
        found = list(items)
        if len(found) == 1:
            print("Got one message and a rate, publishing repeatedly", flush=True)
            _publish_at_rate(job, _as_list(found[0]), rate_hz)
            return
        items = iter(found)
    ticks = _ticks(job, rate_hz) if rate_hz else iter(lambda: None, 0)
    blocks = rate_hz is None and not options.once
    for values, _ in zip(items, ticks, strict=False):
        _publish_latched(job, _as_list(values), once=not blocks)
        if blocks:
            job.ended.wait()
        if options.once:
            job.ended.wait(_ONCE_S)
            return


def _wait_for_listener(job: _Job) -> None:
    """Give somebody the chance to hear a stream, which is over fast."""
    deadline_s = time.monotonic() + _LISTENER_S
    while not job.publisher.matched and time.monotonic() < deadline_s:
        if job.ended.wait(_MATCH_S):
            return


def _file_documents(name: str) -> list[Any]:
    from gazelle.documents import read_text_limited
    from gazelle.documents.yaml import YamlError, load_yaml_documents

    path = Path(name)
    if not path.is_file():
        raise ToolError(f"file does not exist: {name}")
    try:
        found = load_yaml_documents(read_text_limited(path))
    except OSError as error:
        raise ToolError(f"cannot read {name}: {error.strerror}") from None
    except (YamlError, UnicodeDecodeError) as error:
        raise ToolError(f"invalid YAML in file: {error}") from None
    return [one for one in found if one is not None]


def _as_list(values: Any) -> Any:
    return values if isinstance(values, list) else [values]


def _kind(type_name: str) -> type[Ros1Message]:
    try:
        return message_class(type_name)
    except NotFoundError as error:
        word = "message" if "/" in type_name else "topic"
        raise ToolError(f"invalid {word} type: {type_name}\n  {error}") from None


def _warn_of_other_type(graph: Graph, topic: str, type_name: str) -> None:
    for one in graph.topics():
        other = shown_type(one.type_name)
        if one.name == topic and other not in (type_name, ANY_TYPE):
            print(
                f"WARNING: {topic} has type {other}, you publish {type_name}; "
                "its subscribers drop that",
                file=sys.stderr,
            )


def _rate(parser: OptionParser, options: Values) -> float | None:
    if options.rate is None:
        return None
    if options.once:
        parser.error("You cannot select both -r and -1 (--once)")
    try:
        rate_hz = float(options.rate)
    except ValueError:
        parser.error("rate must be a number")
    if rate_hz <= 0:
        parser.error("rate must be greater than zero")
    return rate_hz


def _parser() -> OptionParser:
    parser = option_parser("rostopic", "pub /topic type [args...]")
    add, flag = parser.add_option, partial(add_flag, parser)
    flag("-v", dest="verbose", text="print verbose output")
    add("-r", "--rate", help="publishing rate (hz); for -f and stdin input, this defaults to 10")
    flag("-1", "--once", dest="once", text="publish one message and exit")
    add("-f", "--file", metavar="FILE", help="read args from YAML file (Bagy)")
    flag(
        "-l",
        "--latch",
        dest="latch",
        text="enable latching for -f, -r and piped input; this latches the first message",
    )
    flag(
        "-s",
        "--substitute-keywords",
        dest="substitute_keywords",
        text="with a rate, substitute 'now' and 'auto' afresh for each message",
    )
    flag(
        "--use-rostime",
        dest="use_rostime",
        text="use rostime for time stamps, else walltime is used",
    )
    return parser
