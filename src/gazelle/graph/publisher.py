"""Publishers."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph import type_support
from gazelle.graph.key_expressions import Attachment, Entity, entity_gid, token, topic_key
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    from gazelle.graph.graph import Graph
    from gazelle.graph.subscription import Subscription

__all__ = ["Publisher"]

_UNSURE_S = 0.5


class Publisher:
    """Sends messages of one type on one topic.

    Subscriptions in this process get the very object; it must not be changed afterwards, or
    `copy_local` must be asked for. Others get CDR bytes, made only when somebody listens.

    Attributes:
        topic: global name.
        message_class: class of the messages.
        latch: whether late subscriptions get the last message.
        graph: the graph it publishes on.
        native: native subscriptions of this process get its messages another way.
    """

    def __init__(
        self,
        graph: Graph,
        entity: Entity,
        message_class: Any,
        *,
        copy_local: bool,
        reliable: bool,
        native: bool,
        is_mute: Callable[[], bool],
    ) -> None:
        """Declare the topic; use `Node.create_publisher`."""
        self.native = native
        self.topic = entity.name
        self.message_class = message_class
        self.latch = entity.qos.latched
        self.entity = entity
        self.graph = graph
        self._copy_local = copy_local
        self._is_mute = is_mute
        self._closed = is_mute()
        self._reliable = reliable
        self._last: Any = None
        self._latching = threading.RLock()
        self._sequence = 0
        self._watching: list[Any] = []
        self._unsure = True
        self._sure_s = time.monotonic() + _UNSURE_S
        text = token(graph.domain, entity)
        self.gid = entity_gid(text)
        key = topic_key(graph.domain, self.topic, entity.type_name, entity.type_hash)
        self._local = graph.local.topic(self.topic)
        self._transport = self._local.transport
        if self._closed:
            return
        graph.local.gids.add(self.gid)
        self._matcher, self._sender = _declare(
            graph.session, key, reliable=reliable, latched=self.latch
        )
        self._local.add_publisher(self)
        self._token = graph.announcements.announce(text)

    @property
    def matched(self) -> bool:
        """True when somebody subscribes, here or elsewhere; takes about a microsecond."""
        if self._local.subscriptions:
            return True
        return self._matched_elsewhere()

    @property
    def wanted(self) -> bool:
        """True when a message would reach somebody through `publish`, or nobody knows yet."""
        return bool(self._listeners()) or self._is_wanted_elsewhere()

    def watch(self, act: Callable[[], None]) -> None:
        """Call something, in any thread, whenever `wanted` may have changed, except by time."""
        if self._closed:
            return

        @called_by_library
        def on_status(_status: Any) -> None:
            act()

        self._watching.append(self._matcher.declare_matching_listener(on_status))
        self._local.watchers = (*self._local.watchers, act)

    @property
    def subscription_count(self) -> int:
        """Number of subscriptions of the topic on the whole graph."""
        return self.graph.subscription_count(self.topic)

    def publish(self, message: Any) -> None:
        """Send one message.

        Raises:
            GraphError: the publisher was unregistered, or the message is of another class.
        """
        if self._is_over():
            return
        if not isinstance(message, self.message_class):
            raise GraphError(
                f"publish() on {self.topic}: this is a {type(message).__module__}."
                f"{type(message).__qualname__}, the topic's type is {self.entity.type_name}"
            )
        if self.latch:
            self._publish_latched(message)
            return
        self._sequence += 1
        local = self._listeners()
        if local:
            self._hand(message, local)
        if self._is_wanted_elsewhere():
            self._send(message)

    def publish_raw(self, data: bytes) -> None:
        """Send a message that is CDR bytes already, of the topic's type.

        Raises:
            GraphError: the publisher was unregistered.
            InterfaceError: somebody listens in this process, and the bytes are not of the type.
        """
        if self._is_over():
            return
        if self.latch or self._local.subscriptions:
            self.publish(type_support.decode(self.message_class, data))
            return
        self._sequence += 1
        if self._is_wanted_elsewhere():
            self._send_bytes(data)

    def unregister(self) -> None:
        """Stop offering the topic; calling it twice does nothing."""
        if self._closed:
            return
        self._closed = True
        self._local.remove_publisher(self)
        with self._transport:
            self._token.undeclare()
            for one in self._watching:
                one.undeclare()
            self._matcher.undeclare()
            if self._sender is not self._matcher:
                self._sender.undeclare()
        self.graph.forget(self)

    def hand_latched(self, subscription: Subscription) -> None:
        """Give the last latched message to a new subscription of this process."""
        if self._last is not None and not (self.native and subscription.native):
            subscription.take_local(self._last, self._attachment())

    def _is_over(self) -> bool:
        if self._closed and not self._is_mute():
            raise GraphError(f"publish() to a closed topic: {self.topic} was unregistered")
        return self._closed

    def _publish_latched(self, message: Any) -> None:
        # Of two threads that publish, both here and elsewhere the same one has the last word.
        with self._latching:
            with self._local.lock:
                self._sequence += 1
                self._last = message
                self._hand(message, self._listeners())
            self._send(message)

    def _listeners(self) -> tuple[Subscription, ...]:
        local = self._local.subscriptions
        return tuple(one for one in local if not one.native) if self.native else local

    def _hand(self, message: Any, subscriptions: tuple[Subscription, ...]) -> None:
        if self._copy_local and subscriptions:
            message = type_support.decode(self.message_class, type_support.encode(message))
        attachment = self._attachment()
        for subscription in subscriptions:
            subscription.take_local(message, attachment)

    def _is_wanted_elsewhere(self) -> bool:
        """Whether to send; the hub takes a while to tell a new publisher who listens already."""
        if self._unsure:
            self._unsure = time.monotonic() < self._sure_s
        return self._unsure or self._matched_elsewhere()

    def _matched_elsewhere(self) -> bool:
        with self._transport:
            return not self._closed and bool(self._matcher.matching_status.matching)

    def _send(self, message: Any) -> None:
        self._send_bytes(type_support.encode(message))

    def _send_bytes(self, payload: bytes) -> None:
        attachment = self._attachment().to_bytes()
        with self._transport:
            if not self._closed:
                self._sender.put(payload, attachment=attachment)
                if self._reliable:
                    self._local.sent_s = time.monotonic()

    def _attachment(self) -> Attachment:
        return Attachment(self._sequence, time.time_ns(), self.gid)


def _declare(session: Any, key: str, *, reliable: bool, latched: bool) -> tuple[Any, Any]:
    """Return the publisher that knows whether anybody listens, and the one that sends.

    They differ for latched topics: an advanced publisher keeps the last message for late
    subscriptions and does not tell whether it is matched.
    """
    import zenoh
    import zenoh.ext

    block = zenoh.CongestionControl.BLOCK if reliable else zenoh.CongestionControl.DROP
    remote = zenoh.Locality.REMOTE
    plain = session.declare_publisher(key, congestion_control=block, allowed_destination=remote)
    if not latched:
        return plain, plain
    return plain, zenoh.ext.declare_advanced_publisher(
        session,
        key,
        congestion_control=block,
        allowed_destination=remote,
        cache=zenoh.ext.CacheConfig(1),
        # Numbers each publisher's samples; by time alone, those of one process shadow each other.
        sample_miss_detection=zenoh.ext.MissDetectionConfig(
            heartbeat=None, sporadic_heartbeat=None
        ),
        publisher_detection=True,
    )
