"""The messages of a topic, as a test takes them."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.testing.waiting import Waiting

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Messages"]


class Messages:
    """What arrives on a topic from the moment it was asked for, in order and none lost.

    Attributes:
        topic: its global name.
        type_name: of the messages, such as ``sensor_msgs/msg/LaserScan``.
    """

    def __init__(
        self,
        node: Node,
        topic: str,
        type_name: str,
        waiting: Waiting,
        hint: Callable[[], str],
    ) -> None:
        """Listen; use `Launch.topic`."""
        self.topic = topic
        self.type_name = type_name
        self._waiting = waiting
        self._hint = hint
        self._arrived: deque[Any] = deque()
        self._subscription = node.create_subscription(topic, type_name, self._take, queue_size=0)

    def next(self, timeout_s: float | None = None) -> Any:
        """Return the next message.

        Raises:
            AssertionError: none comes in time.
        """
        return self.messages(1, timeout_s)[0]

    def messages(self, count: int, timeout_s: float | None = None) -> list[Any]:
        """Return the next so many messages.

        Raises:
            AssertionError: fewer come in time.
        """
        self._until(
            lambda: len(self._arrived) >= count,
            f"message on '{self.topic}'" if count == 1 else f"{count} messages on '{self.topic}'",
            timeout_s,
        )
        return [self._arrived.popleft() for _ in range(count)]

    def wait_for(self, condition: Callable[[Any], object], timeout_s: float | None = None) -> Any:
        """Return the next message that a condition holds for; those before it are left out.

        Raises:
            AssertionError: none comes in time.
        """
        seen: list[Any] = []

        def found() -> bool:
            while self._arrived:
                seen.append(self._arrived.popleft())
                if condition(seen[-1]):
                    return True
            return False

        self._until(
            found,
            f"message on '{self.topic}' that meets the condition",
            timeout_s,
            lambda: f"the last of {len(seen)} was {seen[-1]}" if seen else "",
        )
        return seen[-1]

    def clear(self) -> None:
        """Forget what has arrived: `next` gives what comes from now on."""
        self._arrived.clear()

    def close(self) -> None:
        """Listen no more."""
        self._subscription.unregister()

    def _until(
        self,
        found: Callable[[], bool],
        wanted: str,
        timeout_s: float | None,
        more: Callable[[], str] = str,
    ) -> None:
        def hint() -> str:
            came = f"{len(self._arrived)} came" if self._arrived else ""
            return "; ".join(filter(None, [more(), came or self._hint()]))

        self._waiting.until(found, wanted, timeout_s, hint=hint)

    def _take(self, message: Any) -> None:
        self._arrived.append(message)
        self._waiting.wake()
