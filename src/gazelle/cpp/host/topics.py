"""Publishers and subscriptions of C++, as the graph has them."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from gazelle.cpp.host.raw_messages import RawMessageBase, know_type, raw_message_type
from gazelle.errors import GraphError
from gazelle.graph import Qos
from gazelle.graph.key_expressions import Kind
from gazelle.graph.type_support import decode, encode, resolve_type

if TYPE_CHECKING:
    from gazelle.cpp.host.table import Core
    from gazelle.graph import MessageInfo, RawMessage
    from gazelle.graph.key_expressions import Entity

__all__ = ["HostPublisher", "HostSubscription", "qos_of"]

_SETTLED_S = 1.0


class HostPublisher:
    """A publisher of C++.

    Attributes:
        topic: global name.
        type_name: ``pkg/msg/Name``.
        gid: 16 bytes that name it.
    """

    def __init__(self, core: Core, node: Any, request: dict[str, Any]) -> None:
        """Declare it.

        Args:
            core: the runtime.
            node: the graph's node, or one without a graph.
            request: of the verb ``topic/advertise``.
        """
        self._core = core
        self._number: int = request["core"]
        self.type_name: str = request["type"]
        know_type(self.type_name, request.get("definition", ""), is_ros1=_is_ros1(request))
        qos = qos_of(request["qos"])
        latch = bool(request.get("latch")) or qos.latched
        # Until then a publisher takes it that somebody may listen.
        self._settles_s = time.monotonic() + _SETTLED_S
        self._is_settled = False
        self._subscribers: set[Entity] = set()
        self._telling = threading.Lock()
        self._raw: type[RawMessageBase] | None = None
        graph = getattr(node, "graph", None)
        self._graph = graph
        if graph is None:
            self._message_class = resolve_type(self.type_name)
            self._publisher = node.create_publisher(
                request["topic"], self._message_class, latch=latch
            )
        else:
            self._raw = raw_message_type(self.type_name)
            self._publisher = node.create_publisher(
                request["topic"],
                self._raw,
                latch=latch,
                reliable=qos.reliable,
                qos=qos._replace(latched=latch),
                native=True,
            )
            self._publisher.watch(self._tell)
        self.topic: str = self._publisher.topic
        self.gid: bytes = getattr(self._publisher, "gid", bytes(16))

    def begin(self) -> None:
        """Tell C++ who listens already."""
        if self._graph is not None:
            for entity in self._graph.discovery.known():
                self._note(entity, is_there=True)
        self._tell()

    def publish(self, data: bytes) -> None:
        """Send a message, to others and to what listens in Python here."""
        if self._raw is None:
            self._publisher.publish(decode(self._message_class, data))
            return
        try:
            self._publisher.publish(self._raw(data))
        except GraphError:
            # A thread of C++ publishes while another one closes it.
            return
        if not self._is_settled and time.monotonic() > self._settles_s:
            # From now on whoever comes or goes is told of.
            self._is_settled = True
            self._tell()

    def on_entity(self, entity: Entity, *, is_there: bool) -> None:
        """Take in that something has come to the graph or gone."""
        if entity.kind is Kind.SUBSCRIPTION and entity.name == self.topic:
            self._note(entity, is_there=is_there)
            self._tell()

    def close(self) -> None:
        """Take it off the graph."""
        self._publisher.unregister()

    def _note(self, entity: Entity, *, is_there: bool) -> None:
        """Tell C++ of a subscriber, once each time that it comes and goes."""
        if entity.kind is not Kind.SUBSCRIPTION or entity.name != self.topic:
            return
        with self._telling:
            if (entity in self._subscribers) == is_there:
                return
            (self._subscribers.add if is_there else self._subscribers.discard)(entity)
        self._core.on_subscriber(self._number, entity.node, is_there=is_there)

    def _tell(self) -> None:
        """Tell C++ how many listen, and whether anybody does whom it does not reach itself."""
        if self._graph is None:
            self._core.on_matched(self._number, int(self._publisher.matched), 1)
            return
        # Of two threads that look, the one that looked last has the last word.
        with self._telling:
            wanted, count = self._publisher.wanted, self._publisher.subscription_count
            self._core.on_matched(self._number, count, int(wanted))


class HostSubscription:
    """A subscription of C++.

    Attributes:
        topic: global name.
    """

    def __init__(self, core: Core, node: Any, request: dict[str, Any]) -> None:
        """Declare it; see `HostPublisher`. Without a type it takes any."""
        self._core = core
        self._number: int = request["core"]
        self._type_name: str = request["type"]
        know_type(self._type_name, request.get("definition", ""), is_ros1=_is_ros1(request))
        qos = qos_of(request["qos"])
        self._names: dict[str, bytes] = {}
        graph = getattr(node, "graph", None)
        self._graph = graph
        if graph is None:
            message_class = resolve_type(self._type_name) if self._type_name else None
            self._subscription = node.create_subscription(
                request["topic"], message_class, self._take_object
            )
        else:
            raw = raw_message_type(self._type_name) if self._type_name else None
            # Which of ROS 1's wants latched messages is not told by a quality of service.
            told = None if request.get("latched") and not qos.latched else qos
            self._subscription = node.create_subscription(
                request["topic"],
                raw,
                self._take,
                queue_size=qos.depth,
                raw=True,
                with_info=True,
                inline=True,
                announced=request.get("announced", ""),
                qos=told,
                native=True,
            )
        self.topic: str = self._subscription.topic

    def begin(self) -> None:
        """Tell C++ who publishes already."""
        self._tell()

    def on_entity(self, entity: Entity, *, is_there: bool) -> None:
        """Take in that something has come to the graph or gone."""
        del is_there
        if entity.kind is Kind.PUBLISHER and entity.name == self.topic:
            self._tell()

    def close(self) -> None:
        """Take it off the graph."""
        self._subscription.unregister()

    def _take(self, message: RawMessage, info: MessageInfo) -> None:
        names = self._names
        type_name = names.get(message.type_name)
        if type_name is None:
            type_name = names[message.type_name] = message.type_name.encode()
        publisher = info.publisher.encode()
        details = (info.sequence, info.stamp_ns, info.gid, publisher)
        self._core.on_message(self._number, message.data, type_name, details)

    def _take_object(self, message: Any) -> None:
        data = encode(message)
        name = self._type_name or message.TYPE_NAME
        self._core.on_message(self._number, data, name.encode(), (0, 0, bytes(16), b""))

    def _tell(self) -> None:
        if self._graph is not None:
            self._core.on_matched(self._number, self._subscription.publisher_count, -1)


def qos_of(values: dict[str, Any]) -> Qos:
    """Return the quality of service that C++ wrote."""
    return Qos(
        reliable=bool(values.get("reliable", True)),
        latched=bool(values.get("latched", False)),
        depth=int(values.get("depth", 10)),
        deadline_ns=int(values.get("deadline_ns", 0)),
        lifespan_ns=int(values.get("lifespan_ns", 0)),
        manual=bool(values.get("manual", False)),
        lease_ns=int(values.get("lease_ns", 0)),
    )


def _is_ros1(request: dict[str, Any]) -> bool:
    return bool(request.get("is_ros1", True))
