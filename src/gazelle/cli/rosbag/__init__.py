"""``rosbag``: its subcommands; `play` and `record` are the nodes of the same names."""

from __future__ import annotations

import threading

from gazelle.cli.ros_tool import Tool, join_graph, run_tool
from gazelle.graph import Graph, Node
from gazelle.graph.names import CommandLine, parse_command_line
from gazelle.process_lifetime import at_stop_signal

__all__ = ["main", "play", "record"]

_USAGE = """Usage: rosbag <subcommand> [options] [args]

A bag is a file format in ROS for storing ROS message data. The rosbag command can record, \
replay and manipulate bags.

Available subcommands:
   check  \tDetermine whether a bag is playable in the current system.
   compress  \tCompress one or more bag files.
   decompress  \tDecompress one or more bag files.
   filter  \tFilter the contents of the bag.
   fix  \tWrite a bag anew with the definitions of the current system.
   info  \tSummarize the contents of one or more bag files.
   play  \tPlay back the contents of one or more bag files in a time-synchronized fashion.
   record  \tRecord a bag file with the contents of specified topics.
   reindex  \tReindexes one or more bag files.

For additional information, see http://wiki.ros.org/rosbag
"""


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosbag``."""
    return run_tool(_TOOL, argv)


def play(argv: list[str]) -> int:
    """Play bags on the graph until they end, or until Ctrl-C."""
    from gazelle.bag.playing import Controls
    from gazelle.nodes.rosbag.play import play as play_bags
    from gazelle.nodes.rosbag.play import play_options

    line = parse_command_line(argv)
    options, paths = play_options(line.rest)
    controls = Controls(paused=options.pause)
    at_stop_signal(controls.stop)
    with join_graph() as graph:
        node = _node(graph, line, "play")
        node.on_shutdown(lambda _reason: controls.stop())
        return play_bags(node, options, paths, controls)


def record(argv: list[str]) -> int:
    """Record topics into a bag until Ctrl-C, or until a limit is reached."""
    from gazelle.nodes.rosbag.record import main_options
    from gazelle.nodes.rosbag.record import record as record_bag

    line = parse_command_line(argv)
    options, args = main_options(line.rest)
    stop = threading.Event()
    at_stop_signal(stop.set)
    with join_graph() as graph:
        node = _node(graph, line, "record")
        graph.clock.follow(node)
        node.on_shutdown(lambda _reason: stop.set())
        return record_bag(graph, node, options, args, stop)


def _node(graph: Graph, line: CommandLine, name: str) -> Node:
    return graph.create_node(
        line.name or name,
        namespace=line.namespace,
        remappings=line.remappings,
        anonymous=line.name is None,
    )


_TOOL = Tool(
    "rosbag",
    {
        "check": "gazelle.cli.rosbag.check:check",
        "compress": "gazelle.cli.rosbag.compress:compress",
        "decompress": "gazelle.cli.rosbag.compress:decompress",
        "filter": "gazelle.cli.rosbag.filter:run",
        "fix": "gazelle.cli.rosbag.check:fix",
        "info": "gazelle.cli.rosbag.info:run",
        "play": play,
        "record": record,
        "reindex": "gazelle.cli.rosbag.compress:reindex",
    },
    _USAGE,
    0,
    takes_remappings=False,
)
