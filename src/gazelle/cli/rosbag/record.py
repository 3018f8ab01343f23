"""``rosbag record``."""

from __future__ import annotations

import threading

from gazelle.cli.tool import joined
from gazelle.graph.names import parse_command_line
from gazelle.nodes.rosbag.record import main_options, record
from gazelle.process_exit import at_stop_signal

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Record topics into a bag until Ctrl-C, or until a limit is reached."""
    line = parse_command_line(words)
    options, args = main_options(line.rest)
    stop = threading.Event()
    at_stop_signal(stop.set)
    with joined() as graph:
        node = graph.create_node(
            line.name or "record",
            namespace=line.namespace,
            remappings=line.remappings,
            anonymous=line.name is None,
        )
        graph.clock.follow(node)
        node.on_shutdown(lambda _reason: stop.set())
        return record(graph, node, options, args, stop)
