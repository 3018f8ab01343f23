"""Nodes, topics and services that stand in ROS for those of the graph."""

from __future__ import annotations

import itertools
import traceback
from collections.abc import Callable
from importlib import import_module
from typing import Any

from .own_messages import OwnMessages, RosPublishers
from .pipes import FrameKind, Pipes
from .service_clients import Calls, MissingTypeError, class_of

__all__ = ["Endpoints"]


class Endpoints:
    """All that the bridge has in ROS. Only `publish` may be used outside the executor's thread.

    Attributes:
        own_names: global names of the bridge's nodes.
        ros_publishers: the publishers that are known.
    """

    def __init__(self, pipes: Pipes, node: Any, executor: Any) -> None:
        """Begin with the bridge's own node."""
        self._pipes = pipes
        self._executor = executor
        name = node.get_fully_qualified_name()
        self._home = node
        self._nodes: dict[str, Any] = {name: node}
        self.own_names: set[str] = {name}
        self.ros_publishers = RosPublishers(node, self.own_names)
        self._publishers: dict[int, tuple[Any, str]] = {}
        self._drops: dict[int, Callable[[], Any]] = {}
        self._services: dict[int, Any] = {}
        self._headers: dict[tuple[int, int], Any] = {}
        self._numbers = itertools.count(1)
        self._own_messages: dict[str, OwnMessages] = {}
        self._calls = Calls(pipes, node)
        info = getattr(import_module("rclpy.subscription"), "MessageInfo", None)
        self._tells_gid = "publisher_gid" in getattr(info, "__annotations__", {})
        self._serialize = import_module("rclpy.serialization").serialize_message
        self._deserialize = import_module("rclpy.serialization").deserialize_message

    def obey(self, command: dict[str, Any]) -> None:
        """Carry out a command and report how it went."""
        what, channel = command["do"], command.get("channel", 0)
        type_hash = ""
        try:
            type_hash = getattr(self, f"_do_{what}")(command) or ""
            error, missing = "", False
        except MissingTypeError as problem:
            error, missing = str(problem), True
        except Exception as problem:  # noqa: BLE001 - told; rclpy has no common class
            # rclpy draws a caret below the bad letter of a name, on a line of its own.
            text = " ".join(str(problem).split()).removesuffix(" ^")
            error, missing = f"{type(problem).__name__}: {text}", False
        self._pipes.send_control(
            report="done", channel=channel, error=error, missing=missing, type_hash=type_hash
        )

    def publish(self, channel: int, data: bytes) -> None:
        """Publish a message; one for a topic that is gone by now is dropped."""
        publisher, topic = self._publishers.get(channel, (None, ""))
        if publisher is None:
            return
        own_messages = self._own_messages.get(topic)
        if own_messages is not None:
            own_messages.note(data)
        try:
            publisher.publish(data)
        except Exception:  # noqa: BLE001 - told; rclpy has no common class
            if channel in self._publishers:
                traceback.print_exc()

    def call(self, channel: int, number: int, data: bytes) -> None:
        """Call a service of ROS; the answer goes to the other half."""
        self._calls.call(channel, number, data)

    def answer(self, channel: int, number: int, data: bytes | None) -> None:
        """Answer a call from ROS, or with None forget it: ROS 2 has no answer for a failure."""
        header = self._headers.pop((channel, number), None)
        service = self._services.get(channel)
        if header is None or service is None or data is None:
            return
        response = self._deserialize(data, service.srv_type.Response)
        type(service).send_response(service, response, header)

    def close(self) -> None:
        """Take all nodes out of ROS."""
        self._publishers.clear()
        for node in self._nodes.values():
            self._executor.remove_node(node)
            node.destroy_node()

    def _do_node(self, command: dict[str, Any]) -> None:
        name = command["node"]
        namespace, _, base = name.rpartition("/")
        # Before it is there: the watch must not take it for somebody else's.
        self.own_names.add(name)
        try:
            node = import_module("rclpy.node").Node(
                base,
                namespace=namespace or "/",
                enable_rosout=False,
                start_parameter_services=False,
            )
        except Exception:
            self.own_names.discard(name)
            raise
        self._nodes[name] = node
        self._executor.add_node(node)

    def _do_unnode(self, command: dict[str, Any]) -> None:
        node = self._nodes.pop(command["node"], None)
        if node is None:
            return
        self._executor.remove_node(node)
        node.destroy_node()
        self.own_names.discard(command["node"])

    def _do_publisher(self, command: dict[str, Any]) -> str:
        node, topic, channel = self._node(command), command["topic"], command["channel"]
        made = node.create_publisher(
            class_of(command["type"]),
            topic,
            _qos(command),
            event_callbacks=_silent("PublisherEventCallbacks"),
        )
        self.ros_publishers.learn(topic)
        if command["latched"] and not self._tells_gid:
            # A subscription that comes later hears what is latched now.
            self._own_messages[topic] = OwnMessages(for_ever=True)
        self._publishers[channel] = (made, topic)
        self._drops[channel] = lambda: node.destroy_publisher(made)
        return _type_hash(node, self._home.get_publishers_info_by_topic(topic), command["type"])

    def _do_subscription(self, command: dict[str, Any]) -> str:
        node, topic, channel = self._node(command), command["topic"], command["channel"]
        taker = self._taker(channel, topic)
        kind = class_of(command["type"])
        made = node.create_subscription(
            kind,
            topic,
            taker,
            _qos(command),
            raw=True,
            event_callbacks=_silent("SubscriptionEventCallbacks"),
        )
        self._drops[channel] = lambda: node.destroy_subscription(made)
        return _type_hash(node, self._home.get_subscriptions_info_by_topic(topic), command["type"])

    def _do_service(self, command: dict[str, Any]) -> None:
        node, channel = self._node(command), command["channel"]
        kind = class_of(command["type"])
        made = node.create_service(kind, command["topic"], lambda request, _response: request)
        # The executor hands what the callback returns to this method, which answers at once in
        # rclpy. Here the request goes on, and the answer comes whenever it comes.
        made.send_response = lambda request, header: self._pass_on(channel, request, header)
        self._services[channel] = made
        self._drops[channel] = lambda: node.destroy_service(made)

    def _do_client(self, command: dict[str, Any]) -> None:
        channel = command["channel"]
        made = self._home.create_client(class_of(command["type"]), command["topic"])
        self._calls.add(channel, made)
        self._drops[channel] = lambda: self._home.destroy_client(made)

    def _do_drop(self, command: dict[str, Any]) -> None:
        channel = command["channel"]
        self._publishers.pop(channel, None)
        self._services.pop(channel, None)
        self._calls.remove(channel)
        for key in [key for key in self._headers if key[0] == channel]:
            del self._headers[key]
        drop = self._drops.pop(channel, None)
        if drop is not None:
            drop()

    def _node(self, command: dict[str, Any]) -> Any:
        """The node, or the bridge's own for one that ROS does not allow."""
        return self._nodes.get(command["node"], self._home)

    def _taker(self, channel: int, topic: str) -> Callable[[bytes, Any], None]:
        def take(data: bytes, info: Any) -> None:
            number = self.ros_publishers.number_of(topic, bytes(info["publisher_gid"]["data"]))
            if number:
                self._pipes.send(FrameKind.MESSAGE, channel, number, data)

        def take_unsigned(data: bytes, _info: Any) -> None:
            if not own_messages.is_echo(data):
                self._pipes.send(FrameKind.MESSAGE, channel, 0, data)

        if self._tells_gid:
            return take
        own_messages = self._own_messages.setdefault(topic, OwnMessages())
        return take_unsigned

    def _pass_on(self, channel: int, request: Any, header: Any) -> None:
        number = next(self._numbers)
        self._headers[channel, number] = header
        self._pipes.send(FrameKind.REQUEST, channel, number, self._serialize(request))


def _type_hash(node: Any, infos: list[Any], type_name: str) -> str:
    """Return the hash of a type as ROS has built it, empty before Iron."""
    for one in infos:
        if (one.node_name, one.topic_type) == (node.get_name(), type_name):
            return str(getattr(one, "topic_type_hash", ""))
    return ""


def _silent(name: str) -> Any:
    """Callbacks that do not complain about differing qualities: the other half does, once."""
    try:
        events = import_module("rclpy.event_handler")
    except ImportError:
        # Before Iron.
        events = import_module("rclpy.qos_event")
    return getattr(events, name)(use_default_callbacks=False)


def _qos(command: dict[str, Any]) -> Any:
    qos = import_module("rclpy.qos")
    reliability, durability = qos.ReliabilityPolicy, qos.DurabilityPolicy
    return qos.QoSProfile(
        depth=command["depth"],
        reliability=reliability.RELIABLE if command["reliable"] else reliability.BEST_EFFORT,
        durability=durability.TRANSIENT_LOCAL if command["latched"] else durability.VOLATILE,
    )
