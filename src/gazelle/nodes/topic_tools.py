"""``relay``, ``throttle`` and ``drop`` of topic_tools, for messages of any type."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node, Publisher
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run_drop", "run_relay", "run_throttle"]

_Passes = Callable[[Node], bool]


def run_relay(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish every message again: ``relay IN [OUT]``."""
    words = _words(arguments, 1, "relay IN_TOPIC [OUT_TOPIC]")
    return _pass_on(arguments, graph, stop, words, "_relay", lambda _node: True)


def run_throttle(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish at most so many messages a second: ``throttle messages IN HZ [OUT]``."""
    usage = "throttle messages IN_TOPIC MSGS_PER_SEC [OUT_TOPIC]"
    kind, topic, rate, *out = _words(arguments, 3, usage)
    if kind != "messages":
        raise LaunchError(f"throttle '{kind}' is not offered, only by messages\nusage: {usage}")
    period_ns = int(1e9 / _number(rate, usage))
    last_ns = [-period_ns]

    def is_due(node: Node) -> bool:
        now_ns = node.clock.now_ns()
        # Time that went back starts anew.
        due = now_ns >= last_ns[0] + period_ns or now_ns < last_ns[0]
        if due:
            last_ns[0] = now_ns
        return due

    return _pass_on(arguments, graph, stop, [topic, *out], "_throttle", is_due)


def run_drop(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Leave out X of every Y messages: ``drop IN X Y [OUT]``."""
    usage = "drop IN_TOPIC X Y [OUT_TOPIC]"
    topic, x, y, *out = _words(arguments, 3, usage)
    dropped, cycle = int(_number(x, usage)), int(_number(y, usage))
    count = [0]

    def passes(_node: Node) -> bool:
        place = count[0] % cycle
        count[0] += 1
        return place >= dropped

    return _pass_on(arguments, graph, stop, [topic, *out], "_drop", passes)


def _pass_on(
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
    topics: list[str],
    suffix: str,
    passes: _Passes,
) -> int:
    node = start_node(arguments, graph)
    source = topics[0]
    target = topics[1] if len(topics) > 1 else f"{source}{suffix}"
    made: list[Publisher] = []

    def on_message(message: Any) -> None:
        # The type is known with the first message.
        if not made:
            made.append(node.create_publisher(target, type(message), latch=False))
        if passes(node):
            made[0].publish(message)

    node.create_subscription(source, None, on_message)
    stop.wait()
    node.shutdown()
    return 0


def _words(arguments: NodeArguments, least: int, usage: str) -> list[str]:
    words = list(arguments.rest)
    if not least <= len(words) <= least + 1:
        raise LaunchError(f"{len(words)} arguments given\nusage: {usage}")
    return words


def _number(word: str, usage: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = 0.0
    if value <= 0:
        raise LaunchError(f"'{word}' is not a positive number\nusage: {usage}")
    return value
