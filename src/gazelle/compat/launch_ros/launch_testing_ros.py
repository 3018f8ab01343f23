"""launch_testing_ros: what tests of launches need of a graph."""

from __future__ import annotations

import secrets
import threading
from collections import deque
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any, Self

from gazelle.compat import rclpy
from gazelle.compat.rclpy.context import Context
from gazelle.compat.rclpy.executors import SingleThreadedExecutor
from gazelle.compat.rclpy.node import Node
from gazelle.workspace.ament_index import get_resource, has_resource

__all__ = ["DataRepublisher", "MessagePump", "WaitForTopics", "get_rmw_output_filter"]

_SPIN_S = 0.2
_STOP_S = 5.0
_FILTERS = ("prefixes", "patterns")


class MessagePump:
    """Spins a node in a thread, between `start` and `stop`."""

    def __init__(self, node: Any, context: Any = None) -> None:
        self._node = node
        self._context = context
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="msg_pump_thread", daemon=True)

    def start(self) -> None:
        """Begin to spin."""
        self._thread.start()

    def stop(self) -> None:
        """End spinning.

        Raises:
            RuntimeError: a callback does not end.
        """
        self._ended.set()
        self._thread.join(timeout=_STOP_S)
        if self._thread.is_alive():
            raise RuntimeError("Timed out waiting for message pump to stop")

    def _run(self) -> None:
        executor = SingleThreadedExecutor(context=self._context)
        executor.add_node(self._node)
        while not self._ended.is_set():
            executor.spin_once(timeout_sec=_SPIN_S)
        executor.remove_node(self._node)


class DataRepublisher:
    """Publishes what a function makes of the messages of another topic; None drops one."""

    def __init__(
        self,
        node: Any,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Any],
    ) -> None:
        self._node = node
        self._transform = transform_fn
        self._count = 0
        self._republished: list[Any] = []
        self._publisher = node.create_publisher(msg_type, publish_topic, 10)
        self._subscription = node.create_subscription(msg_type, listen_topic, self._take, 10)

    def shutdown(self) -> None:
        """Stop."""
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)

    def get_num_received(self) -> int:
        """Return how many messages have come."""
        return self._count

    def get_num_republished(self) -> int:
        """Return how many of them have gone on."""
        return len(self._republished)

    def get_republished(self) -> list[Any]:
        """Return the messages that have gone on, as they came."""
        return self._republished

    def _take(self, message: Any) -> None:
        self._count += 1
        made = self._transform(message)
        if made:
            self._republished.append(message)
            self._publisher.publish(made)


class WaitForTopics:
    """Waits for a message on each of some topics; in a ``with`` block, or by `wait`."""

    def __init__(
        self,
        topic_tuples: Sequence[tuple[str, Any]],
        timeout: float = 5.0,
        messages_received_buffer_length: int | None = 10,
    ) -> None:
        self.topic_tuples = topic_tuples
        self.timeout = timeout
        self.messages_received_buffer_length = messages_received_buffer_length
        self._messages: dict[str, deque[Any]] = {}
        self._complete = threading.Event()
        self._context = Context()
        rclpy.init(context=self._context)
        self._node = Node(f"_test_node_{secrets.token_hex(5)}", context=self._context)
        self._pump = MessagePump(self._node, self._context)
        self._pump.start()

    def wait(self) -> bool:
        """Return whether every topic had a message in time."""
        self._complete.clear()
        for topic, kind in self.topic_tuples:
            if topic in self._messages:
                self._messages[topic].clear()
                continue
            self._messages[topic] = deque(maxlen=self.messages_received_buffer_length)
            self._node.create_subscription(kind, topic, self._taking(topic), 10)
        return self._complete.wait(self.timeout)

    def shutdown(self) -> None:
        """Stop listening."""
        self._pump.stop()
        self._node.destroy_node()
        self._context.try_shutdown()

    def topics_received(self) -> set[str]:
        """Return the topics that had a message."""
        return {topic for topic, messages in self._messages.items() if messages}

    def topics_not_received(self) -> set[str]:
        """Return the topics that had none."""
        return {topic for topic, _kind in self.topic_tuples} - self.topics_received()

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the last messages of a topic.

        Raises:
            KeyError: it is not waited for.
        """
        if topic_name not in self._messages:
            raise KeyError(f"No messages received for topic: {topic_name}")
        return list(self._messages[topic_name])

    def __enter__(self) -> Self:
        if not self.wait():
            missing = self.topics_not_received()
            self.shutdown()
            raise RuntimeError("Did not receive messages on these topics: ", missing)
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _value: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        self.shutdown()

    def _taking(self, topic: str) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            self._messages[topic].append(message)
            if not self.topics_not_received():
                self._complete.set()

        return take


def get_rmw_output_filter(rmw_implementation: str, filter_type: str) -> list[str]:
    """Return what a middleware's package says about lines to leave out.

    Raises:
        TypeError: `filter_type` is neither ``prefixes`` nor ``patterns``.
    """
    if filter_type not in _FILTERS:
        raise TypeError(f'Unsupported filter_type "{filter_type}". Supported types: {_FILTERS}')
    kind = f"rmw_output_{filter_type}"
    if not has_resource(kind, rmw_implementation):
        return []
    return get_resource(kind, rmw_implementation)[0].splitlines()
