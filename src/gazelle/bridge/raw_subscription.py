"""A topic of the graph as bytes, without the messages of this process itself.

A bridge must not hear what it has brought in, or it would send it back where it came from.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.key_expressions import Attachment, topic_selector, type_in_key

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["RawSubscription", "Sample"]

_WAITING = 100


class Sample(NamedTuple):
    """A message on the graph.

    Attributes:
        cdr: its bytes.
        type_name: ``pkg/msg/Name``.
        publisher: global name of the publishing node, empty when it is not known.
        latched: whether late subscriptions get it too.
        sequence: counts the publisher's messages from 1.
    """

    cdr: bytes
    type_name: str
    publisher: str
    latched: bool
    sequence: int


class RawSubscription:
    """Calls back with every message that another process publishes on a topic."""

    def __init__(self, graph: Graph, topic: str, on_sample: Callable[[Sample], None]) -> None:
        """Start to listen.

        Args:
            graph: where.
            topic: global name.
            on_sample: called from one thread of its own; must not raise.
        """
        import zenoh
        import zenoh.ext

        self._graph = graph
        self._on_sample = on_sample
        self._types: dict[str, str] = {}
        self._callback_queue = CallbackQueue(
            self._handle, size=_WAITING, name=f"raw subscription {topic}"
        )
        self._subscriber: Any = zenoh.ext.declare_advanced_subscriber(
            graph.session,
            topic_selector(graph.domain, topic),
            zenoh.handlers.Callback(self._callback_queue.put, None, indirect=False),
            allowed_origin=zenoh.Locality.REMOTE,
            history=zenoh.ext.HistoryConfig(detect_late_publishers=True, max_samples=1),
        )

    def close(self) -> None:
        """Listen no more."""
        self._subscriber.undeclare()
        self._callback_queue.close()

    def _handle(self, sample: Any) -> None:
        attached = sample.attachment
        attachment = Attachment.from_bytes(attached.to_bytes() if attached else b"")
        if attachment.gid in self._graph.local.gids:
            # History has no notion of origin.
            return
        key = str(sample.key_expr)
        type_name = self._types.get(key)
        if type_name is None:
            type_name = self._types[key] = type_in_key(key)[0]
        entity = self._graph.entity_with_gid(attachment.gid)
        publisher = entity.node if entity is not None else ""
        latched = entity is not None and entity.qos.latched
        cdr = sample.payload.to_bytes()
        self._on_sample(Sample(cdr, type_name, publisher, latched, attachment.sequence))
