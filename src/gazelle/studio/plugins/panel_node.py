"""The graph as a panel sees it: topics, services, parameters and the log."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.errors import GraphError
from gazelle.graph import Node, Publisher
from gazelle.interfaces import fill, message_type, service_type

__all__ = ["PanelNode"]

_TIMEOUT_S = 10.0
_MATCH_S = 1.0
_LOOK_S = 0.01
_QUEUE = 10
_Guard = Callable[[Callable[[], Any]], bool]


class PanelNode:
    """A node of the panel's own, with the methods that plug-ins and controllers have too.

    Types are names such as ``geometry_msgs/Twist``, or message classes.

    Attributes:
        node: the graph's node beneath, for what is not here.
    """

    def __init__(self, node: Node, guard: _Guard) -> None:
        """Wrap a node.

        Args:
            node: of the graph.
            guard: runs the panel's code; False when it raised.
        """
        self.node = node
        self._guard = guard
        self._publishers: dict[str, Publisher] = {}

    @property
    def name(self) -> str:
        """Global name of the node."""
        return self.node.name

    def now_s(self) -> float:
        """Return the graph's time: simulated where there is a simulation."""
        return self.node.clock.now_ns() * 1e-9

    def message(self, type_name: str, **fields: Any) -> Any:
        """Return a message: ``message("geometry_msgs/Twist", linear={"x": 0.5})``.

        Raises:
            InterfaceError: there is no such field, or a value does not fit.
        """
        made = message_type(type_name)()
        fill(made, fields)
        return made

    def advertise(self, topic: str, message_type: Any, *, latch: bool = False) -> Publisher:
        """Offer a topic; its ``matched`` tells whether anybody listens."""
        made = self._publishers.get(topic)
        if made is None:
            made = self.node.create_publisher(topic, message_type, latch=latch)
            self._publishers[topic] = made
        return made

    def publish(self, topic: str, message: Any) -> None:
        """Send a message; the first one waits until those who listen already are reached."""
        known = topic in self._publishers
        publisher = self.advertise(topic, type(message))
        if not known:
            self._wait_for_match(publisher)
        publisher.publish(message)

    def subscribe(self, topic: str, message_type: Any, callback: Callable[[Any], Any]) -> None:
        """Listen to a topic; of messages that come faster than they are taken, the oldest go."""

        def take(message: Any) -> None:
            self._guard(lambda: callback(message))

        self.node.create_subscription(topic, message_type, take, queue_size=_QUEUE)

    def service(self, name: str, type_name: str, handler: Callable[[Any, Any], Any]) -> None:
        """Answer a service; `handler(request, response)` fills the response."""
        kind = service_type(type_name)

        def answer(request: Any) -> Any:
            response = kind.Response()
            if not self._guard(lambda: handler(request, response)):
                raise GraphError(f"the panel's handler of {name} raised; the panel shows where")
            return response

        self.node.create_service(name, kind, answer)

    def call(
        self, service: str, type_name: str, *, timeout_s: float = _TIMEOUT_S, **fields: Any
    ) -> Any:
        """Call a service and return its response.

        Raises:
            GraphError: it is not there, does not answer in time or refuses.
        """
        kind = service_type(type_name)
        request = kind.Request()
        fill(request, fields)
        client = self.node.create_client(service, kind)
        try:
            return client.call(request, timeout_s)
        finally:
            client.unregister()
            self.node.drop(client)

    def get_param(self, name: str, default: Any = None) -> Any:
        """Return a parameter of the ROS 1 store."""
        return self.node.parameters.get(name, default)

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter of the ROS 1 store."""
        self.node.parameters.set(name, value)

    def log_debug(self, text: str) -> None:
        """Log a detail."""
        self.node.log("DEBUG", text, depth=2)

    def log_info(self, text: str) -> None:
        """Log what goes on."""
        self.node.log("INFO", text, depth=2)

    def log_warn(self, text: str) -> None:
        """Log a warning."""
        self.node.log("WARN", text, depth=2)

    def log_error(self, text: str) -> None:
        """Log an error."""
        self.node.log("ERROR", text, depth=2)

    def _wait_for_match(self, publisher: Publisher) -> None:
        pause = threading.Event()
        for _ in range(round(_MATCH_S / _LOOK_S)):
            if publisher.matched or not self.node.graph.subscription_count(publisher.topic):
                return
            pause.wait(_LOOK_S)
