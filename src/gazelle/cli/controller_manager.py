"""``controller_manager``: lists, loads, starts, stops and unloads controllers of ROS 1."""

from __future__ import annotations

import os
import sys
import threading

from gazelle.cli.error_text import error_text
from gazelle.cli.ros_tool import ToolError, join_graph
from gazelle.graph.names import parse_command_line
from gazelle.nodes.controller_manager.command import USAGE, command

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run a command on the controller manager of the namespace."""
    line = parse_command_line(argv)
    if not line.rest or line.rest[0] in {"-h", "--help"}:
        print(USAGE)
        return 0
    namespace = line.namespace or os.environ.get("ROS_NAMESPACE") or "/"
    try:
        with join_graph() as graph:
            node = graph.create_node("controller_manager", namespace=namespace, anonymous=True)
            return command(node, line.rest, threading.Event())
    except ToolError as error:
        print(f"ERROR: {error_text(error)}", file=sys.stderr)
        return 1
