"""Topics, services and parameters inside this process, with no transport at all.

A `Simulation` uses it when no graph is open: plug-ins publish and listen as ever, messages go
from publisher to subscriber as a direct call with the same object. A graph may be joined later
(`LocalNode.join`), for those who want to look.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics.suggestions import nearest_names
from gazelle.errors import NotFoundError
from gazelle.graph.parameter_tree import ParameterTree

if TYPE_CHECKING:
    from gazelle.graph import MessageInfo, Node, Qos
    from gazelle.simulator.node_interfaces import PublisherPort, ServicePort, SubscriptionPort

__all__ = ["LocalNode", "LocalParameters", "LocalPublisher", "LocalService", "LocalSubscription"]

_LOGGER = logging.getLogger("gazelle.simulator")
_REQUIRED = object()

Callback = Callable[[Any], None]


class LocalPublisher:
    """Publisher of a `LocalNode`."""

    def __init__(self, node: LocalNode, topic: str, message_type: Any, latch: bool) -> None:
        self.topic = topic
        self.message_type = message_type
        self.latched: Any = None
        self.uplink: PublisherPort | None = None
        self.is_latching = latch
        self._node = node
        self._callbacks = node._callbacks.setdefault(topic, [])

    @property
    def matched(self) -> bool:
        """True when somebody subscribes."""
        return bool(self._callbacks) or (self.uplink is not None and self.uplink.matched)

    def publish(self, message: Any) -> None:
        """Call every subscriber with this very object."""
        if self.is_latching:
            self.latched = message
        for callback in tuple(self._callbacks):
            callback(message)
        if self.uplink is not None and (self.is_latching or self.uplink.matched):
            self.uplink.publish(message)

    def unregister(self) -> None:
        """Stop offering the topic; subscribers stay for the next publisher."""
        self._node._publishers = [item for item in self._node._publishers if item is not self]
        if self.uplink is not None:
            self.uplink.unregister()


class LocalSubscription:
    """Subscription of a `LocalNode`."""

    def __init__(
        self, node: LocalNode, topic: str, message_type: Any, callback: Callback, announced: str
    ) -> None:
        self.topic = topic
        self.message_type = message_type
        self.announced = announced
        self.callback = callback
        self.uplink: SubscriptionPort | None = None
        self._node = node
        self._callbacks = node._callbacks.setdefault(topic, [])
        self._callbacks.append(callback)

    def unregister(self) -> None:
        """Stop receiving; calling it twice does nothing."""
        if self.callback in self._callbacks:
            self._callbacks.remove(self.callback)
        self._node._subscriptions.pop(self, None)
        if self.uplink is not None:
            self.uplink.unregister()


class LocalService:
    """Service of a `LocalNode`."""

    def __init__(
        self, node: LocalNode, name: str, service_type: Any, handler: Callable[..., Any]
    ) -> None:
        self.name = name
        self.service_type = service_type
        self.handler = handler
        self.uplink: ServicePort | None = None
        self._node = node

    def unregister(self) -> None:
        """Stop answering."""
        self._node._services.pop(self.name, None)
        if self.uplink is not None:
            self.uplink.unregister()


class LocalParameters:
    """A parameter store with ROS 1 names: a namespace is a dictionary."""

    def __init__(self) -> None:
        self._tree = ParameterTree()

    def get(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a parameter or a namespace, `default` when it is not there.

        Raises:
            KeyError: it is not there and no default was given.
        """
        try:
            return self._tree.get(_absolute(name))
        except KeyError:
            if default is _REQUIRED:
                raise
            return default

    def set(self, name: str, value: Any) -> None:
        """Set a parameter, or with a dictionary a namespace."""
        self._tree.set(_absolute(name), value)

    def has(self, name: str) -> bool:
        """Tell whether a parameter or namespace is there."""
        return self._tree.has(_absolute(name))

    def names(self) -> list[str]:
        """Return the names of all parameters, absolute."""
        return self._tree.names()


class LocalNode:
    """A node without a graph.

    Attributes:
        has_views: topics and services for viewers are offered here.
    """

    def __init__(self) -> None:
        self.has_views = False
        self._callbacks: dict[str, list[Callback]] = {}
        self._publishers: list[LocalPublisher] = []
        self._subscriptions: dict[LocalSubscription, None] = {}
        self._services: dict[str, LocalService] = {}
        self._outlets: dict[tuple[str, Any], PublisherPort] = {}
        self._graph_node: Node | None = None
        self.parameters = LocalParameters()

    @property
    def topics(self) -> dict[str, str]:
        """Topics offered and their types, by name."""
        return {item.topic: item.message_type.TYPE_NAME for item in self._publishers}

    @property
    def services(self) -> tuple[str, ...]:
        """Names of the services offered."""
        return tuple(sorted(self._services))

    def create_publisher(
        self,
        topic: str,
        message_type: Any,
        *,
        latch: bool = False,
        reliable: bool = True,
        queue_size: int = 10,
        qos: Qos | None = None,
    ) -> LocalPublisher:
        """Offer a topic; all but `latch` means nothing without a transport."""
        publisher = LocalPublisher(self, _absolute(topic), message_type, latch)
        self._publishers.append(publisher)
        self._link_publisher(publisher)
        return publisher

    def publish(self, topic: str, message: Any) -> None:
        """Publish one message, without offering the topic."""
        name = _absolute(topic)
        for callback in tuple(self._callbacks.get(name, ())):
            callback(message)
        if self._graph_node is None:
            return
        outlet = self._outlets.get((name, type(message)))
        if outlet is None:
            outlet = self._graph_node.create_publisher(name, type(message))
            self._outlets[name, type(message)] = outlet
        if outlet.matched:
            outlet.publish(message)

    def create_subscription(
        self,
        topic: str,
        message_type: Any,
        callback: Callback,
        *,
        queue_size: int = 0,
        inline: bool = True,
        announced: str = "",
    ) -> LocalSubscription:
        """Receive a topic, always inline; what was latched on it comes at once."""
        name = _absolute(topic)
        for publisher in self._publishers:
            if publisher.topic == name and publisher.latched is not None:
                callback(publisher.latched)
        made = LocalSubscription(self, name, message_type, callback, announced)
        self._subscriptions[made] = None
        self._link_subscription(made)
        return made

    def create_service(
        self,
        name: str,
        service_type: Any,
        handler: Callable[..., Any],
        *,
        with_caller: bool = False,
    ) -> LocalService:
        """Offer a service; `with_caller` gives the handler nobody's name, as nobody has one."""
        taking = handler if with_caller else lambda request, _caller: handler(request)
        made = LocalService(self, _absolute(name), service_type, taking)
        self._services[_absolute(name)] = made
        self._link_service(made)
        return made

    def publisher_names(self, topic: str) -> tuple[str, ...]:
        """Return nothing: whoever publishes here has no node's name."""
        return ()

    def announced_together(self) -> AbstractContextManager[None]:
        """Do nothing: nobody else sees what is made here."""
        return nullcontext()

    def call(self, name: str, request: Any) -> Any:
        """Call a service of this process.

        Raises:
            NotFoundError: nobody offers it.
        """
        service = self._services.get(_absolute(name))
        if service is None:
            raise NotFoundError("service", name, nearest=nearest_names(name, self._services))
        return service.handler(request, "")

    def resolve_name(self, name: str) -> str:
        """Return the absolute name; there are no remappings here."""
        return _absolute(name)

    def log(self, level: Any, text: str) -> None:
        """Say something through the standard logging module."""
        _LOGGER.log(logging.getLevelName(str(level).upper()), text)

    def join(self, node: Node) -> None:
        """Have a node of a graph offer and receive all that is offered and received here, too.

        What is published here does not come back from there. Subscriptions of any type that
        announce none stay inside this process.

        Args:
            node: of the graph; its owner shuts it down after `leave`.
        """
        self._graph_node = node
        with node.announced_together():
            for publisher in self._publishers:
                self._link_publisher(publisher)
            for subscription in self._subscriptions:
                self._link_subscription(subscription)
            for service in self._services.values():
                self._link_service(service)

    def leave(self) -> None:
        """Be on no graph any more."""
        self._graph_node = None
        ends: list[LocalPublisher | LocalSubscription | LocalService] = [
            *self._publishers,
            *self._subscriptions,
            *self._services.values(),
        ]
        for end in ends:
            if end.uplink is not None:
                end.uplink.unregister()
                end.uplink = None
        for outlet in self._outlets.values():
            outlet.unregister()
        self._outlets.clear()

    def _link_publisher(self, publisher: LocalPublisher) -> None:
        node = self._graph_node
        if node is None:
            return
        latch = publisher.is_latching
        publisher.uplink = node.create_publisher(
            publisher.topic, publisher.message_type, latch=latch, reliable=latch
        )
        if publisher.latched is not None:
            publisher.uplink.publish(publisher.latched)

    def _link_subscription(self, subscription: LocalSubscription) -> None:
        node = self._graph_node
        if node is None or (subscription.message_type is None and not subscription.announced):
            return

        def take(message: Any, info: MessageInfo) -> None:
            if info.publisher != node.name:
                subscription.callback(message)

        subscription.uplink = node.create_subscription(
            subscription.topic,
            subscription.message_type,
            take,
            with_info=True,
            inline=True,
            announced=subscription.announced,
        )

    def _link_service(self, service: LocalService) -> None:
        if self._graph_node is not None:
            service.uplink = self._graph_node.create_service(
                service.name, service.service_type, service.handler, with_caller=True
            )


def _absolute(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"
