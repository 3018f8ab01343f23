"""``view_frames``: listens for five seconds and draws the tree of frames.

tf's prints plain lines, tf2_tools's log lines; both write ``frames.gv`` and ``frames.pdf``.
"""

from __future__ import annotations

import argparse
import threading
import time
from pathlib import Path

from gazelle.cli.graphviz import typeset
from gazelle.cli.ros_tool import Tool, join_graph, run_tool
from gazelle.graph import Graph
from gazelle.graph.names import parse_command_line
from gazelle.graph.tf import TransformBuffer, TransformListener, frames_as_dot

__all__ = ["main"]

_LISTEN_S = 5.0
_TOOL = "view_frames"


def main(argv: list[str]) -> int:
    """Write the files into the current folder.

    Returns:
        0; 1 without a graph or when no PDF was made.
    """
    tokens = parse_command_line(argv).rest
    return run_tool(Tool(_TOOL, {"draw": _draw}, ""), ["draw", *tokens])


def _draw(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(prog=_TOOL, description="Draw the tree of frames.")
    parser.add_argument("--node", help="not offered: nodes answer no /tf_frames service here")
    parser.add_argument("--tf2", action="store_true", help="the log lines of tf2_tools")
    parser.add_argument("--wait-time", type=float, default=_LISTEN_S, help="seconds to listen")
    options = parser.parse_args(argv)
    if options.node:
        parser.error("--node is not offered: nodes answer no /tf_frames service here")
    with join_graph() as graph:
        if options.tf2:
            _say(f"Listening to tf data during {options.wait_time:g} seconds...")
        else:
            print(f"Listening to /tf for {options.wait_time:.1f} seconds", flush=True)
        text = _heard(graph, options.wait_time)
        if options.tf2:
            _say("Generating graph in frames.pdf file...")
        else:
            print("Done Listening", flush=True)
    Path("frames.gv").write_text(text, encoding="utf-8")
    made = typeset(Path("frames.gv"), Path("frames.pdf"), _TOOL)
    if made and not options.tf2:
        print("frames.pdf generated")
    return 0 if made else 1


def _heard(graph: Graph, listen_s: float) -> str:
    node = graph.create_node(_TOOL, anonymous=True)
    graph.clock.follow(node)
    ended = threading.Event()
    node.on_shutdown(lambda _reason: ended.set())
    buffer = TransformBuffer()
    TransformListener(buffer, node)
    ended.wait(listen_s)
    return frames_as_dot(buffer, graph.clock.now_ns())


def _say(text: str) -> None:
    print(f"[INFO] [{time.time():.6f}]: {text}", flush=True)
