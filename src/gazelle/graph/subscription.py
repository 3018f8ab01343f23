"""Subscriptions."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.graph import type_support
from gazelle.graph.callback_errors import CallbackErrors
from gazelle.graph.callback_queue import Bound, CallbackQueue
from gazelle.graph.errors import coded
from gazelle.graph.key_expressions import Attachment, Entity, token, topic_selector, type_in_key
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    from gazelle.graph.graph import Graph

__all__ = ["MAX_WAITING", "Backlog", "Delivery", "MessageInfo", "RawMessage", "Subscription"]


MAX_WAITING = 1000

"""Messages of one topic that wait at most."""


class Backlog:
    """Bounds how much of a topic waits in a queue that has room for everything.

    A world may take seconds for a step, a user's callback may not end, and messages come all the
    while: no more of them wait than `MAX_WAITING`, the oldest go first. What else waits in the
    queue keeps its place.
    """

    def __init__(
        self,
        post: Callable[[Callable[[], None]], None],
        act: Callable[[Any], None],
        overflowed: Callable[[], None],
    ) -> None:
        """Begin with none.

        Args:
            post: puts work into the queue.
            act: takes a message, when its turn has come.
            overflowed: called the first time that a message goes.
        """
        self._post = post
        self._act = act
        self._overflowed: Callable[[], None] | None = overflowed
        self._waiting: deque[Any] = deque()
        self._lock = threading.Lock()

    def put(self, message: Any) -> None:
        """Have a message acted on soon; from any thread, does not wait."""
        with self._lock:
            is_full = len(self._waiting) >= MAX_WAITING
            if is_full:
                self._waiting.popleft()
            self._waiting.append(message)
            overflowed = self._overflowed if is_full else None
            if is_full:
                self._overflowed = None
        if not is_full:
            # As many turns as messages: the oldest that goes gives its turn to the next one.
            self._post(self._take)
        elif overflowed is not None:
            overflowed()

    def _take(self) -> None:
        with self._lock:
            message = self._waiting.popleft()
        self._act(message)


_MAX_WAITING_BYTES = 64 << 20

# Of the mailbox: a message of this process and its attachment, or a sample of another.
_Item = tuple[Any, Attachment | None, Any]

# What an item holds besides its message.
_ITEM_BYTES = 500


class RawMessage(NamedTuple):
    """A message that was not decoded: CDR bytes and ``pkg/msg/Name``."""

    data: bytes
    type_name: str


class MessageInfo(NamedTuple):
    """Where a message came from.

    Attributes:
        sequence: counts the publisher's messages from 1.
        stamp_ns: wall time of publishing, nanoseconds since 1970.
        publisher: global name of the node, empty when it is gone already.
        type_name: ``pkg/msg/Name``.
        gid: 16 bytes that name the publisher.
    """

    sequence: int
    stamp_ns: int
    publisher: str
    type_name: str
    gid: bytes = bytes(16)


class Delivery(NamedTuple):
    """How messages reach the callback of a subscription.

    Attributes:
        raw: as `RawMessage`, not decoded.
        with_info: with a `MessageInfo`.
        inline: in the thread that publishes (same process) or receives.
        queue_size: most messages that wait; 0 for no limit.
        latched: with those that latched publishers sent before.
        native: messages of native publishers of this process come another way.
    """

    raw: bool = False
    with_info: bool = False
    inline: bool = False
    queue_size: int = 0
    latched: bool = True
    native: bool = False


class _WaitingSample(NamedTuple):
    """What is taken of a sample while it waits.

    The sample itself keeps the buffers it came in, which are larger and full of holes.
    """

    key_expr: str
    payload: Any
    attachment: Any


class Subscription:
    """Receives the messages of one topic.

    Callbacks run one at a time in a thread of the subscription's own, as in ROS 1; with `inline`
    they run in the thread that publishes (same process) or receives, and must be short.

    Attributes:
        topic: global name.
        message_class: class of the messages, None for any type or raw.
        native: messages of native publishers of this process come another way.
    """

    def __init__(
        self,
        graph: Graph,
        entity: Entity,
        message_class: Any,
        callback: Callable[..., None],
        *,
        delivery: Delivery,
        on_error: Callable[[str], None],
        on_warning: Callable[[str], None],
        is_mute: bool,
    ) -> None:
        """Declare the interest; use `Node.create_subscription`."""
        self.topic = entity.name
        self.message_class = message_class
        self.entity = entity
        self._graph = graph
        self._callback = callback
        self.native = delivery.native
        self._raw = delivery.raw
        self._takes_any = message_class is None
        self._with_info = delivery.with_info
        self._on_error = on_error
        self._errors = CallbackErrors()
        self._on_warning = on_warning
        self._count_seq = type_support.is_ros1_view(message_class)
        self._refused: set[str] = set()
        self._types: dict[str, str] = {}
        self._closed = is_mute
        bound = Bound(_MAX_WAITING_BYTES, _weight, _packed, self._tell_full)
        name = f"sub {self.topic}"
        self._callback_queue = CallbackQueue(
            self._handle, size=delivery.queue_size, name=name, bound=bound
        )
        self._take = self._handle if delivery.inline else self._callback_queue.put
        self._local = graph.local.topic(self.topic)
        self._declare = _declare if delivery.latched else _declare_plain
        self._declaring = threading.Lock()
        self._subscriber: Any = None
        if is_mute:
            return
        self._local.add_subscription(self, latched=delivery.latched)
        self.resume()
        self._token = graph.announcements.announce(token(graph.domain, entity))

    @property
    def dropped(self) -> int:
        """Number of messages dropped because the queue was full."""
        return self._callback_queue.dropped

    @property
    def publisher_count(self) -> int:
        """Number of publishers of the topic on the whole graph."""
        return self._graph.publisher_count(self.topic)

    def unregister(self) -> None:
        """Stop receiving; calling it twice does nothing. No callback starts afterwards."""
        if self._closed:
            return
        self._closed = True
        self._local.remove_subscription(self)
        self._token.undeclare()
        self.rest()
        self._callback_queue.close()
        self._graph.forget(self)

    def rest(self) -> None:
        """Let no messages of other processes come; they see the subscription as before."""
        with self._declaring:
            subscriber, self._subscriber = self._subscriber, None
        if subscriber is not None:
            subscriber.undeclare()

    def resume(self) -> None:
        """Let messages of other processes come, if they do not."""
        with self._declaring:
            if self._subscriber is None and not self._closed:
                selector = topic_selector(self._graph.domain, self.topic)
                self._subscriber = self._declare(self._graph.session, selector, self._on_sample)

    def take_local(self, message: Any, attachment: Attachment) -> None:
        """Take a message published in this process."""
        self._take((message, attachment, None))

    @called_by_library
    def _on_sample(self, sample: Any) -> None:
        # The history of a latched topic also holds what this process published itself.
        if self._local.publishers and _attachment_of(sample).gid in self._graph.local.gids:
            return
        self._take((None, None, sample))

    def _handle(self, item: _Item) -> None:
        message, attachment, sample = item
        if self._closed:
            return
        try:
            if sample is None:
                self._hand_local(message, attachment)
            else:
                self._take_remote(sample)
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            text = self._errors.text(f"bad callback: {self._callback}", error)
            if text:
                self._on_error(text)

    def _take_remote(self, sample: Any) -> None:
        key = str(sample.key_expr)
        type_name = self._types.get(key)
        if type_name is None:
            type_name = self._types[key] = type_in_key(key)[0]
        if type_name != self.entity.type_name and not self._accepts(type_name):
            return
        data = sample.payload.to_bytes()
        self._graph.heap.took(len(data))
        attachment = _attachment_of(sample) if self._with_info or self._count_seq else None
        if self._raw:
            self._deliver(RawMessage(data, type_name), attachment, type_name)
            return
        message_class = self.message_class or type_support.resolve_type(type_name)
        try:
            message = type_support.decode(message_class, data)
        except GazelleError as error:
            self._refuse(type_name, f"a message on {self.topic} cannot be read: {error}")
            return
        if self._count_seq and attachment is not None and hasattr(message, "header"):
            message.header.seq = attachment.sequence
        if self._graph.stamps.is_wrong(message):
            self._tell_of_stamp(message, attachment or _attachment_of(sample))
        self._deliver(message, attachment, type_name)

    def _hand_local(self, message: Any, attachment: Attachment | None) -> None:
        sent_class = type(message)
        if self._raw:
            message = RawMessage(
                type_support.encode(message), type_support.type_name_of(sent_class)
            )
        elif self.message_class is not None and not isinstance(message, self.message_class):
            if not self._accepts(type_support.type_name_of(sent_class)):
                return
            message = type_support.convert(message, self.message_class)
        self._deliver(message, attachment, sent_class)

    def _deliver(self, message: Any, attachment: Attachment | None, type_or_name: Any) -> None:
        if self._with_info and attachment is not None:
            self._callback(message, self._info(attachment, type_or_name))
        else:
            self._callback(message)

    def _info(self, attachment: Attachment, type_or_name: Any) -> MessageInfo:
        name = (
            type_or_name
            if isinstance(type_or_name, str)
            else type_support.type_name_of(type_or_name)
        )
        entity = self._graph.entity_with_gid(attachment.gid)
        publisher = entity.node if entity else ""
        sequence, stamp_ns, gid = attachment
        return MessageInfo(sequence, stamp_ns, publisher, name, gid)

    def _tell_of_stamp(self, message: Any, attachment: Attachment) -> None:
        entity = self._graph.entity_with_gid(attachment.gid)
        text = self._graph.stamps.sentence(message, self.topic, entity.node if entity else "")
        if text:
            self._on_warning(text)

    def _accepts(self, type_name: str) -> bool:
        own = self.entity.type_name
        if self._takes_any or own == type_name:
            return True
        text = (
            f"{self.entity.node} wants topic {self.topic} to have type {own}, but it is published "
            f"as {type_name}; those messages are dropped"
        )
        self._refuse(type_name, coded("graph.type-mismatch", text))
        return False

    def _tell_full(self) -> None:
        self._on_warning(
            f"the callback of {self.topic} is slower than its messages: "
            f"{_MAX_WAITING_BYTES >> 20} MiB of them wait, and the oldest are dropped from now on"
            "\n  fix: give the subscriber a queue_size, or do less in the callback"
        )

    def _refuse(self, type_name: str, text: str) -> None:
        if type_name not in self._refused:
            self._refused.add(type_name)
            self._on_error(text)


def _weight(item: _Item) -> int:
    """Return about how many bytes of memory an item of the mailbox holds."""
    message, _attachment, sample = item
    if sample is not None:
        return _ITEM_BYTES + len(sample.payload)
    data = getattr(message, "data", b"")
    size = getattr(data, "nbytes", None)
    return _ITEM_BYTES + (size or len(data) if hasattr(data, "__len__") else 0)


def _packed(item: _Item) -> _Item:
    message, attachment, sample = item
    if sample is None:
        return item
    import zenoh

    payload, attached = sample.payload, sample.attachment
    own = zenoh.ZBytes(attached.to_bytes()) if attached else None
    waiting = _WaitingSample(str(sample.key_expr), zenoh.ZBytes(payload.to_bytes()), own)
    return message, attachment, waiting


def _attachment_of(sample: Any) -> Attachment:
    attached = sample.attachment
    return Attachment.from_bytes(attached.to_bytes() if attached else b"")


def _declare(session: Any, selector: str, callback: Callable[[Any], None]) -> Any:
    """An advanced subscriber also gets what latched publishers sent before, each once."""
    import zenoh
    import zenoh.ext

    return zenoh.ext.declare_advanced_subscriber(
        session,
        selector,
        zenoh.handlers.Callback(callback, None, indirect=False),
        allowed_origin=zenoh.Locality.REMOTE,
        history=zenoh.ext.HistoryConfig(detect_late_publishers=True, max_samples=1),
    )


def _declare_plain(session: Any, selector: str, callback: Callable[[Any], None]) -> Any:
    import zenoh

    return session.declare_subscriber(
        selector,
        zenoh.handlers.Callback(callback, None, indirect=False),
        allowed_origin=zenoh.Locality.REMOTE,
    )
