"""``rosbag play``."""

from __future__ import annotations

from gazelle.bag.playing import Controls
from gazelle.cli.tool import joined
from gazelle.graph.names import parse_command_line
from gazelle.nodes.rosbag.play import play, play_options
from gazelle.process_exit import at_stop_signal

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Play bags on the graph until they end, or until Ctrl-C."""
    line = parse_command_line(words)
    options, paths = play_options(line.rest)
    controls = Controls(paused=options.pause)
    at_stop_signal(controls.stop)
    with joined() as graph:
        node = graph.create_node(
            line.name or "play",
            namespace=line.namespace,
            remappings=line.remappings,
            anonymous=line.name is None,
        )
        node.on_shutdown(lambda _reason: controls.stop())
        return play(node, options, paths, controls)
