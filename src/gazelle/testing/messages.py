"""The messages of a topic, as a test takes them, and waiting for what a launch does."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeVar

from gazelle.diagnostics import did_you_mean

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Messages", "Waiting", "existing"]

T = TypeVar("T")
# What changes without notice (a clock of another process, say) is looked at this often.
_LOOK_S = 0.1
_MAX_NAMES = 12


class Waiting:
    """Wakes whoever waits for a launch when anything about it changes.

    Attributes:
        timeout_s: patience in seconds of real time where a wait names none.
        ended: says how the launch has ended, nothing while it runs.
    """

    def __init__(self, timeout_s: float) -> None:
        self.timeout_s = timeout_s
        self.ended: Callable[[], str] = str
        self._changed = threading.Condition()

    def wake(self, *_changes: object) -> None:
        """Look again: something has changed."""
        with self._changed:
            self._changed.notify_all()

    def until(
        self,
        found: Callable[[], T],
        wanted: str,
        timeout_s: float | None,
        *,
        hint: Callable[[], str] = str,
    ) -> T:
        """Return what a condition gives as soon as that is true.

        Args:
            found: the condition.
            wanted: what is waited for, in words that fit after "no": ``message on '/scan'``.
            timeout_s: patience, None for the usual one.
            hint: what to say besides.

        Raises:
            AssertionError: the time is up, or the launch has ended.
        """
        patience_s = self.timeout_s if timeout_s is None else timeout_s
        deadline = time.monotonic() + patience_s
        with self._changed:
            while True:
                # Asked first: what a launch did last, it did before its end.
                ended = self.ended()
                result = found()
                if result:
                    return result
                left_s = deadline - time.monotonic()
                if ended or left_s <= 0:
                    reason = f": {ended}" if ended else f" within {patience_s:g} s"
                    raise AssertionError("; ".join(filter(None, [f"no {wanted}{reason}", hint()])))
                self._changed.wait(min(left_s, _LOOK_S))


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


def existing(kind: str, name: str, names: Iterable[str]) -> str:
    """Return a hint: what exists that is spelled alike, or all there is."""
    known = sorted(set(names))
    near = did_you_mean(name, known)
    if near:
        return near
    shown = ", ".join(known[:_MAX_NAMES]) + (" …" if len(known) > _MAX_NAMES else "")
    return f"{kind} there: {shown or 'none'}"
