"""``ros2 bag record``."""

from __future__ import annotations

import argparse
import re
import sys
import threading
import time
from functools import partial
from pathlib import Path

from gazelle.bag.formats import MCAP, ROS1, storage_names
from gazelle.bag.playing.controls import keyboard
from gazelle.bag.recording import Limits, Recorder, Selection
from gazelle.bag.rosbag2 import Rosbag2Writer
from gazelle.cli.ros2.bag import log_line
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal

__all__ = ["main"]

_say = partial(log_line, "rosbag2_recorder")


def main(argv: list[str]) -> int:
    """Record topics until Ctrl-C."""
    options = _options(argv)
    stop = threading.Event()
    at_stop_signal(stop.set)
    with Graph.open(role="client") as graph:
        return _record(graph, options, stop)


def _record(graph: Graph, options: argparse.Namespace, stop: threading.Event) -> int:
    learn_workspace_types()
    node = graph.create_node(options.node_name)
    node.on_shutdown(lambda _reason: stop.set())
    if options.use_sim_time:
        graph.clock.use(True)
        graph.clock.follow(node)
    selection = _selection(options)
    compression = options.compression_format if options.compression_mode != "none" else ""
    sink = Rosbag2Writer(Path(options.output), options.storage, compression=compression)
    limits = Limits(
        options.max_bag_size,
        int(options.max_bag_duration * 1e9),
        split=True,
        buffer=options.max_cache_size,
    )
    paused = [options.start_paused]

    def tell(level: str, text: str) -> None:
        topic = text.removeprefix("Subscribing to ")
        _say(level, f"Subscribed to topic '{topic}'" if topic != text else text)

    recorder = Recorder(graph, node, sink, limits=limits, say=tell)
    recorder.pause(paused[0])

    def on_key(key: str) -> None:
        if key == " ":
            paused[0] = not paused[0]
            recorder.pause(paused[0])
            _say("info", "Pausing recording." if paused[0] else "Resuming recording.")

    _say("info", "Press SPACE for pausing/resuming")
    _say("info", "Listening for topics...")
    recorder.begin(selection)
    _say("info", "Recording...")
    with keyboard(on_key):
        recorder.run(selection, stop)
    _say("info", "Recording stopped")
    return 0


def _selection(options: argparse.Namespace) -> Selection:
    topics = [*options.topics, *(options.topics_option or [])]
    names = tuple(dict.fromkeys(f"/{topic.lstrip('/')}" for topic in topics))
    try:
        patterns = tuple(re.compile(text) for text in filter(None, [options.regex]))
        exclude = re.compile(options.exclude) if options.exclude else None
    except re.error as error:
        raise GazelleError(f"not a regular expression: {error}") from None
    return Selection(names, options.all, patterns, exclude, hidden=options.include_hidden_topics)


def _options(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="ros2 bag record", description="Record ROS data to a bag")
    add, flag = parser.add_argument, partial(parser.add_argument, action="store_true")
    add("topics", nargs="*", help="topics to be recorded")
    add("--topics", nargs="+", dest="topics_option", help="topics to be recorded")
    flag("-a", "--all", help="Record all topics")
    flag("--all-topics", dest="all", help="Record all topics")
    add("-e", "--regex", default="", help="Record topics that match this regular expression")
    add("-x", "--exclude", "--exclude-regex", default="", help="Leave these topics out")
    add("-o", "--output", help="Destination of the bag; the date by default")
    known = [name for name in storage_names() if name != ROS1.name]
    add("-s", "--storage", choices=known, default=MCAP.name, help="Format of the files")
    whole, real = partial(add, type=int, default=0), partial(add, type=float, default=0.0)
    whole("-b", "--max-bag-size", help="Bytes of a file before it is split; 0: never")
    real("-d", "--max-bag-duration", help="Seconds of a file before it is split; 0: never")
    add("--max-cache-size", type=int, default=100 << 20, help="Bytes that may wait to be written")
    add("--compression-mode", choices=["none", "storage"], default="none", help="What to compress")
    add("--compression-format", choices=["zstd", "lz4"], default="zstd", help="How to compress")
    flag("--include-hidden-topics", help="Record hidden topics too")
    flag("--use-sim-time", help="Stamp messages with /clock")
    flag("--start-paused", help="Start paused")
    add("--node-name", default="rosbag2_recorder", help="Name of the recorder's node")
    options = parser.parse_args(argv)
    if not (options.all or options.regex or options.topics or options.topics_option):
        print("Invalid choice: Must specify topic(s) or --all-topics", file=sys.stderr)
        sys.exit(1)
    if options.output is None:
        options.output = time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S")
    return options
