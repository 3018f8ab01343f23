"""From subscriptions to a bag, through a bounded queue."""

from __future__ import annotations

import re
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from gazelle.bag.message_definitions import fetch_text
from gazelle.bag.rosbag2.metadata import offered_qos
from gazelle.bag.storage import BagWriter, Connection, Encoding
from gazelle.bag.types import cdr_connection, ros1_connection
from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, Entity, Graph, Kind, MessageInfo, Node, RawMessage
from gazelle.graph.names import is_hidden
from gazelle.interfaces import RosVersion, from_cdr, ros1_message_type, ros1_type_of, to_ros1
from gazelle.interfaces.type_names import ros1_name

__all__ = ["Limits", "Recorder", "Selection", "Sink"]


@dataclass(frozen=True, slots=True)
class Selection:
    """What the user asked for.

    Attributes:
        topics: global names.
        every: all topics.
        patterns: regular expressions of names; ROS's matches the whole name.
        exclude: regular expression of names that are left out.
        node: a node whose subscriptions are recorded.
        hidden: also names with a part that starts with an underscore, in `every`.
    """

    topics: tuple[str, ...] = ()
    every: bool = False
    patterns: tuple[re.Pattern[str], ...] = ()
    exclude: re.Pattern[str] | None = None
    node: str = ""
    hidden: bool = True

    @property
    def is_open(self) -> bool:
        """Whether topics may be wanted that are not known yet."""
        return bool(self.every or self.patterns or self.node)

    def found(self, entities: Iterable[Entity]) -> list[str]:
        """Return the topics on the graph that are wanted, those named apart, sorted."""
        names = set()
        for one in entities:
            is_end = one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != ANY_TYPE
            if is_end and one.name not in self.topics and self._wants(one):
                names.add(one.name)
        return sorted(names)

    def _wants(self, one: Entity) -> bool:
        if self.exclude is not None and self.exclude.fullmatch(one.name):
            return False
        if self.node:
            return one.kind is Kind.SUBSCRIPTION and one.node == self.node
        if one.kind is not Kind.PUBLISHER:
            return False
        if self.every:
            return self.hidden or not is_hidden(one.name)
        return any(pattern.fullmatch(one.name) for pattern in self.patterns)


_FLUSH_S = 0.5

_WARN_S = 5.0

_ON_ITS_WAY_S, _QUIET_ROUNDS = 1.0, 2

_NEWS_S = 0.3


class Sink(BagWriter, Protocol):
    """Where messages go: a bag that can go on in another file."""

    def split(self, stamp_ns: int) -> Path:
        """Go on in a new file."""
        ...

    def close(self) -> None:
        """Finish."""
        ...


class Limits(NamedTuple):
    """When recording ends, or goes on in a new file.

    Attributes:
        size: bytes of a file, 0 for no limit.
        duration_ns: length of a file, 0 for no limit.
        split: go on in a new file.
        messages: of each topic, 0 for no limit.
        buffer: bytes that may wait to be written, 0 for no limit.
    """

    size: int = 0
    duration_ns: int = 0
    split: bool = False
    messages: int = 0
    buffer: int = 256 << 20


class _Item(NamedTuple):
    topic: str
    stamp_ns: int
    message: RawMessage
    info: MessageInfo


class _Route(NamedTuple):
    connection: Connection
    convert: Callable[[bytes, int], bytes]


class Recorder:
    """Subscribes topics and writes what comes, undecoded where the bag holds CDR.

    Subscriptions only queue; one thread, the one that calls `run`, converts and writes. Twice a
    second everything is handed to the system, so a killed recorder loses half a second.

    Attributes:
        dropped: messages that found no place in the buffer.
        written: messages in the bag.
    """

    def __init__(
        self,
        graph: Graph,
        node: Node,
        sink: Sink,
        *,
        limits: Limits | None = None,
        say: Callable[[str, str], None] = lambda _level, _text: None,
    ) -> None:
        """Prepare recording.

        Args:
            graph: the graph.
            node: carries the subscriptions.
            sink: where messages go.
            limits: when it ends.
            say: called with level and text of what happens.
        """
        self.dropped = 0
        self.written = 0
        self._restored = 0
        self._graph = graph
        self._node = node
        self._sink = sink
        self._limits = limits or Limits()
        self._say = say
        self._waiting: deque[_Item] = deque()
        self._waiting_bytes = 0
        self._changed = threading.Condition()
        self._subscriptions: dict[str, Any] = {}
        self._left: dict[str, int] = {}
        self._routes: dict[tuple[str, str, str], _Route | None] = {}
        self._start_ns = 0
        self._warned_s = 0.0
        self._ended = threading.Event()
        self._paused = False
        self._heard = 0

    @property
    def topics(self) -> tuple[str, ...]:
        """What is subscribed."""
        return tuple(self._subscriptions)

    def pause(self, paused: bool) -> None:
        """Take no messages while paused."""
        self._paused = paused

    def subscribe(self, topic: str) -> None:
        """Record a topic from now on."""
        if topic in self._subscriptions:
            return
        self._left[topic] = self._limits.messages

        def take(message: RawMessage, info: MessageInfo) -> None:
            self._take(_Item(topic, self._node.clock.now_ns(), message, info))

        self._say("info", f"Subscribing to {topic}")
        self._subscriptions[topic] = self._node.create_subscription(
            topic, None, take, raw=True, with_info=True, inline=True
        )

    def begin(self, selection: Selection) -> None:
        """Subscribe what is wanted and there, then create the file.

        Whoever waits for the file, or for the words that follow, may publish at once: by then the
        hub has told everybody of the subscriptions.

        Raises:
            BagError: the file cannot be created.
        """
        for topic in (*selection.topics, *self._found(selection)):
            self.subscribe(topic)
        self._graph.parameters.has("/")
        self._sink.flush()

    def run(self, selection: Selection, stop: threading.Event) -> None:
        """Record until told to stop or a limit is reached; the sink is closed in any case.

        What was sent before it was told to stop is recorded, though it may be on its way.

        Raises:
            BagError: the disk is full, or the file cannot be written otherwise.
        """
        self._start_ns = self._node.clock.now_ns()
        self._graph.discovery.listen(self._on_change)
        look, flushed_s = True, time.monotonic()
        try:
            while not (stop.is_set() or self._ended.is_set()):
                if look:
                    for topic in self._found(selection):
                        self.subscribe(topic)
                look = self._wait()
                self._write_waiting()
                if time.monotonic() - flushed_s >= _FLUSH_S:
                    flushed_s = time.monotonic()
                    self._sink.flush()
                    self._tell_restored()
                self._check_limits(self._node.clock.now_ns())
            self._take_what_is_on_its_way()
        finally:
            for one in self._subscriptions.values():
                one.unregister()
            self._write_waiting()
            self._sink.close()
            self._tell_restored()

    def _take_what_is_on_its_way(self) -> None:
        """Wait for what was sent up to now, until nothing more comes."""
        end_s, quiet = time.monotonic() + _ON_ITS_WAY_S, 0
        while quiet < _QUIET_ROUNDS and (left_s := end_s - time.monotonic()) > 0:
            before = self._heard
            if not self._graph.parameters.settle(left_s):
                return
            quiet = quiet + 1 if self._heard == before else 0

    def _tell_restored(self) -> None:
        restored, self._restored = self._restored, self._sink.restored
        if self._restored > restored:
            text = f"somebody removed the file of '{self._sink.path}'; it is written anew"
            self._say("warn", text)

    def _found(self, selection: Selection) -> list[str]:
        return selection.found(self._graph.discovery.known()) if selection.is_open else []

    def _take(self, item: _Item) -> None:
        if self._paused:
            return
        with self._changed:
            self._heard += 1
            self._waiting.append(item)
            self._waiting_bytes += len(item.message.data)
            most = self._limits.buffer
            while most and self._waiting_bytes > most and len(self._waiting) > 1:
                self._waiting_bytes -= len(self._waiting.popleft().message.data)
                self.dropped += 1
                self._warn_of_dropped()
            self._changed.notify()

    def _warn_of_dropped(self) -> None:
        if time.monotonic() - self._warned_s > _WARN_S:
            self._warned_s = time.monotonic()
            self._say("warn", "rosbag record buffer exceeded.  Dropping oldest queued message.")

    def _on_change(self, _entity: Entity, _is_there: bool) -> None:
        with self._changed:
            self._changed.notify()

    def _wait(self) -> bool:
        """Wait for work; returns whether it is something else than a message."""
        with self._changed:
            if not self._waiting:
                self._changed.wait(_FLUSH_S / 2)
            return not self._waiting

    def _write_waiting(self) -> None:
        while True:
            with self._changed:
                items, self._waiting, self._waiting_bytes = self._waiting, deque(), 0
            if not items:
                return
            for item in items:
                self._write(item)

    def _write(self, item: _Item) -> None:
        self._check_limits(item.stamp_ns)
        if self._ended.is_set() or self._is_enough(item.topic):
            return
        route = self._route(item)
        if route is None:
            return
        try:
            data = route.convert(item.message.data, item.info.sequence)
        except GazelleError as error:
            self._say("error", f"a message on {item.topic} is left out: {error}")
            return
        self._sink.write(route.connection, item.stamp_ns, data)
        self.written += 1

    def _is_enough(self, topic: str) -> bool:
        if not self._limits.messages:
            return False
        if self._left[topic] <= 0:
            return True
        self._left[topic] -= 1
        return False

    def _check_limits(self, now_ns: int) -> None:
        limits = self._limits
        too_big = limits.size and self._sink.size > limits.size
        too_long = limits.duration_ns and now_ns - self._start_ns > limits.duration_ns
        if (too_big or too_long) and limits.split:
            done = self._sink.split(now_ns)
            self._start_ns += limits.duration_ns if too_long else now_ns - self._start_ns
            self._say("info", f"Closing '{done}'.")
            self._say("info", f"Recording to '{self._sink.path}'.")
        elif too_big or too_long:
            self._ended.set()
        left = self._left.values()
        if limits.messages and left and not self._waiting and max(left) <= 0:
            self._ended.set()

    def _route(self, item: _Item) -> _Route | None:
        publisher = self._publisher(item) if self._sink.encoding is Encoding.ROS1 else ""
        key = (item.topic, publisher, item.message.type_name)
        if key not in self._routes:
            try:
                self._routes[key] = self._new_route(item, publisher)
            except GazelleError as error:
                self._routes[key] = None
                text = f"topic {item.topic} ({item.message.type_name}) is not recorded: {error}"
                self._say("error", f"{text} [bag.not-converted]")
        return self._routes[key]

    def _publisher(self, item: _Item) -> str:
        """Return who sent it; a message may come before the news of its publisher."""
        if item.info.publisher:
            return item.info.publisher
        known = [key for key in self._routes if key[0] == item.topic]
        if len(known) == 1:
            return known[0][1]

        def is_known(entities: Iterable[Entity]) -> bool:
            return bool(_publishers(entities, item.topic))

        self._graph.discovery.wait_for(is_known, _NEWS_S)
        names = {one.node for one in _publishers(self._graph.discovery.known(), item.topic)}
        return names.pop() if len(names) == 1 else ""

    def _new_route(self, item: _Item, publisher: str) -> _Route:
        type_name, topic = item.message.type_name, item.topic
        ends = _publishers(self._graph.discovery.known(), topic)
        ends = [one for one in ends if one.node == (publisher or one.node)]
        latched = any(one.qos.latched for one in ends)
        if self._sink.encoding is Encoding.CDR:
            reliable = all(one.qos.reliable for one in ends)
            qos = offered_qos(reliable=reliable, latched=latched)
            fetch_text(self._graph, ros1_name(type_name), RosVersion.ROS2)
            new = cdr_connection(topic, type_name, qos=qos)
            return _Route(self._sink.add(new), lambda data, _sequence: data)
        short = ros1_type_of(type_name)
        fetch_text(self._graph, short, RosVersion.ROS1)
        new = ros1_connection(topic, short, callerid=publisher, latching=latched)
        return _Route(self._sink.add(new), _ros1_bytes(short))


def _publishers(entities: Iterable[Entity], topic: str) -> list[Entity]:
    return [one for one in entities if one.kind is Kind.PUBLISHER and one.name == topic]


def _ros1_bytes(short: str) -> Callable[[bytes, int], bytes]:
    view = ros1_message_type(short)
    if not view._has_header:
        return lambda data, _sequence: to_ros1(from_cdr(view, data))

    def convert(data: bytes, sequence: int) -> bytes:
        message = from_cdr(view, data)
        message.header.seq = sequence  # ROS 1's receivers count; CDR has no place for it
        return to_ros1(message)

    return convert
