"""Nodes: names, and everything that is created under one."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from gazelle.errors import GraphError
from gazelle.graph import type_support
from gazelle.graph.console import Level, LogRecord, level_of
from gazelle.graph.key_expressions import ANY_TYPE, DEFAULT_QOS, NO_HASH, Entity, Kind, Qos, token
from gazelle.graph.names import check_name, remap, resolve
from gazelle.graph.parameter_server import ParameterStore
from gazelle.graph.publisher import Publisher
from gazelle.graph.service import ServiceClient, ServiceServer
from gazelle.graph.subscription import Delivery, Subscription
from gazelle.interfaces.stamps import set_stamp

if TYPE_CHECKING:
    from gazelle.graph.clock import Clock
    from gazelle.graph.graph import Graph

__all__ = ["Node"]

_ROSOUT = "/rosout"
_WIRE_LEVELS = {level: 10 * number for number, level in enumerate(Level, 1)}
_ROSOUT_TYPE = "rcl_interfaces/msg/Log"


class _Closable(Protocol):
    def unregister(self) -> None: ...


_T = TypeVar("_T", bound=_Closable)


class Node:
    """A named participant; made by `Graph.create_node`.

    Attributes:
        graph: the graph it is part of.
        name: global name.
        namespace: where its relative names start.
        parameters: the parameter store, by this node's names.
        log_level: what is less than this is not logged.
        console: writes what is logged, see `Graph.console`.
        log_path: file that keeps all of it, empty for none.
        outlives: what is created or published after `shutdown` reaches nobody, as in rospy,
            instead of being an error.
    """

    def __init__(
        self,
        graph: Graph,
        name: str,
        namespace: str,
        remappings: Mapping[str, str],
        *,
        rosout: bool,
    ) -> None:
        """Announce the node; use `Graph.create_node`."""
        self.graph = graph
        self.name = name
        self.namespace = namespace
        self.log_level = Level.INFO
        self.console: Callable[..., None] = graph.console
        self.log_path = ""
        self.outlives = False
        self.parameters = ParameterStore(graph.parameter_share, self.resolve_name, name)
        self._remappings = remap(remappings, namespace, node=name)
        self._created: list[_Closable] = []
        self._closing = threading.Lock()
        self._shutdown: list[Callable[[str], None]] = []
        self._closed = False
        self._rosout: Publisher | None = None
        self.entity = Entity(graph.zid, graph.next_id(), graph.next_id(), Kind.NODE, name)
        self._token = graph.announcements.announce(token(graph.domain, self.entity))
        if rosout:
            self._rosout = self.create_publisher(
                _ROSOUT, type_support.resolve_type(_ROSOUT_TYPE), queue_size=100
            )

    @property
    def clock(self) -> Clock:
        """The clock of the process' nodes."""
        return self.graph.clock

    @property
    def closed(self) -> bool:
        """True after `shutdown`."""
        return self._closed

    def publisher_names(self, topic: str) -> tuple[str, ...]:
        """Return the names of the other nodes that are known to publish a topic.

        The graph is not asked: a callback of the transport may want to know.
        """
        full, known = resolve(topic), self.graph.discovery.known()
        found = {one.node for one in known if one.kind is Kind.PUBLISHER and one.name == full}
        return tuple(sorted(found - {self.name}))

    def announced_together(self) -> AbstractContextManager[None]:
        """Announce what is made in a ``with`` block at its end, see `Announcements.together`."""
        return self.graph.announcements.together()

    def resolve_name(self, name: str) -> str:
        """Return the global name after remapping.

        Raises:
            IllegalNameError: the name is not legal.
        """
        check_name(name)
        return resolve(name, self.namespace, node=self.name, remappings=self._remappings)

    def create_publisher(
        self,
        topic: str,
        message_type: Any,
        *,
        latch: bool = False,
        reliable: bool = True,
        queue_size: int = 10,
        copy_local: bool = False,
        qos: Qos | None = None,
        native: bool = False,
    ) -> Publisher:
        """Offer a topic.

        Args:
            topic: any legal name.
            message_type: message class (a ROS 1 view too) or its name.
            latch: give late subscriptions the last message.
            reliable: wait (up to one second) for slow subscriptions; False for sensors, whose
                messages are dropped instead.
            queue_size: told to others; sending does not queue.
            copy_local: give subscriptions of this process a copy, for callers that go on
                changing the message, as rospy's users may.
            qos: told to others in place of `reliable` and `queue_size`, which act all the same.
            native: native subscriptions of this process get its messages another way.
        """
        message_class = type_support.resolve_type(message_type)
        told = qos or Qos(reliable, latch, queue_size)
        name = type_support.type_name_of(message_class)
        entity = self._entity(Kind.PUBLISHER, topic, name, message_class, qos=told)
        made = Publisher(
            self.graph,
            entity,
            message_class,
            copy_local=copy_local,
            reliable=reliable,
            native=native,
            is_mute=self._is_mute,
        )
        return self._keep(made)

    def create_subscription(  # noqa: PLR0913 - users give all by keyword
        self,
        topic: str,
        message_type: Any,
        callback: Callable[..., None],
        *,
        queue_size: int = 0,
        raw: bool = False,
        with_info: bool = False,
        inline: bool = False,
        announced: str = "",
        qos: Qos | None = None,
        native: bool = False,
    ) -> Subscription:
        """Receive a topic.

        Args:
            topic: any legal name.
            message_type: message class (a ROS 1 view too) or its name; None for any type.
            callback: called with the message, or with message and `MessageInfo`.
            queue_size: most messages that wait, the oldest are dropped first; 0 for no limit.
            raw: give `RawMessage` (CDR bytes, type name), not decoded.
            with_info: call back with a `MessageInfo` too.
            inline: call back in the thread that publishes (same process) or receives; the
                callback must be short and must not wait for the graph.
            announced: the type that a subscription of any type shows to others.
            qos: told to others; without it latched messages come, as in ROS 1, with it only when
                it asks for them.
            native: messages of native publishers of this process come another way.
        """
        message_class = type_support.resolve_type(message_type)
        any_type = announced or ANY_TYPE
        type_name = any_type if message_class is None else type_support.type_name_of(message_class)
        told = qos or Qos(depth=queue_size)
        latched = qos is None or qos.latched
        delivery = Delivery(raw, with_info, inline, queue_size, latched, native)
        entity = self._entity(Kind.SUBSCRIPTION, topic, type_name, message_class, qos=told)
        return self._keep(
            Subscription(
                self.graph,
                entity,
                message_class,
                callback,
                delivery=delivery,
                on_error=self._on_error,
                on_warning=self._on_warning,
                is_mute=self._is_mute(),
            )
        )

    def create_service(
        self,
        name: str,
        service_type: Any,
        handler: Callable[..., Any],
        *,
        with_caller: bool = False,
    ) -> ServiceServer:
        """Answer a service.

        Args:
            name: any legal name.
            service_type: service class, of ROS 1 or 2.
            handler: takes a request, returns a response; what it raises reaches the caller as
                `ServiceCallError`.
            with_caller: give the handler the global name of the node that asks too; it is empty
                when nobody knows.
        """
        entity = self._entity(Kind.SERVICE, name, type_support.service_name_of(service_type))
        made = ServiceServer(
            self.graph,
            entity,
            service_type,
            handler,
            with_caller=with_caller,
            on_error=self._on_error,
            is_mute=self._is_mute(),
        )
        return self._keep(made)

    def create_client(self, name: str, service_type: Any) -> ServiceClient:
        """Prepare calls of a service."""
        entity = self._entity(Kind.CLIENT, name, type_support.service_name_of(service_type))
        made = ServiceClient(self.graph, entity, service_type, is_mute=self._is_mute())
        return self._keep(made)

    def log(
        self,
        level: Level | int | str,
        text: str,
        *,
        logger: str = "",
        padded: bool = True,
        console: bool = True,
        depth: int = 1,
    ) -> None:
        """Say something on the console and on ``/rosout``.

        Args:
            level: a `Level`, its number or its word.
            text: what to say.
            logger: name of the logger, the node's own when empty.
            padded: roscpp's layout ``[ INFO]``, else rospy's ``[INFO]``.
            console: print it too.
            depth: whose file and line go with it: 1 for the caller's, 2 for its caller's.
        """
        severity = level_of(level)
        if severity < self.log_level:
            return
        caller = sys._getframe(depth)
        sim_ns = self.clock.now_ns() if self.clock.use_sim_time else None
        record = LogRecord(
            severity,
            text,
            self.name,
            time.time_ns(),
            sim_ns,
            logger,
            caller.f_code.co_filename,
            caller.f_code.co_name,
            caller.f_lineno,
        )
        self.tell(record, padded=padded, console=console)

    def tell(self, record: LogRecord, *, padded: bool = True, console: bool = True) -> None:
        """Say what is in a record, whatever its level; see `log`."""
        if console:
            self.console(record, padded=padded)
        if self._rosout is not None and self._rosout.matched and not self._closed:
            self._rosout.publish(self._rosout_message(record))

    def on_shutdown(self, listener: Callable[[str], None]) -> None:
        """Call `listener(reason)` once when the node is shut down, by whomever."""
        self._shutdown.append(listener)

    def shutdown(self, reason: str = "") -> None:
        """Take everything of this node off the graph; calling it twice does nothing."""
        with self._closing:
            if self._closed:
                return
            self._closed = True
        for listener in tuple(self._shutdown):
            listener(reason)
        self.clock.leave(self)
        for one in reversed(self._created):
            one.unregister()
        self._token.undeclare()
        self.graph.forget(self)

    def _entity(
        self,
        kind: Kind,
        name: str,
        type_name: str,
        message_class: Any = None,
        *,
        qos: Qos = DEFAULT_QOS,
    ) -> Entity:
        if self._closed and not self.outlives:
            raise GraphError(f"node {self.name} is shut down; it cannot create {name}")
        return Entity(
            self.graph.zid,
            self.entity.node_id,
            self.graph.next_id(),
            kind,
            self.name,
            self.resolve_name(name),
            type_name,
            NO_HASH if type_name == ANY_TYPE else type_support.hash_of(type_name, message_class),
            qos,
        )

    def _is_mute(self) -> bool:
        return self._closed and self.outlives

    def _keep(self, one: _T) -> _T:
        with self._closing:
            is_late = self._closed
            if not is_late:
                self._created.append(one)
        if is_late:
            # The node was shut down while it was made, and would leave it on the graph.
            one.unregister()
        return one

    def drop(self, one: object) -> None:
        """Forget what was unregistered on its own."""
        with self._closing:
            self._created = [item for item in self._created if item is not one]

    def _on_error(self, text: str) -> None:
        if self._closed and isinstance(sys.exception(), GraphError):
            # A callback wanted something of the node that was shut down meanwhile.
            return
        self.log(Level.ERROR, text)

    def _on_warning(self, text: str) -> None:
        self.log(Level.WARN, text)

    def _rosout_message(self, record: LogRecord) -> Any:
        assert self._rosout is not None
        message = self._rosout.message_class()
        stamp_ns = record.wall_ns if record.sim_ns is None else record.sim_ns
        set_stamp(message.stamp, stamp_ns)
        message.level = _WIRE_LEVELS[record.level]
        message.name = record.node
        message.msg = record.text
        message.file = record.file
        message.function = record.function
        message.line = record.line
        return message
