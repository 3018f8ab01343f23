"""Topics, services and parameters inside this process, with no transport at all.

A `Simulation` uses it when no graph is open: plug-ins publish and listen as ever, messages go
from publisher to subscriber as a direct call with the same object.
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
    from gazelle.graph import Qos

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
        self._latch = latch
        self._node = node
        self._callbacks = node._callbacks.setdefault(topic, [])

    @property
    def matched(self) -> bool:
        """True when somebody subscribes."""
        return bool(self._callbacks)

    def publish(self, message: Any) -> None:
        """Call every subscriber with this very object."""
        if self._latch:
            self.latched = message
        for callback in tuple(self._callbacks):
            callback(message)

    def unregister(self) -> None:
        """Stop offering the topic; subscribers stay for the next publisher."""
        self._node._publishers = [item for item in self._node._publishers if item is not self]


class LocalSubscription:
    """Subscription of a `LocalNode`."""

    def __init__(self, node: LocalNode, topic: str, callback: Callback) -> None:
        self.topic = topic
        self._callback = callback
        self._callbacks = node._callbacks.setdefault(topic, [])
        self._callbacks.append(callback)

    def unregister(self) -> None:
        """Stop receiving; calling it twice does nothing."""
        if self._callback in self._callbacks:
            self._callbacks.remove(self._callback)


class LocalService:
    """Service of a `LocalNode`."""

    def __init__(self, node: LocalNode, name: str) -> None:
        self.name = name
        self._node = node

    def unregister(self) -> None:
        """Stop answering."""
        self._node._services.pop(self.name, None)


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
    """A node without a graph."""

    def __init__(self) -> None:
        self._callbacks: dict[str, list[Callback]] = {}
        self._publishers: list[LocalPublisher] = []
        self._services: dict[str, Callable[[Any], Any]] = {}
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
        return publisher

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
        return LocalSubscription(self, name, callback)

    def create_service(
        self,
        name: str,
        service_type: Any,
        handler: Callable[..., Any],
        *,
        with_caller: bool = False,
    ) -> LocalService:
        """Offer a service; `with_caller` gives the handler nobody's name, as nobody has one."""
        wanted = (lambda request: handler(request, "")) if with_caller else handler
        self._services[_absolute(name)] = wanted
        return LocalService(self, _absolute(name))

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
        handler = self._services.get(_absolute(name))
        if handler is None:
            raise NotFoundError("service", name, nearest=nearest_names(name, self._services))
        return handler(request)

    def resolve_name(self, name: str) -> str:
        """Return the absolute name; there are no remappings here."""
        return _absolute(name)

    def log(self, level: Any, text: str) -> None:
        """Say something through the standard logging module."""
        _LOGGER.log(logging.getLevelName(str(level).upper()), text)


def _absolute(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"
