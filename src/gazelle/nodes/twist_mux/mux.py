"""``twist_mux twist_mux``: passes on the velocities of the highest topic that is not held.

Each message is decided on its own when it comes: topics whose last message is too old, and those
below the highest lock that holds, do not count. Nothing is sent between messages.

Names, limits and texts are those of ros-teleop's ``twist_mux`` (noetic, humble, rolling).
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node, ticks
from gazelle.nodes.twist_mux.parameters import USE_STAMPED, Choice, Input, is_stamped, read_inputs
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "run"]

_LISTED = "ROS 1: a list of `{name, topic, timeout, priority}`"
PARAMETERS = ParameterTable(
    "twist_mux",
    "Passes on the velocities of the topic with the highest priority that is not held.",
    ("twist_mux/twist_mux",),
    (
        Parameter("topics", "any", None, f"{_LISTED} of velocities"),
        Parameter("topics.<name>.topic", "text", None, "ROS 2: a topic of velocities"),
        Parameter("topics.<name>.timeout", "number", None, "its last one is too old; 0 never", "s"),
        Parameter("topics.<name>.priority", "integer", None, "1 to 255, the highest passes"),
        Parameter("locks", "any", None, f"{_LISTED} of locks"),
        Parameter("locks.<name>.topic", "text", None, "ROS 2: a topic of `std_msgs/Bool`"),
        Parameter("locks.<name>.timeout", "number", None, "silent so long it holds; 0 never", "s"),
        Parameter("locks.<name>.priority", "integer", None, "0 to 255, holds topics below it"),
        USE_STAMPED,
    ),
)

_SECOND_NS = 1_000_000_000
_BOOL = "std_msgs/msg/Bool"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Choose until told to stop."""
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        if own.raw("use_sim_time") in (True, "true", "True"):
            node.clock.use(True)
        choice, stamped = _choice(own), is_stamped(own)
    _Mux(node, choice, stamped=stamped)
    tell = _diagnostics(node, choice)
    arguments.ready()
    for now_ns in ticks(node, _SECOND_NS, stop):
        tell(now_ns)
    node.shutdown()
    return 0


def _choice(own: ParameterReader) -> Choice:
    topics, locks = (
        read_inputs(kind, own.raw(kind), own.name, own.diagnostics) for kind in ("topics", "locks")
    )
    if not topics:
        text = "no topic is given, so nothing will ever come on cmd_vel_out"
        fix = f"give 'topics'; a file of ROS 2 begins with the node's name, {own.name}, or /**"
        own.report("parameter.bad-value", text, fix=fix)
    return Choice(topics, locks)


class _Mux:
    def __init__(self, node: Node, choice: Choice, *, stamped: bool) -> None:
        self._node, self._choice = node, choice
        self._lock = threading.Lock()
        kind = f"geometry_msgs/msg/Twist{'Stamped' if stamped else ''}"
        self._out = node.create_publisher("cmd_vel_out", message_type(kind), queue_size=1)
        for one in choice.topics:
            node.create_subscription(one.topic, kind, self._passer(one), queue_size=1)
        for one in choice.locks:
            node.create_subscription(one.topic, _BOOL, self._holder(one), queue_size=1)
        for one in (*choice.topics, *choice.locks):
            timeout = f"{one.timeout_s:f}s" if one.timeout_s > 0 else "None"
            node.log(
                "info",
                f"Topic handler '{one.name}' subscribed to topic '{one.topic}': "
                f"timeout = {timeout}, priority = {one.priority}.",
            )

    def _passer(self, one: Input) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            with self._lock:
                now_ns = one.heard_ns = self._node.clock.now_ns()
                passes = self._choice.passes(one, now_ns)
            if passes:
                self._out.publish(message)

        return take

    def _holder(self, one: Input) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            with self._lock:
                one.heard_ns, one.locked = self._node.clock.now_ns(), bool(message.data)

        return take


def _diagnostics(node: Node, choice: Choice) -> Callable[[int], None]:
    """Return what tells the state on ``/diagnostics``."""
    kinds = [message_type(f"diagnostic_msgs/msg/{name}")
             for name in ("DiagnosticArray", "DiagnosticStatus", "KeyValue")]  # fmt: skip
    array, status, value = kinds
    out = node.create_publisher("/diagnostics", array, queue_size=1)

    def tell(now_ns: int) -> None:
        held = choice.lock_priority(now_ns)
        rows = [
            (f"velocity {one.name}", "masked" if one.is_masked(now_ns, held) else "unmasked", one)
            for one in choice.topics
        ]
        rows += [
            (f"lock {one.name}", "locked" if one.is_locked(now_ns) else "free", one)
            for one in choice.locks
        ]
        values = [value(key=key, value=_state(word, one)) for key, word, one in rows]
        values.append(value(key="current priority", value=str(held)))
        name = f"{node.name.strip('/')}: Twist mux status"
        message: Any = array(
            status=[status(name=name, message="ok", hardware_id="none", values=values)]
        )
        set_header(message, now_ns, "")
        out.publish(message)

    return tell


def _state(word: str, one: Input) -> str:
    return f" {word} (listening to {one.topic} @ {one.timeout_s:f}s with priority #{one.priority})"
