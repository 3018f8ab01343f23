"""``rosbag record``."""

from __future__ import annotations

import re
import threading
from functools import partial
from optparse import OptionParser, Values

from gazelle.bag.formats import ROS1
from gazelle.bag.recording import Limits, Recorder, Ros1Files, Selection, default_stem
from gazelle.bag.ros1 import Compression
from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.nodes.rosbag.options import add_flag, option_parser
from gazelle.nodes.workspace_types import learn_workspace_types

__all__ = ["main_options", "record", "run"]

_UNITS_S = {"s": 1, "m": 60, "h": 3600}


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Record as ``rosbag record`` does; the node of launch files."""
    options, args = main_options(list(arguments.rest))
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    return record(graph, node, options, args, stop)


def main_options(argv: list[str]) -> tuple[Values, list[str]]:
    """Return the options and the topics; ends the process when they are wrong."""
    parser = _parser()
    options, args = parser.parse_args(argv)
    if not args and not options.all and not options.node and not options.exclude:
        parser.error("You must specify a topic name or else use the '-a' option.")
    if options.prefix is not None and options.name is not None:
        parser.error("Can't set both prefix and name.")
    if options.split and not options.duration and not options.size:
        parser.error("Split specified without giving a maximum duration or size")
    for name in ("size", "buffsize", "chunksize", "num"):
        if (getattr(options, name) or 0) < 0:
            parser.error(f"option --{name}: must be 0 or positive")
    if options.duration and _duration_ns(options.duration) is None:
        parser.error(f"option --duration: '{options.duration}' is not a time such as 30, 5m or 2h")
    return options, args


def record(
    graph: Graph, node: Node, options: Values, args: list[str], stop: threading.Event
) -> int:
    """Record as the options say.

    Raises:
        GazelleError: a regular expression is none.
        BagError: the bag cannot be written.
    """
    learn_workspace_types()
    selection = _selection(node, options, args)
    sink = _files(options)

    def say(level: str, text: str) -> None:
        if level != "info" or not options.quiet:
            node.log(level, text)

    limits = Limits(
        (options.size or 0) << 20,
        _duration_ns(options.duration or "") or 0,
        options.split,
        options.num,
        options.buffsize << 20,
    )
    recorder = Recorder(graph, node, sink, limits=limits, say=say)
    recorder.begin(selection)
    say("info", f"Recording to '{sink.path}'.")
    if options.publish:
        begin = node.create_publisher(
            "begin_write", message_type("std_msgs/msg/String"), latch=True
        )
        begin.publish(begin.message_class(data=str(sink.path)))
    recorder.run(selection, stop)
    return 0


def _selection(node: Node, options: Values, args: list[str]) -> Selection:
    exclude = _pattern(options.exclude) if options.exclude else None
    every = options.all or bool(exclude and not args)
    if options.regex:
        return Selection((), every, tuple(map(_pattern, args)), exclude, hidden=False)
    topics = tuple(dict.fromkeys(map(node.resolve_name, args)))
    watched = node.resolve_name(options.node) if options.node else ""
    # What the graph hides has no counterpart in ROS 1: ROS 2's actions, turtlesim's picture.
    return Selection(topics, every, (), exclude, watched, hidden=False)


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise GazelleError(f"'{text}' is not a regular expression: {error}") from None


def _files(options: Values) -> Ros1Files:
    name = None if options.name is None else options.name.removesuffix(ROS1.suffix)
    return Ros1Files(
        (lambda: str(name)) if name is not None else partial(default_stem, options.prefix or ""),
        split=options.split,
        compression=Compression(options.compression or "none"),
        chunk_bytes=max(options.chunksize, 1) << 10,
        most_files=options.max_splits or 0,
        repeat_latched=options.repeat_latched,
    )


def _duration_ns(text: str) -> int | None:
    match = re.fullmatch(r"(\d+(?:\.\d*)?)([smh]?)", text)
    return int(float(match[1]) * _UNITS_S[match[2] or "s"] * 1e9) if match else None


def _parser() -> OptionParser:
    parser = option_parser("record TOPIC1 [TOPIC2 TOPIC3 ...]")
    add, flag = parser.add_option, partial(add_flag, parser)
    flag("-a", "--all", dest="all", text="record all topics")
    flag("-e", "--regex", dest="regex", text="match topics using regular expressions")
    flag("-p", "--publish", dest="publish", text="publish a msg when the record begin")
    add("-x", "--exclude", metavar="EXCLUDE_REGEX", help="leave these topics out")
    flag("-q", "--quiet", dest="quiet", text="suppress console output")
    add("-o", "--output-prefix", dest="prefix", help="start the bag's name, which is the date")
    add("-O", "--output-name", dest="name", help="record to bag with name NAME.bag")
    flag("--split", dest="split", text="go on in a new bag at the maximum size or duration")
    add("--max-splits", type="int", help="keep so many bags, delete the oldest")
    add("--size", type="int", metavar="SIZE", help="record a bag of maximum size SIZE MB")
    add("--duration", metavar="DURATION", help="record so many seconds, m or h may follow")
    add("-b", "--buffsize", type="int", default=256, metavar="SIZE", help="buffer of SIZE MB (256)")
    add("--chunksize", type="int", default=768, metavar="SIZE", help="chunks of SIZE KB (768)")
    add("-l", "--limit", dest="num", type="int", default=0, help="only NUM messages per topic")
    add("--node", help="record all topics subscribed to by a specific node")
    choose = partial(add, dest="compression", action="store_const")
    choose("-j", "--bz2", const="bz2", help="use BZ2 compression")
    choose("--lz4", const="lz4", help="use LZ4 compression")
    flag("--tcpnodelay", dest="nodelay", text="accepted: nothing waits for full packets here")
    flag("--udp", dest="udp", text="accepted: messages come over the graph's own transport")
    flag("--repeat-latched", dest="repeat_latched", text="repeat latched messages in every bag")
    return parser
