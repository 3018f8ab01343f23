"""Publisher, Subscriber and wait_for_message (rospy.topics)."""

from __future__ import annotations

import sys
import threading
import time
import traceback
import warnings
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.compat.rospy.exceptions import (
    ROSException,
    ROSInterruptException,
    ROSSerializationException,
)
from gazelle.compat.rospy.state import STATE
from gazelle.errors import GazelleError
from gazelle.graph import MessageInfo, Node, RawMessage
from gazelle.graph import Publisher as _Publisher
from gazelle.graph.callback_errors import CallbackErrors
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.interfaces import (
    AnyMsg,
    Ros1Message,
    from_cdr,
    ros1_message_type,
    ros1_type_of,
    to_ros1,
)

__all__ = ["Publisher", "SubscribeListener", "Subscriber", "Topic", "wait_for_message"]

_SLICE_S = 0.1


class SubscribeListener:
    """Base of objects that a `Publisher` tells about its subscribers."""

    def peer_subscribe(
        self, topic_name: str, topic_publish: Callable[..., None], peer_publish: Callable[..., None]
    ) -> None:
        """Hear of a new subscriber; `peer_publish` reaches all of them here."""

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """Hear that a subscriber has left."""


class Topic:
    """What publishers and subscribers have in common.

    Attributes:
        name, resolved_name: the topic.
        data_class: message class.
        type: type name, such as ``std_msgs/String``.
        md5sum: MD5 sum of the type.
        reg_type: ``pub`` or ``sub``.
    """

    def __init__(self, name: str, data_class: type[Ros1Message], reg_type: str) -> None:
        if not isinstance(name, str) or not name:
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if not (isinstance(data_class, type) and hasattr(data_class, "_type")):
            raise ValueError(f"data_class [{data_class}] is not a class of messages")
        self.name = STATE.resolved(name)
        self.resolved_name = self.name
        self.data_class = data_class
        self.type = data_class._type
        self.md5sum = data_class._md5sum
        self.reg_type = reg_type
        self.impl: Any = None
        self._is_unregistered = False

    def get_num_connections(self) -> int:
        """Return how many subscribers a publisher has, or publishers a subscriber."""
        if self.impl is None or STATE.stopping.is_set():
            return 0
        is_publisher = isinstance(self.impl, _Publisher)
        return int(self.impl.subscription_count if is_publisher else self.impl.publisher_count)

    def unregister(self) -> None:
        """Stop offering or receiving the topic."""
        self._is_unregistered = True
        if self.impl is not None:
            self.impl.unregister()
            self.impl = None


def warn_of_headers(headers: Mapping[str, str] | None) -> None:
    """Say that a connection's own headers reach nobody: this graph has no connections."""
    if headers:
        names = ", ".join(sorted(headers))
        text = f"headers are not sent: {names} will not be in anybody's _connection_header"
        sys.stderr.write(f"[WARN] {text}\n")


class Publisher(Topic):
    """Offers a topic.

    Args:
        name: any legal name.
        data_class: message class.
        subscriber_listener: told about subscribers.
        latch: give late subscribers the last message.
        tcp_nodelay: without effect: the graph sends at once in any case.
        queue_size: told to others; the graph sends at once, so nothing waits here.
    """

    def __init__(
        self,
        name: str,
        data_class: type[Ros1Message],
        subscriber_listener: SubscribeListener | None = None,
        tcp_nodelay: bool = False,
        latch: bool = False,
        headers: dict[str, str] | None = None,
        queue_size: int | None = None,
    ) -> None:
        super().__init__(name, data_class, "pub")
        warn_of_headers(headers)
        if queue_size is None:
            warnings.warn(
                "The publisher should be created with an explicit keyword argument 'queue_size'. "
                "Please see http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers",
                SyntaxWarning,
                stacklevel=2,
            )
        self._listener = subscriber_listener
        self._count = 0
        STATE.when_ready(lambda node: self._open(node, name, latch, queue_size or 10))

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Send a message, or one made of the arguments.

        Raises:
            TypeError: the arguments make no message of the topic's type.
            ROSException: `init_node` was not called yet, or the topic was unregistered.
            ROSSerializationException: a field's value does not fit its type.
        """
        if self._is_unregistered:
            raise ROSException("publish() to an unregistered() handle")
        if self.impl is None:
            raise ROSException(
                "ROS node has not been initialized yet. Please call init_node() first"
            )
        message = message_of(self.data_class, args, kwds)
        try:
            self.impl.publish(message)
        except GazelleError as error:
            raise ROSSerializationException(str(error)) from error

    def _open(self, node: Node, name: str, latch: bool, queue_size: int) -> None:
        if self._is_unregistered:
            return
        self.impl = node.create_publisher(
            name, self.data_class, latch=latch, queue_size=queue_size, copy_local=True
        )
        self.name = self.resolved_name = self.impl.topic
        if self._listener is not None:
            # A listener may ask the graph, whose answers come through the thread that tells here.
            news = CallbackQueue(self._tell_listener, size=0, name=f"listener {self.name}")
            node.graph.discovery.listen(lambda entity, _is_new: news.put(entity))
            news.put(None)

    def _tell_listener(self, _entity: object) -> None:
        try:
            self._tell_of_peers()
        except Exception:  # noqa: BLE001 - a user's listener may raise anything
            sys.stderr.write(traceback.format_exc())

    def _tell_of_peers(self) -> None:
        if self._listener is None or self.impl is None:
            return
        count = self.impl.subscription_count
        while self._count < count:
            self._count += 1
            self._listener.peer_subscribe(self.name, self.publish, self.publish)
        while self._count > count:
            self._count -= 1
            self._listener.peer_unsubscribe(self.name, self._count)


def message_of(
    data_class: type[Ros1Message], args: tuple[Any, ...], kwds: dict[str, Any]
) -> Ros1Message:
    """Return the message that `publish` and service calls make of their arguments.

    Raises:
        TypeError: they are a message of another type, or do not fit the fields.
        AttributeError: a keyword is no field.
    """
    if args and kwds:
        raise TypeError("publish() can be called with arguments or keywords, but not both.")
    if len(args) == 1 and isinstance(args[0], Ros1Message):
        given = args[0]
        if isinstance(given, data_class) or given._md5sum == data_class._md5sum:
            return given
        if data_class._slot_types[:1] != [given._type] or len(data_class.__slots__) != 1:
            raise TypeError(f"expected [{data_class._type}] but got [{given._type}]")
    return data_class(*args, **kwds)


class Subscriber(Topic):
    """Receives a topic; callbacks of one topic come one after another in a thread of its own.

    Args:
        name: any legal name.
        data_class: message class, or `rospy.AnyMsg` for raw bytes of any type.
        callback: takes the message, and `callback_args` when that is not None.
        queue_size: most messages that wait; None for no limit.
        buff_size: without effect: messages come whole, so a large one needs no larger buffer.
        tcp_nodelay: without effect: the graph sends at once in any case.
    """

    def __init__(
        self,
        name: str,
        data_class: type[Ros1Message],
        callback: Callable[..., Any] | None = None,
        callback_args: Any = None,
        queue_size: int | None = None,
        buff_size: int = 65536,
        tcp_nodelay: bool = False,
    ) -> None:
        super().__init__(name, data_class, "sub")
        self.callback = callback
        self.callback_args = callback_args
        self._headers: dict[bytes, dict[str, str]] = {}
        self._errors = CallbackErrors()
        STATE.when_ready(lambda node: self._open(node, name, queue_size or 0))

    def _open(self, node: Node, name: str, queue_size: int) -> None:
        if self._is_unregistered:
            return
        raw = issubclass(self.data_class, AnyMsg)
        self.impl = node.create_subscription(
            name,
            None if raw else self.data_class,
            self._on_raw if raw else self._on_message,
            queue_size=queue_size,
            raw=raw,
            with_info=True,
        )
        self.name = self.resolved_name = self.impl.topic

    def _on_raw(self, raw: RawMessage, info: MessageInfo) -> None:
        """Turn the wire's bytes into the ROS 1 bytes that AnyMsg holds."""
        cls = ros1_message_type(ros1_type_of(raw.type_name))
        message: Any = self.data_class()
        message._buff = to_ros1(from_cdr(cls, raw.data))
        self._on_message(message, info, cls)

    def _on_message(
        self, message: Any, info: MessageInfo, sent_class: type[Ros1Message] | None = None
    ) -> None:
        if self.callback is None or STATE.stopping.is_set():
            return
        if not isinstance(message, self.data_class):
            # numpy_msg's classes: the graph knows only the class that they are made from.
            fields = [getattr(message, name) for name in type(message).__slots__]
            message = self.data_class(*fields)
        message._connection_header = self._header(info, sent_class or self.data_class)
        try:
            if self.callback_args is not None:
                self.callback(message, self.callback_args)
            else:
                self.callback(message)
        except ROSInterruptException:
            return
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            sys.stderr.write(self._errors.text(f"[ERROR] bad callback: {self.callback}", error))

    def _header(self, info: MessageInfo, sent_class: type[Ros1Message]) -> dict[str, str]:
        """Return what a publisher of ROS 1 says when it is connected, as far as it is known."""
        found = self._headers.get(info.gid)
        if found is None:
            assert STATE.node is not None
            entity = STATE.node.graph.entity_with_gid(info.gid)
            found = self._headers[info.gid] = {
                "callerid": info.publisher,
                "latching": str(int(entity is not None and entity.qos.latched)),
                "md5sum": sent_class._md5sum,
                "message_definition": sent_class._full_text,
                "topic": self.name,
                "type": sent_class._type,
            }
            if entity is None:
                # Its announcement can come after its first message: ask again at the next one.
                del self._headers[info.gid]
        return found


def wait_for_message(topic: str, topic_type: type[Ros1Message], timeout: Any = None) -> Any:
    """Return the next message of a topic.

    Args:
        topic: any legal name.
        topic_type: message class.
        timeout: seconds, or a Duration; None waits for ever.

    Raises:
        ROSException: time is up.
        ROSInterruptException: the node was shut down meanwhile.
    """
    seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else timeout
    got: list[Any] = []
    arrived = threading.Event()

    def take(message: Any) -> None:
        if not got:
            got.append(message)
        arrived.set()

    STATE.require("wait_for_message")
    subscriber = Subscriber(topic, topic_type, take)
    deadline_s = None if seconds is None else time.monotonic() + seconds
    try:
        while not STATE.stopping.is_set():
            left_s = _SLICE_S
            if deadline_s is not None:
                left_s = min(_SLICE_S, max(0.0, deadline_s - time.monotonic()))
            if arrived.wait(left_s) or left_s < _SLICE_S:
                break
    finally:
        subscriber.unregister()
    STATE.check_running()
    if not got:
        raise ROSException(f"timeout exceeded while waiting for message on topic {topic}")
    return got[0]
