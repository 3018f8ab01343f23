"""``relay``, ``throttle`` and ``drop`` of topic_tools, for messages of any type."""

from __future__ import annotations

import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.graph import Graph, MessageInfo, Node, Publisher, RawMessage, Subscription
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import node_reader, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, refused

__all__ = ["PARAMETERS", "run_drop", "run_relay", "run_throttle"]

_IN_PLACE_OF_WORDS: tuple[tuple[str, ParameterKind, None, str, str], ...] = (
    ("input_topic", "text", None, "what is passed on", ""),
    ("output_topic", "text", None, "where; with _relay, _throttle or _drop behind if absent", ""),
    ("throttle_type", "text", None, "messages or bytes", ""),
    ("msgs_per_sec", "number", None, "so many messages pass throttle", "Hz"),
    ("bytes_per_sec", "number", None, "so many bytes pass throttle", "B/s"),
    ("window", "number", None, "bytes are counted so long", "s"),
    ("X", "integer", None, "drop leaves out so many", ""),
    ("Y", "integer", None, "of so many messages", ""),
)
PARAMETERS = ParameterTable(
    "relay, throttle and drop",
    "Pass messages of any type on: all, so many a second, or all but some. Parameters count in the"
    " place of words where no words are given, as they do for components.",
    ("topic_tools/relay", "topic_tools/throttle", "topic_tools/drop"),
    (
        Parameter("lazy", "flag", False, "listen only while somebody listens to what comes out"),
        Parameter(
            "wall_clock", "flag", False, "throttle by the machine's time",
            aliases=("use_wall_clock",),
        ),
        *(Parameter(*row, ros_versions=(2,)) for row in _IN_PLACE_OF_WORDS),
        *refused("messages go the way that publisher and subscriber share", "unreliable",
                 unless=False),
        *refused("the topic is listened to itself", "stealth", unless=False),
        *refused("the topic is listened to itself", "monitor_topic", "monitor_rate"),
    ),
)  # fmt: skip

_Passes = Callable[[int], bool]
_LOOK_S = 0.05
_CDR_HEAD = 4  # bytes that ROS 1's messages do not have
_THROTTLE = """throttle messages IN_TOPIC MSGS_PER_SEC [OUT_TOPIC]
   or: throttle bytes IN_TOPIC BYTES_PER_SEC WINDOW [OUT_TOPIC]"""


def run_relay(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish every message again: ``relay IN [OUT]``."""
    given = _given(arguments, "input_topic", "output_topic")
    argv = _checked(given, 1, "relay IN_TOPIC [OUT_TOPIC]")
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        lazy = own.flag("lazy")
    tool = _Tool(node, lazy, argv, "_relay", lambda _size: True)
    return tool.run(stop, lambda text: node.log("info", text))


def run_throttle(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish at most so many messages, or bytes, a second.

    ``throttle messages IN HZ [OUT]`` or ``throttle bytes IN BYTES_PER_SEC WINDOW [OUT]``.
    """
    by_parameters = next(iter(_given(arguments, "throttle_type")), "")
    limits_of = ("bytes_per_sec", "window") if by_parameters == "bytes" else ("msgs_per_sec",)
    argv = _given(arguments, "throttle_type", "input_topic", *limits_of, "output_topic")
    kind = next(iter(argv), "")
    if kind not in ("messages", "bytes"):
        raise LaunchError(f"'{kind}' is neither 'messages' nor 'bytes'\nusage: {_THROTTLE}")
    if kind == "messages":
        _, topic, rate, *out = _checked(argv, 3, _THROTTLE)
        limits = (_number(rate, _THROTTLE), 0.0)
    else:
        _, topic, rate, window, *out = _checked(argv, 4, _THROTTLE)
        limits = (_number(rate, _THROTTLE), _number(window, _THROTTLE))
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        now_ns = time.time_ns if own.flag("wall_clock") else node.clock.now_ns
        lazy = own.flag("lazy")
    passes = _by_bytes(*limits, now_ns) if kind == "bytes" else _by_rate(node, limits[0], now_ns)
    return _Tool(node, lazy, [topic, *out], "_throttle", passes).run(stop)


def run_drop(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Leave out X of every Y messages: ``drop IN X Y [OUT]``."""
    usage = "drop IN_TOPIC X Y [OUT_TOPIC]"
    argv = _given(arguments, "input_topic", "X", "Y", "output_topic")
    topic, x, y, *out = _checked(argv, 3, usage)
    dropped, cycle = int(_number(x, usage)), int(_number(y, usage))
    count = [0]

    def passes(_size: int) -> bool:
        index = count[0] % cycle
        count[0] += 1
        return index >= dropped

    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        lazy = own.flag("lazy")
    return _Tool(node, lazy, [topic, *out], "_drop", passes).run(stop)


def _by_rate(node: Node, rate_hz: float, now_ns: Callable[[], int]) -> _Passes:
    period_ns = int(1e9 / rate_hz)
    last_ns = [0]

    def passes(_size: int) -> bool:
        now = now_ns()
        if last_ns[0] > now:
            node.log("warn", "Detected jump back in time, resetting throttle period to now for.")
            last_ns[0] = now
        due = now - last_ns[0] > period_ns
        if due:
            last_ns[0] = now
        return due

    return passes


def _by_bytes(bytes_per_s: float, window_s: float, now_ns: Callable[[], int]) -> _Passes:
    """Pass while the bytes of the window are less than those of a second, as topic_tools does."""
    sent: deque[tuple[int, int]] = deque()
    window_ns = int(window_s * 1e9)

    def passes(size: int) -> bool:
        now = now_ns()
        while sent and (sent[0][0] < now - window_ns or sent[0][0] > now):
            sent.popleft()
        if sum(one for _, one in sent) >= int(bytes_per_s):
            return False
        sent.append((now, size))
        return True

    return passes


class _Tool:
    """Publishes what passes; with ``~lazy`` it listens only while somebody listens to it."""

    def __init__(
        self,
        node: Node,
        lazy: bool,
        topics: list[str],
        suffix: str,
        passes: _Passes,
    ) -> None:
        self._tell: Callable[[str], None] = _print
        self._node = node
        self._source = topics[0]
        self._target = topics[1] if len(topics) > 1 else f"{topics[0]}{suffix}"
        self._passes = passes
        self._lazy = lazy
        self._publisher: Publisher | None = None
        self._subscription: Subscription | None = None

    def run(self, stop: threading.Event, tell: Callable[[str], None] | None = None) -> int:
        """Pass messages on until told to stop; tells once under what name."""
        self._tell = tell or _print
        self._listen()
        if not self._lazy:
            stop.wait()
        while not stop.wait(_LOOK_S):
            wanted = self._publisher is None or self._publisher.matched
            if wanted and self._subscription is None:
                self._listen()
            elif not wanted and self._subscription is not None:
                self._subscription.unregister()
                self._subscription = None
        self._node.shutdown()
        return 0

    def _listen(self) -> None:
        self._subscription = self._node.create_subscription(
            self._source, None, self._take, raw=True, with_info=True
        )

    def _take(self, message: RawMessage, info: MessageInfo) -> None:
        if self._publisher is None:
            # The type is known with the first message; what is latched stays latched.
            entity = self._node.graph.entity_with_gid(info.gid)
            latched = entity is not None and entity.qos.latched
            kind: Any = message_type(message.type_name)
            self._publisher = self._node.create_publisher(self._target, kind, latch=latched)
            self._tell(f"advertised as {self._target}")
        if self._passes(len(message.data) - _CDR_HEAD):
            self._publisher.publish_raw(message.data)


def _print(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def _given(arguments: NodeArguments, *names: str) -> list[str]:
    """Return the words of a command line; without any, the parameters that stand for them."""
    if arguments.rest:
        return list(arguments.rest)
    # What is wrong with them is told when the node reads all of them.
    unheard, version = Diagnostics(), arguments.ros_version
    own = node_reader(PARAMETERS, arguments.params, arguments.name, unheard, ros_version=version)
    return [own.text(name) for name in names if own.has(name)]


def _checked(argv: list[str], least: int, usage: str) -> list[str]:
    if not least <= len(argv) <= least + 1:
        raise LaunchError(f"{len(argv)} arguments given\nusage: {usage}")
    return argv


def _number(word: str, usage: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = 0.0
    if value <= 0:
        raise LaunchError(f"'{word}' is not a positive number\nusage: {usage}")
    return value
