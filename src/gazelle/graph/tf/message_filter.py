"""Messages that wait until tf knows where they were taken, as with tf2's ``MessageFilter``."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

from gazelle.graph.tf.exceptions import ExtrapolationError, TransformError

__all__ = ["MessageFilter"]

T = TypeVar("T")


class MessageFilter(Generic[T]):
    """Holds messages back, in their order, until something that needs tf can be done with them.

    Messages are given up when tf has forgotten their time, and the oldest when there are too many.
    A message that waits does not stop those behind it, except later ones of its frame, for which
    there is no transform either. Threads may share it.
    """

    def __init__(
        self,
        place: Callable[[Any], T],
        on_drop: Callable[[Any, TransformError], None],
        *,
        size: int,
    ) -> None:
        """Wait for nothing yet.

        Args:
            place: what to do with a message, which has a header; raises `TransformError` where tf
                does not know yet.
            on_drop: told of a message that is given up, and why it could not be placed.
            size: so many messages wait at most.
        """
        self._place = place
        self._on_drop = on_drop
        self._size = size
        self._waiting: list[tuple[Any, TransformError]] = []
        self._lock = threading.Lock()

    @property
    def oldest(self) -> tuple[Any, TransformError] | None:
        """The message that waits for longest, and why; None when none does."""
        with self._lock:
            return self._waiting[0] if self._waiting else None

    def add(self, message: Any) -> list[T]:
        """Take a message in; return what came of those that can be placed now, in their order."""
        return self._sort([message])

    def ready(self) -> list[T]:
        """Return what came of the messages that can be placed now, in their order."""
        return self._sort([])

    def give_up(self) -> None:
        """Drop what still waits."""
        with self._lock:
            self._drop(self._waiting)
            self._waiting = []

    def clear(self) -> None:
        """Forget what waits."""
        with self._lock:
            self._waiting = []

    def _sort(self, new: list[Any]) -> list[T]:
        placed: list[T] = []
        waits: list[tuple[Any, TransformError]] = []
        first: dict[str, tuple[tuple[int, int], TransformError]] = {}
        with self._lock:
            for message, last in (*self._waiting, *((one, None) for one in new)):
                frame, stamp = message.header.frame_id, _stamp(message)
                earlier = first.get(frame)
                if earlier is not None and stamp >= earlier[0]:
                    waits.append((message, last or earlier[1]))
                    continue
                try:
                    placed.append(self._place(message))
                except TransformError as error:
                    waits.append((message, error))
                    if not _is_past(error):
                        first[frame] = stamp, error
            past = [one for one in waits if _is_past(one[1])]
            waits = [one for one in waits if not _is_past(one[1])]
            self._drop(past + waits[: -self._size])
            self._waiting = waits[-self._size :]
        return placed

    def _drop(self, given_up: list[tuple[Any, TransformError]]) -> None:
        for message, why in given_up:
            self._on_drop(message, why)


def _stamp(message: Any) -> tuple[int, int]:
    return message.header.stamp.sec, message.header.stamp.nanosec


def _is_past(error: TransformError) -> bool:
    return isinstance(error, ExtrapolationError) and error.is_past
