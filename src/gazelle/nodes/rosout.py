"""``rosout``: what every node logs, gathered on /rosout_agg and in ``rosout.log``."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from logging import Formatter, Handler, LogRecord, NullHandler
from pathlib import Path
from typing import Any

from gazelle.graph import Entity, Graph, Kind, Level, Node
from gazelle.graph.names import resolve
from gazelle.interfaces import ros1_message_type
from gazelle.log_handlers import RotatingLog
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["line_of", "run"]

_FILE_BYTES = 100_000_000
_FILES = 10
_MAX_CHARACTERS = 1 << 20
_LOOK_S = 0.5


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Pass log messages on until told to stop.

    Only one node of a graph does. Launches that start at the same moment each bring one: all but
    one stand by, and the next takes over when that one ends, as it comes back itself when it is
    killed (``respawn`` in ROS 1's roscore.xml).
    """
    name = resolve(arguments.name, resolve(arguments.namespace or "/"))
    file = _file(arguments.log_file)
    node: Node | None = None
    known = graph.entities()
    while True:
        # Of two that began together the graph ends one.
        if (node is None or node.closed) and not _has_namesake(name, graph, known):
            node = start_node(arguments, graph)
            _gather(node, file)
        if stop.wait(_LOOK_S):
            break
        known = graph.discovery.known()
    if node is not None:
        node.shutdown()
    file.close()
    return 0


def _gather(node: Node, file: Handler) -> None:
    log_type = ros1_message_type("rosgraph_msgs/Log")
    out = node.create_publisher("/rosout_agg", log_type, queue_size=100)

    def on_log(message: Any) -> None:
        out.publish(message)
        _write(file, line_of(message))

    _write(file, f"{node.clock.now_ns() / 1e9:.9f} Node Startup")
    node.create_subscription("/rosout", log_type, on_log, queue_size=0)


def _has_namesake(name: str, graph: Graph, known: Iterable[Entity]) -> bool:
    """Tell whether another process has a node of that name."""
    return any(one.kind is Kind.NODE and one.node == name and one.zid != graph.zid for one in known)


def line_of(message: Any) -> str:
    """Return a ``rosgraph_msgs/Log`` as a line of ``rosout.log``, the layout of ROS 1.

    One message cannot fill a disk: what is longer than a million characters is cut off.
    """
    stamp = message.header.stamp
    place = f"[{message.file}:{message.line}({message.function})]"
    topics = f"[topics: {', '.join(message.topics)}]"
    level = Level(message.level).name if message.level in set(Level) else str(message.level)
    head = f"{stamp.secs}.{stamp.nsecs:09d} {level} {message.name}"
    text = message.msg
    if len(text) > _MAX_CHARACTERS:
        text = f"{text[:_MAX_CHARACTERS]}… ({len(text)} characters in all)"
    return f"{head} {place} {topics} {text}"


def _file(own_log: str) -> Handler:
    """Open ``rosout.log`` beside the node's own log, nothing for a node without one."""
    if not own_log:
        handler: Handler = NullHandler()
    else:
        path = Path(own_log).with_name("rosout.log")
        path.parent.mkdir(parents=True, exist_ok=True)
        handler = RotatingLog(
            path, maxBytes=_FILE_BYTES, backupCount=_FILES, encoding="utf-8", errors="replace"
        )
    handler.setFormatter(Formatter("%(message)s"))
    return handler


def _write(file: Handler, line: str) -> None:
    file.handle(LogRecord("rosout", 0, "", 0, line, None, None))
