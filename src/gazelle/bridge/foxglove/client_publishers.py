"""What viewers publish, on its way to the graph."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.interfaces import fill, from_cdr, message_type, wire_type

if TYPE_CHECKING:
    from gazelle.graph import Node, Publisher

__all__ = ["ClientPublishers"]

_MATCH_S = 1.0
_PAUSE_S = 0.005
_Key = tuple[int, int]


class _ClientPublisher(NamedTuple):
    publisher: Publisher
    is_json: bool

    def read(self, data: bytes) -> Any:
        """Return the message; what is none must not reach the graph."""
        if not self.is_json:
            return from_cdr(self.publisher.message_class, data)
        message = self.publisher.message_class()
        fill(message, json.loads(data))
        return message


class ClientPublishers:
    """A publisher for each topic that a viewer has advertised."""

    def __init__(self, node: Node, notice: Callable[[str], None]) -> None:
        """Say nothing yet.

        Args:
            node: publishes.
            notice: told what cannot be published.
        """
        self._node = node
        self._notice = notice
        self._lock = threading.Lock()
        self._publishers: dict[_Key, _ClientPublisher] = {}

    def advertise(self, key: _Key, topic: str, type_name: str, encoding: str) -> None:
        """Let a viewer publish.

        Args:
            key: the viewer and his number for the topic.
            topic: any legal name.
            type_name: ``pkg/msg/Name`` or ``pkg/Name``.
            encoding: ``cdr`` or ``json``.
        """
        if encoding not in ("cdr", "json"):
            self._notice(f"a viewer cannot publish {topic}: {encoding} is neither cdr nor json")
            return
        try:
            message_class = message_type(wire_type(type_name))
            publisher = self._node.create_publisher(topic, message_class)
        except GazelleError as error:
            self._notice(f"a viewer cannot publish {topic} as {type_name}: {error}")
            return
        with self._lock:
            self._publishers[key] = _ClientPublisher(publisher, encoding == "json")
        self._wait_for_ears(publisher)

    def unadvertise(self, key: _Key) -> None:
        """Let a viewer publish no more."""
        with self._lock:
            client_publisher = self._publishers.pop(key, None)
        if client_publisher is not None:
            client_publisher.publisher.unregister()

    def publish(self, key: _Key, data: bytes) -> None:
        """Publish a viewer's message; one on a topic that was refused is dropped."""
        with self._lock:
            client_publisher = self._publishers.get(key)
        if client_publisher is None:
            return
        try:
            client_publisher.publisher.publish(client_publisher.read(data))
        except (GazelleError, ValueError) as error:
            self._notice(
                f"a viewer's message on {client_publisher.publisher.topic} is dropped: {error}"
            )

    def close(self) -> None:
        """Let nobody publish any more."""
        for key in tuple(self._publishers):
            self.unadvertise(key)

    def _wait_for_ears(self, publisher: Publisher) -> None:
        """A viewer may send at once what a subscription that is there already must not miss."""
        end = time.monotonic() + _MATCH_S
        while publisher.subscription_count and not publisher.matched and time.monotonic() < end:
            time.sleep(_PAUSE_S)
