"""Messages of one topic on their way to who has something else to do."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any

__all__ = ["MOST_WAITING", "Backlog"]

MOST_WAITING = 1000
"""Messages of one topic that wait at most."""


class Backlog:
    """Bounds how much of a topic waits in a queue that has room for everything.

    A world may take seconds for a step, a user's callback may not end, and messages come all the
    while: no more of them wait than `MOST_WAITING`, the oldest go first. What else waits in the
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
            is_full = len(self._waiting) >= MOST_WAITING
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
