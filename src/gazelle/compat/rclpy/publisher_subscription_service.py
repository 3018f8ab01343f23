"""Publishers, subscriptions, services and clients (rclpy.publisher and so on)."""

from __future__ import annotations

import inspect
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.executors import Once
from gazelle.compat.rclpy.qos import HistoryPolicy, QoSProfile, announced_qos, tell_unusual_qos
from gazelle.compat.rclpy.task import Future
from gazelle.errors import GazelleError
from gazelle.graph import MessageInfo, RawMessage
from gazelle.graph.service_requests import InTurn, Turn, Turns
from gazelle.interfaces import from_cdr

if TYPE_CHECKING:
    from gazelle.compat.rclpy.event_handler import EventWatch
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "RMW_IDENTIFIER",
    "Client",
    "MsgType",
    "Publisher",
    "Service",
    "SrvType",
    "SrvTypeRequest",
    "SrvTypeResponse",
    "Subscription",
    "check_type",
]

MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")
RMW_IDENTIFIER = "rmw_zenoh_cpp"


class Publisher:
    """Offers a topic; made by `Node.create_publisher`."""

    def __init__(self, node: Node, msg_type: Any, topic: str, qos: QoSProfile) -> None:
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos
        self.events: EventWatch | None = None
        self._node = node
        self._impl = node.graph_node.create_publisher(
            node.resolve_topic_name(topic, only_expand=True),
            msg_type,
            latch=qos.is_latched,
            reliable=qos.is_reliable,
            copy_local=True,
            qos=announced_qos(qos),
        )

    @property
    def topic_name(self) -> str:
        """Global name."""
        return self._impl.topic

    @property
    def logger_name(self) -> str:
        """Name of the node's logger."""
        return self._node.get_logger().name

    def publish(self, msg: Any) -> None:
        """Send a message, or the bytes of one.

        Raises:
            TypeError: it is of another type.
        """
        if isinstance(msg, bytes):
            msg = from_cdr(self.msg_type, msg)
        if not isinstance(msg, self.msg_type):
            given = f"{type(msg).__module__}.{type(msg).__qualname__}"
            wanted = f"{self.msg_type.__module__}.{self.msg_type.__qualname__}"
            raise TypeError(f"Expected {wanted}, got {given} on topic {self.topic_name}")
        if self.events is not None:
            self.events.note()
        self._impl.publish(msg)

    def assert_liveliness(self) -> None:
        """Say that it lives, which this graph knows by itself."""

    def wait_for_all_acked(self, timeout: Any = None) -> bool:
        """Return True: what was sent is on its way in order, and needs no word back."""
        return not self._node.is_destroyed

    def get_subscription_count(self) -> int:
        """Return how many subscriptions there are."""
        return self._impl.subscription_count

    def destroy(self) -> None:
        """Stop offering the topic."""
        if self.events is not None:
            self.events.close()
        self._impl.unregister()


class Subscription:
    """Receives a topic; made by `Node.create_subscription`."""

    def __init__(
        self,
        node: Node,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        qos: QoSProfile,
        *,
        group: CallbackGroup,
        raw: bool,
    ) -> None:
        self.msg_type = msg_type
        self.topic = topic
        self.callback = callback
        self.qos_profile = qos
        self.raw = raw
        self.callback_group = group
        self.events: EventWatch | None = None
        self._node = node
        depth = None if qos.history is HistoryPolicy.KEEP_ALL else max(qos.depth, 1)
        self._messages: deque[tuple[Any, MessageInfo, int]] = deque(maxlen=depth)
        self._wants_info = _takes_two(callback)
        group.add_entity(self)
        self._impl = node.graph_node.create_subscription(
            node.resolve_topic_name(topic, only_expand=True),
            msg_type,
            self._on_message,
            raw=raw,
            with_info=True,
            inline=True,
            qos=announced_qos(qos),
        )

    @property
    def topic_name(self) -> str:
        """Global name."""
        return self._impl.topic

    def take(self) -> Callable[[], Any] | None:
        """Return the call with the oldest message that waits."""
        try:
            message, info, received_ns = self._messages.popleft()
        except IndexError:
            return None
        callback = self.callback
        if self._wants_info:
            details = _details(info, received_ns)
            return lambda: callback(message, details)
        return lambda: callback(message)

    def get_publisher_count(self) -> int:
        """Return how many publishers there are."""
        return self._impl.publisher_count

    def destroy(self) -> None:
        """Stop receiving."""
        if self.events is not None:
            self.events.close()
        self._impl.unregister()
        self._messages.clear()

    def _on_message(self, message: Any, info: MessageInfo) -> None:
        if isinstance(message, RawMessage):
            message = message.data
        if self.events is not None:
            self.events.note()
        self._messages.append((message, info, time.time_ns()))
        self._node.post_work(self)


class Service:
    """Answers a service; made by `Node.create_service`."""

    def __init__(
        self,
        node: Node,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        qos: QoSProfile,
        group: CallbackGroup,
    ) -> None:
        tell_unusual_qos(f"service '{srv_name}'", qos)
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.callback = callback
        self.callback_group = group
        self._node = node
        group.add_entity(self)
        full = node.resolve_service_name(srv_name, only_expand=True)
        self._impl = node.graph_node.create_service(full, srv_type, InTurn(self._on_request))

    @property
    def service_name(self) -> str:
        """Global name."""
        return self._impl.name

    def destroy(self) -> None:
        """Stop answering."""
        self._impl.unregister()

    def _on_request(self, request: Any) -> Callable[[], Any]:
        return self._node.run_in_executor(self.callback_group, lambda: self._respond(request))

    async def _respond(self, request: Any) -> Any:
        response = self.callback(request, self.srv_type.Response())
        return await response if inspect.isawaitable(response) else response


class Client:
    """Calls a service; made by `Node.create_client`."""

    def __init__(
        self, node: Node, srv_type: Any, srv_name: str, qos: QoSProfile, group: CallbackGroup
    ) -> None:
        tell_unusual_qos(f"client of '{srv_name}'", qos)
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.callback_group = group
        self._node = node
        full = node.resolve_service_name(srv_name, only_expand=True)
        self._impl = node.graph_node.create_client(full, srv_type)
        self._turns = Turns()

    @property
    def service_name(self) -> str:
        """Global name."""
        return self._impl.name

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Call and wait; somebody else must spin. None when time is up."""
        done = threading.Event()
        future = self.call_async(request)
        future.wake_with(lambda _future: done.set())
        if not done.wait(timeout_sec):
            return None
        return future.result()

    def call_async(self, request: Any) -> Future:
        """Call; the future is done while the node spins.

        Raises:
            TypeError: the request is of another type.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(
                f"Expected a request of {self.service_name}, got {type(request).__qualname__}"
            )
        future = Future(executor=self._node.executor)
        threading.Thread(
            target=self._call,
            args=(request, future, self._turns.take()),
            name="service call",
            daemon=True,
        ).start()
        return future

    def service_is_ready(self) -> bool:
        """Tell whether somebody offers the service."""
        return self._impl.available

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Wait until somebody offers the service; False when time is up first."""
        timeout_s = None if timeout_sec is None or timeout_sec < 0 else timeout_sec
        while self._node.context.ok():
            slice_s = 0.2 if timeout_s is None else min(0.2, timeout_s)
            if self._impl.wait_for_service(slice_s):
                return True
            if timeout_s is not None:
                timeout_s -= slice_s
                if timeout_s <= 0:
                    return False
        return False

    def remove_pending_request(self, future: Future) -> None:
        """Wait for a response no more."""
        future.cancel()

    def destroy(self) -> None:
        """Give the client up."""
        self._impl.unregister()

    def _call(self, request: Any, future: Future, turn: Turn) -> None:
        finish: Callable[[], Any]
        try:
            with turn:
                # As in ROS 2 a request to a service that comes later is answered then.
                while not self._impl.wait_for_service(0.2):
                    if not self._node.context.ok() or future.cancelled():
                        return
                answered = self._impl.send(request)
            response = answered()
        except GazelleError as raised:
            error = raised

            def finish() -> None:
                future.set_exception(error)
        else:

            def finish() -> None:
                future.set_result(response)

        if not future.cancelled():
            self._node.post_work(Once(self.callback_group, finish))


def check_type(kind: Any, part: str) -> None:
    """See that a type is one of ROS 2.

    Raises:
        AttributeError: it is not; the text is near to rclpy's.
    """
    if hasattr(kind, "_slot_types") or hasattr(kind, "_request_class"):
        raise AttributeError(
            f"{kind._type} has the form of ROS 1, since it was imported by a module of ROS 1\n"
            "  fix: import rclpy in that module, or set ROS_VERSION=2\n"
            "  ROS says: This might be a ROS 1 message type but it should be a ROS 2 message type."
        )
    fits = hasattr(kind, "FIELDS") if part == "msg" else hasattr(kind, "Response")
    if part == "action":
        fits = hasattr(kind, "Goal")
    if not fits:
        raise AttributeError(f"{kind!r} is no {part} type of ROS 2")


def _details(info: MessageInfo, received_ns: int) -> dict[str, Any]:
    """Return rclpy's `MessageInfo`, a dictionary; wall times in nanoseconds since 1970."""
    return {
        "source_timestamp": info.stamp_ns,
        "received_timestamp": received_ns,
        "publication_sequence_number": info.sequence,
        "reception_sequence_number": None,
        "publisher_gid": {
            "implementation_identifier": RMW_IDENTIFIER,
            "data": info.gid,
        },
    }


def _takes_two(callback: Callable[..., Any]) -> bool:
    """Tell whether a subscription's callback wants the message's details as well."""
    try:
        inspect.signature(callback).bind(object())
    except TypeError:
        try:
            inspect.signature(callback).bind(object(), object())
        except TypeError as error:
            raise RuntimeError(
                "Subscription.__init__(): callback should be either be callable with one argument"
                " (to get only the message) or two (to get message and message info)"
            ) from error
        return True
    except ValueError:
        return False
    return False
